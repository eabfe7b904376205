#!/usr/bin/env bash
# One table: how many times as many cells a second topple does as the peers, on the cells of one map,
# in one run:
#
#     benches/peers/ratios.sh [DIR]
#
# Wanted as for run.sh; what is missing is left out, and said.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
out="${1:-topple-ratios}"
python="${PYTHON:-python3}"
topple() { cargo run --release --quiet --manifest-path "$here/../../Cargo.toml" -- "$@"; }

topple chart --cells-only --out "$out" --quiet
# The pulse map's cells alone.
awk -F, 'NR == 1 || $1 == "pulse"' "$out/cells.csv" >"$out/pulse.csv"
mv "$out/pulse.csv" "$out/cells.csv"
peers=()
peer() { # name, command...
    local name="$1" result="$out/$1.csv"
    shift
    if "$@" "$out" "$result"; then
        peers+=(--peer "$result")
    else
        echo "$name left out" >&2
    fi
}

flags="$(pkg-config --cflags --libs sundials_cvode 2>/dev/null || true)"
# shellcheck disable=SC2086 # flags are several words
if c++ -std=c++17 -O3 -march=native -o "$out/cvode_peer" "$here/cvode_peer.cpp" $flags \
    -lsundials_cvode -lsundials_nvecserial -lm; then
    peer cvode "$out/cvode_peer"
else
    echo 'CVODE left out: SUNDIALS did not compile' >&2
fi
peer numba "$python" "$here/numba_peer.py"
peer scipy "$python" "$here/scipy_peer.py"
topple bench "${peers[@]}"
