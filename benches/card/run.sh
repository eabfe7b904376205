#!/usr/bin/env bash
# Everything that a machine with a card is to be asked, right or wrong first:
#
#     benches/card/run.sh [DIR]            # builds, runs, and leaves table.md and log.txt in DIR
#     benches/card/run.sh prepare FOLDER   # makes a folder for a machine that cannot build:
#     FOLDER/run.sh [DIR]                  # there, nothing is built
#
# README.md beside this file says what each part does and what may be set.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"

say() { printf '\n== %s (%d s)\n' "$1" "$SECONDS"; }
refuse() { # status, line
    echo "$2" >&2
    exit "$1"
}

# Builds the program and the test of agreement, and says in `topple` and `agreement` where they are.
build() {
    local root="$here/../.." profile="${TOPPLE_CARD_PROFILE:-release}" built
    cd "$root"
    cargo build --profile "$profile" --bin topple
    built="$(cargo test --profile "$profile" --no-run --test lab 2>&1)" || refuse 1 "$built"
    agreement="$PWD/$(sed -n 's/.*(\(.*lab-[0-9a-f]*\)).*/\1/p' <<<"$built")"
    topple="$PWD/target/${profile/#dev/debug}/topple"
    commit=", $(git describe --always --dirty 2>/dev/null || echo 'no commit')"
    cd - >/dev/null
}

if [ "${1:-}" = prepare ]; then
    folder="${2:?run.sh prepare FOLDER}"
    build
    mkdir -p "$folder"
    cp "$topple" "$folder/topple"
    cp "$agreement" "$folder/agreement"
    cp "$here/run.sh" "$here/README.md" "$folder/"
    echo "$commit" >"$folder/commit"
    echo "copy $folder to the machine with the card and run ./run.sh in it"
    exit
fi
if [ -x "$here/topple" ] && [ -x "$here/agreement" ]; then
    topple="$here/topple" agreement="$here/agreement" commit="$(cat "$here/commit")"
else
    build
fi

# The card: the first adapter of the kind that is asked for.
adapters="$("$topple" adapters)"
kinds=' discrete '
[ -z "${TOPPLE_CARD_ANY:-}" ] || kinds=' (discrete|integrated|virtual|software|other) '
line="$(grep -E "^ *[0-9]+ .*$kinds" <<<"$adapters" | head -n 1 || true)"
if [ -z "$line" ]; then
    refuse 2 "no card: topple adapters lists no discrete adapter (TOPPLE_CARD_ANY=1 takes any other for a trial)"
fi
read -r number _ <<<"$line"

out="${1:-card-results}"
mkdir -p "$out"
out="$(cd "$out" && pwd)"
scratch="$(mktemp -d "$out/scratch-XXXXXX")"
running=()
tidy() {
    for process in "${running[@]}"; do kill -KILL "$process" 2>/dev/null || true; done
    rm -rf "$scratch"
}
trap tidy EXIT
exec > >(tee "$out/log.txt") 2>&1

if [ -n "${TOPPLE_CARD_ANY:-}" ]; then
    # Two batches, and little to do in each cell.
    default_sides='12 24' default_whole=1040 killed_map=(--t-max 0.1)
else
    default_sides='400 1024 2048 4096' default_whole=2048 killed_map=(--full-model)
fi
# The sides of the maps that are timed, of the map that is killed, and the longest that a run may take, s.
read -ra sides <<<"${TOPPLE_CARD_SIDES:-$default_sides}"
whole="${TOPPLE_CARD_WHOLE:-$default_whole}"
limit="${TOPPLE_CARD_LIMIT:-300}"

block=(--object 1 --eccentricity 0.2)
isolated=(--t-h 1.75 --t-v 0.75)

# A scene by its name and side, as arguments.
scene() {
    case "$1" in
    'record map') echo "seismic ${block[*]} --t-h 0.5:4:$2 --t-v 0.02:2:$2" ;;
    'all 30 s') echo "$(scene 'default map' "$2") --full-model" ;;
    *) echo "pulse ${block[*]} ${isolated[*]} --omega 0.2:15:$2 --a-h 0.1:15:$2" ;;
    esac
}

# Runs a scene on the card into a folder: name, side, precision, folder, and more arguments.
sweep() {
    local words
    read -ra words <<<"$(scene "$1" "$2")"
    timeout "$limit" "$topple" "${words[@]}" --precision "$3" --backend gpu --adapter "$number" \
        --keep-every 99999 --quiet --out "$4" "${@:5}"
}

# A number of a run's run.json, by its key.
told() { sed -n "s/^ *\"$2\": \([0-9.e+-]*\),\{0,1\}\$/\1/p" "$1/run.json" | head -n 1; }

