# What run.sh and ratios.sh share; sourced, with `here` and `out` set.
#
# Wanted: Python 3 with numpy, scipy and numba (requirements.txt), a C++ compiler, and SUNDIALS
# (Debian: libsundials-dev; Homebrew: sundials). What is missing is left out, and said.
# shellcheck shell=bash

python="${PYTHON:-python3}"
topple() { cargo run --release --quiet --manifest-path "$here/../../Cargo.toml" -- "$@"; }

# Flags for topple: a `--peer FILE` for every program that ran.
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

# Runs the peers on the cells of "$out".
run_peers() {
    local flags
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
}
