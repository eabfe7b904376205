#!/usr/bin/env bash
# Registers, spills and instructions of the shader on an NVIDIA card, without a card:
#
#     benches/card/registers/registers.sh [--arch sm_90] [--kernel sweep] [--most 128 96 80 64]
#
# It needs Cargo, Python 3 with venv, a C++ compiler and a network. naga's program and NVIDIA's compiler
# (300 MB, from PyPI) go to target/registers and stay there; REGISTERS_FOLDER names another folder.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
root="$here/../../.."
folder="${REGISTERS_FOLDER:-$root/target/registers}"
mkdir -p "$folder/made"
folder="$(cd "$folder" && pwd)"

# The version that topple is built with.
version="$(grep -A1 '^name = "naga"$' "$root/Cargo.lock" | sed -n 's/^version = "\(.*\)"$/\1/p')"
naga="$folder/naga/bin/naga"
if [ ! -x "$naga" ]; then
    cargo install naga-cli --version "$version" --debug --quiet --root "$folder/naga" \
        --target-dir "$folder/target" >&2
    rm -r "$folder/target"
fi
nvcc="$(ls "$folder"/venv/lib/python3*/site-packages/nvidia/cu*/bin/nvcc 2>/dev/null || true)"
if [ -z "$nvcc" ]; then
    python3 -m venv "$folder/venv"
    "$folder/venv/bin/pip" install --quiet nvidia-cuda-nvcc nvidia-cuda-runtime nvidia-cuda-crt \
        nvidia-cuda-cccl nvidia-nvvm nvidia-cuda-cuobjdump nvidia-cuda-nvdisasm >&2
    nvcc="$(ls "$folder"/venv/lib/python3*/site-packages/nvidia/cu*/bin/nvcc)"
fi
# cuobjdump looks for nvdisasm there.
export PATH="${nvcc%/*}:$PATH"
exec python3 "$here/registers.py" --naga "$naga" --nvcc "$nvcc" --folder "$folder/made" "$@"
