#!/usr/bin/env bash
# One table: how many times as many cells a second topple does as the peers, on the cells of one map,
# in one run:
#
#     benches/peers/ratios.sh [DIR]
#
# What it wants is said in peers.sh.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
out="${1:-topple-ratios}"
# shellcheck source=peers.sh
source "$here/peers.sh"

topple chart --cells-only --out "$out" --quiet
# The pulse map's cells alone.
awk -F, 'NR == 1 || $1 == "pulse"' "$out/cells.csv" >"$out/pulse.csv"
mv "$out/pulse.csv" "$out/cells.csv"
run_peers
if [ "${#peers[@]}" -eq 0 ]; then
    echo 'no peer ran: nothing to compare' >&2
    exit 1
fi
topple bench "${peers[@]}"
