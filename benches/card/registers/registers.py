"""Compiles the shader for a card's architecture and prints what a thread of the kernel takes.

The way: WGSL, by naga to Metal's language, from there to CUDA by a few substitutions and metal.h, by
nvcc to machine code. A driver's own compiler may do better or worse; it starts from the same text.
registers.sh calls this with everything in place.
"""

import argparse
import pathlib
import re
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]

# Override constants of each map, as src/cells/plan.rs sets them.
MAPS = {
    "default map": "recorded=0,certificate=1",
    "all 30 s": "recorded=0,certificate=0",
    "record map": "recorded=1,certificate=1",
}
ALWAYS = "isolated_h=1,isolated_v=1,kinks=1,yields=1,bouc_wen_n=2,workgroup_size=64"

# As Vulkan lets a driver compute: quotients and roots within 2.5 ULP, small numbers flushed.
NVCC = "-cubin -w -Xptxas -v -ftz=true -prec-div=false -prec-sqrt=false --expt-relaxed-constexpr".split()


def wgsl(precision):
    """The shader's text, its files in the order of src/backend/gpu/shader.rs."""
    listed = (ROOT / "src/backend/gpu/shader.rs").read_text()
    names = dict.fromkeys(re.findall(r"shaders/(\w+)\.wgsl", listed))
    names = [name for name in names if not name.startswith("real_") and name != "log"]
    texts = [(ROOT / f"shaders/{name}.wgsl").read_text() for name in [f"real_{precision}", *names]]
    # Metal has no f64; cuda() widens the type again.
    return "\n".join(texts).replace("alias real = f64;", "alias real = f32;")


def metal(naga, folder, precision, constants, kernel):
    """naga's translation, checked for bounds as wgpu has it done on a card."""
    source, result = folder / f"{precision}.wgsl", folder / f"{precision}.metal"
    source.write_text(wgsl(precision))
    bounds = ["--index-bounds-check-policy", "Restrict", "--buffer-bounds-check-policy", "Unchecked"]
    override = ["--override", f"{constants},{ALWAYS}"]
    entry = ["--entry-point", kernel, "--compact", "--metal-version", "2.4"]
    subprocess.run([naga, *entry, *bounds, *override, source, result], check=True)
    return result.read_text()


def cuda(text, precision, kernel):
    """naga's Metal text as CUDA: uniforms in constant memory, storage by pointers, workgroup
    variables shared."""
    text = text[text.index("typedef ") :]
    # The sizes of buffers are there for checks that are not asked for.
    text = re.sub(r",?\s*(constant _mslBufferSizes& )?_buffer_sizes( \[\[.*?\]\])?(?=[,\n)])", "", text)
    # A buffer's array is as long as one likes.
    text = re.sub(r"(typedef \w+ type_\w+)\[1\];", r"\1[1 << 24];", text)
    if precision == "f64":
        text = re.sub(r"\bfloat\b", "double", text)
    else:
        text = re.sub(r"(?<![\w.])(\d+\.\d*(e[-+]?\d+)?)(?![\w.])", r"\1f", text)
    head, body = re.split(r"\[\[max_total_threads_per_threadgroup\(\d+\)\]\] kernel void \w+\(", text)
    head = re.sub(r"^(\w+ \w+\()", r"DEVICE \1", head, flags=re.M)
    signature, body = body.split(") {\n", 1)
    pointers, uniforms, start = [], [], []
    for parameter in re.sub(r" *\[\[.*?\]\]", "", signature).replace("\n", " ").split(","):
        words = parameter.strip().replace("&", " &").split()
        space, kind, name = words[0], words[1], words[-1]
        if space == "constant":
            uniforms.append(f"__constant__ {kind} {name};")
        elif space == "device":
            const = "const " if "const" in words else ""
            pointers.append(f"{const}{kind}* __restrict__ {name}_at")
            start.append(f"{const}{kind}& {name} = *{name}_at;")
        elif space == "threadgroup":
            start.append(f"__shared__ {kind} {name};")
    start.append("const uint3 id = make_uint3(blockIdx.x * blockDim.x + threadIdx.x, 0, 0);")
    start.append("const uint local = threadIdx.x;")
    head = re.sub(r"^constant ", "static constexpr ", head, flags=re.M)
    head = re.sub(r"\bconstant (\w+&)", r"const \1", head)
    head = re.sub(r"\b(device|thread|threadgroup) (?=\w)", "", head)
    return "\n".join([
        '#include "metal.h"',
        head,
        *uniforms,
        f'extern "C" __global__ void BOUNDS {kernel}({", ".join(pointers)}) {{',
        *start,
        body,
    ])


def compiled(nvcc, source, architecture, most):
    """Registers, bytes of stack and of spills, and instructions of the kernel."""
    cubin = source.with_suffix(".cubin")
    bounds = f"-DBOUNDS=__maxnreg__({most})" if most else "-DBOUNDS=__launch_bounds__(64)"
    command = [nvcc, *NVCC, bounds, f"-arch={architecture}", f"-I{HERE}", "-o", cubin, source]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit("\n".join((done.stdout + done.stderr).splitlines()[:4]))
    said = done.stdout + done.stderr
    registers = int(re.search(r"Used (\d+) registers", said)[1])
    stack, stores, loads = map(int, re.search(
        r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads", said).groups())
    dump = [pathlib.Path(nvcc).parent / "cuobjdump", "-sass", cubin]
    sass = subprocess.run(dump, capture_output=True, text=True, check=True).stdout
    operations = re.findall(r"/\*[0-9a-f]{4,}\*/\s+(?:@!?U?P\w+ )?([A-Z]\w+)", sass)
    instructions = sum(operation != "NOP" for operation in operations)
    return registers, stack, stores, loads, instructions


def warps(registers):
    """Warps that a multiprocessor's registers hold: four files of 16,384, given out by eights."""
    return min(64, 4 * (16384 // (-(-registers // 8) * 8 * 32)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--naga", required=True, help="naga's command-line program")
    parser.add_argument("--nvcc", required=True, help="NVIDIA's compiler, cuobjdump beside it")
    parser.add_argument("--folder", required=True, type=pathlib.Path, help="for intermediate files")
    parser.add_argument("--arch", default="sm_90")
    parser.add_argument("--kernel", default="sweep")
    parser.add_argument("--most", type=int, nargs="*", default=[128, 96, 80, 64],
                        help="limits of registers to try on the default map")
    asked = parser.parse_args()
    print(f"kernel {asked.kernel}, {asked.arch}\n")
    print("| numbers | map | limit | registers | warps a multiprocessor | instructions | stack, B "
          "| spilled, B: stored | loaded |")
    print("|---|---|--:|--:|--:|--:|--:|--:|--:|")
    for precision in ["f32", "f64"]:
        for number, (name, constants) in enumerate(MAPS.items()):
            text = metal(asked.naga, asked.folder, precision, constants, asked.kernel)
            source = asked.folder / f"{precision}_{number}.cu"
            source.write_text(cuda(text, precision, asked.kernel))
            for most in [None, *(asked.most if number == 0 else [])]:
                registers, stack, stores, loads, instructions = compiled(
                    asked.nvcc, source, asked.arch, most)
                print(f"| {precision} | {name} | {most or '–'} | {registers} | {warps(registers)} "
                      f"| {instructions:,} | {stack} | {stores:,} | {loads:,} |", flush=True)


if __name__ == "__main__":
    main()