rounded() { awk -v x="$1" 'BEGIN {
    x = sprintf("%.0f", x); while (match(x, /[0-9][0-9][0-9][0-9]($|,)/)) x = substr(x, 1, RSTART) "," substr(x, RSTART + 1); print x }'; }
seconds() { awk -v x="$1" -v y="${2:-0}" 'BEGIN { printf "%.2f s", x + y }'; }

# A row of the table: what, numbers, and a value for each side.
row() {
    local what="$1" numbers="$2" values=("${@:3}")
    while [ "${#values[@]}" -lt "${#sides[@]}" ]; do values+=(''); done
    { printf '| %s | %s' "$what" "$numbers"; printf ' | %s' "${values[@]}"; echo ' |'; } | tee -a "$out/table.md"
}

precisions=(f32)
! grep -q 'f32 f64' <<<"$line" || precisions+=(f64)

say 'the card'
echo "$adapters"
smi="$(command -v nvidia-smi || true)"
ncu="$(command -v ncu || true)"
[ -z "$smi" ] || "$smi" --query-gpu=name,driver_version,clocks.max.sm,power.limit,compute_mode --format=csv
# Name and driver as run.json has them.
first_start="$scratch/first"
caches=(__GL_SHADER_DISK_CACHE_PATH="$scratch/cache" MESA_SHADER_CACHE_DIR="$scratch/cache"
    MESA_GLSL_CACHE_DIR="$scratch/cache")
mkdir "$scratch/cache"
start() { # folder: the start with its caches in a folder of their own
    (export "${caches[@]}" && sweep 'default map' 64 f32 "$1")
}
start "$first_start" || refuse 1 'the card does not run a map of 64 by 64; log.txt has why'
field() { sed -n "s/^ *\"$1\": \"\(.*\)\",\{0,1\}\$/\1/p" "$first_start/run.json" | head -n 1; }
card="$(sed -n '/"adapter"/,/}/s/^ *"name": "\(.*\)",$/\1/p' "$first_start/run.json" | head -n 1)"
{
    printf '| %s; %s; topple %s%s | numbers' "$card" "$(field driver)" "$(field version)" "$commit"
    printf ' | %s²' "${sides[@]}"
    printf ' |\n|---|---'
    printf '|--:%.0s' "${sides[@]}"
    echo '|'
} | tee "$out/table.md"

say 'right or wrong: ten maps, two precisions, against the reference'
right=0
TOPPLE_REQUIRE_ADAPTER=1 "$agreement" --nocapture agreement:: --skip agreement::cpu_ \
    2>&1 | tee "$scratch/agreement" || right=$?
