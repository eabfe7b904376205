#!/usr/bin/env bash
# Runs the peers on the cells of topple's chart and charts all of them together:
#
#     benches/peers/run.sh [DIR]
#
# What it wants is said in peers.sh.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
out="${1:-topple-chart}"
# shellcheck source=peers.sh
source "$here/peers.sh"

topple chart --cells-only --out "$out"
run_peers
topple chart --out "$out" "${peers[@]}"