compared=()
for precision in "${precisions[@]}"; do
    compared+=("$(awk -v name="gpu ${precision^}:" '
        index($0, name) { match($0, /[0-9]+ of [0-9]+ cells differ/); split(substr($0, RSTART), n, " ")
            differ += n[1]; cells += n[3] }
        END { if (cells) print differ " of " cells; else print "not compared" }' "$scratch/agreement")")
    row 'outcomes other than the reference’s, ten maps of 60²' "$precision" "${compared[-1]}"
done
[ "$right" -eq 0 ] && [[ "${compared[*]}" != *not* ]] ||
    refuse 1 'wrong: the test of agreement failed, and nothing was timed; log.txt has the figures'

say 'start-up'
start "$scratch/second"
for which in first second; do
    folder="$scratch/$which"
    row "map of 64², $which start: until the sweep; the sweep" f32 \
        "$(seconds "$(told "$folder" start)"); $(seconds "$(told "$folder" sweep)")"
done

say 'cells a second'
# Samples of the card's state while a command runs.
watched() {
    if [ -z "$smi" ]; then
        "$@"
        return
    fi
    "$smi" --query-gpu=utilization.gpu,clocks.sm,power.draw --format=csv,noheader --loop-ms=200 &
    local watcher=$! status=0
    running+=("$watcher")
    "$@" || status=$?
    kill "$watcher" 2>/dev/null || true
    return "$status"
}
for name in 'default map' 'all 30 s' 'record map'; do
    for precision in "${precisions[@]}"; do
        values=() last=0 last_side=1
        # The first map brings the pipeline into the driver's cache, and is not told.
        for side in warm "${sides[@]}"; do
            folder="$scratch/map"
            if [ "$side" = warm ]; then
                sweep "$name" 8 "$precision" "$folder" || true
                rm -rf "$folder"
                continue
            fi
            # What a run is expected to take, by the one before.
            expected="$(awk -v s="$last" -v a="$side" -v b="$last_side" 'BEGIN { print int(s * a * a / b / b) }')"
            if [ -z "$last" ] || [ "$expected" -gt "$limit" ]; then
                values+=('–')
                continue
            fi
            best='' last=''
            for _ in 1 2 3; do
                began="$SECONDS"
                watched sweep "$name" "$side" "$precision" "$folder" --files npz --verify none || { best=''; break; }
                best="$(awk -v a="$best" -v b="$(told "$folder" cells_per_second)" 'BEGIN { print (a + 0 > b + 0 ? a : b) }')"
                last="$(told "$folder" sweep)"
                last_side="$side"
                rm -rf "$folder"
                # One run is enough of what takes long.
                [ $((SECONDS - began)) -lt 10 ] || break
            done
            rm -rf "$folder"
            values+=("$([ -n "$best" ] && rounded "$best" || echo '–')")
        done
        row "$name, cells/s" "$precision" "${values[@]}"
    done
done

say 'topple bench'
peak=()
[ -z "${TOPPLE_CARD_PEAK:-}" ] || peak=(--peak "$TOPPLE_CARD_PEAK")
"$topple" bench --side "${sides[0]}" --repeat 3 "${peak[@]}" | tee "$scratch/bench"
share="$(sed -n "s/^share of the card's peak of .*: //p" "$scratch/bench")"
row "share of the peak of ${TOPPLE_CARD_PEAK:-?} Tflop/s" f32 "${share:-TOPPLE_CARD_PEAK was not set}"

say 'counters'
counters=smsp__thread_inst_executed_per_inst_executed.ratio,smsp__issue_active.avg.pct_of_peak_sustained_active
lanes='' issue=''
if [ -n "$ncu" ]; then
    missing='ncu counted no kernel'
    read -ra words <<<"$(scene 'default map' "${sides[-1]}")"
    timeout "$limit" "$ncu" --clock-control none --launch-skip 4 --launch-count 6 --metrics "$counters" "$topple" \
        "${words[@]}" --backend gpu --adapter "$number" --quiet --out "$scratch/map" | tee "$scratch/ncu" || true
    rm -rf "$scratch/map"
    mean() { awk -v name="$1" -v by="$2" '$1 == name { sum += $NF; n++ } END { if (n) printf "%.0f %%", sum / n / by * 100 }' "$scratch/ncu"; }
    lanes="$(mean "${counters%,*}" 32)" issue="$(mean "${counters#*,}" 100)"
else
    missing='ncu is missing'
fi
row 'lanes in use' f32 "${lanes:-$missing}"
row 'issue use' f32 "${issue:-$missing}"
[ -n "$smi" ] || row 'clock, load and power while it ran' '' 'nvidia-smi is missing'

say 'killed and resumed, and two at once'
sweep 'default map' "$whole" f32 "$scratch/alone" "${killed_map[@]}"
words=()
read -ra words <<<"$(scene 'default map' "$whole")"
"$topple" "${words[@]}" --backend gpu --adapter "$number" --keep-every 0.01 --quiet --out "$scratch/killed" \
    "${killed_map[@]}" &
killed=$!
running+=("$killed")
# As soon as a chunk is on disk: the file of its status comes last.
while kill -0 "$killed" 2>/dev/null && ! compgen -G "$scratch/killed/unfinished/status/c/*/*" >/dev/null; do sleep 0.005; done
kill -KILL "$killed" 2>/dev/null || true
wait "$killed" 2>/dev/null || true
if [ -e "$scratch/killed/run.json" ]; then
    result='it ended before it was killed'
elif sweep 'default map' "$whole" f32 "$scratch/killed" "${killed_map[@]}" --resume &&
    cmp "$scratch/alone/map.csv" "$scratch/killed/map.csv"; then
    result="alike, $(rounded "$(told "$scratch/killed" resumed_cells)") of $(rounded $((whole * whole))) cells kept"
else
    result='NOT ALIKE'
fi
row "killed and resumed, $whole²" f32 "$result"
rm -rf "$scratch/killed"
pair=()
for i in 1 2; do
    sweep 'default map' "$whole" f32 "$scratch/two-$i" "${killed_map[@]}" &
    pair+=($!)
    running+=($!)
done
two=alike
for process in "${pair[@]}"; do wait "$process" || two='ONE FAILED'; done
for i in 1 2; do cmp "$scratch/alone/map.csv" "$scratch/two-$i/map.csv" || two='NOT ALIKE'; done
row "two at once, $whole²" f32 "$two"

say 'done'
running=()
echo "$out/table.md"
[[ "$result" != NOT* && "$two" == alike ]]
