# Sourced by the scripts beside it: a stranger's environment.

# Where the Rust toolchain's own programs lie: with them no rustup is needed, nor its place.
tools="${TOPPLE_TOOLS:-$(dirname "$(rustc --print sysroot)/bin/rustc")}"
export TOPPLE_TOOLS="$tools"

step() { printf '\n== %s (%d s)\n' "$1" "$SECONDS"; }

# bare ROOM COMMAND...: runs a command as a stranger has it, over ssh or in a container. The environment holds the
# way to the tools and a HOME and CARGO_HOME in ROOM, and nothing else; `bare ROOM NAME=VALUE... COMMAND` adds to it.
bare() {
    local room="$1"
    shift
    env -i PATH="$room/home/.cargo/bin:$tools:/usr/local/bin:/usr/bin:/bin" HOME="$room/home" \
        CARGO_HOME="$room/home/.cargo" "$@" </dev/null
}

# blocks LANGUAGE PAGE: the text of a page's fenced blocks of one language, an empty line after each.
blocks() {
    awk -v fence='```'"$1" '$0 == fence { inside = 1; next } inside && /^```/ { print ""; inside = 0 } inside' "$2"
}

apt() {
    local sudo=()
    [ "$(id -u)" -eq 0 ] || sudo=(sudo)
    "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq "$@"
}

# beside NAME COMMAND...: begins a step that runs beside those that follow, until `joined`. It takes the script's EXIT
# trap: with the script ends what still runs.
beside_names=() beside_pids=() beside_logs=()
beside() {
    local log
    log="$(mktemp)"
    beside_names+=("$1") beside_logs+=("$log")
    shift
    trap end_beside EXIT
    # A group of its own, which is ended whole.
    set -m
    (
        set +m
        trap - EXIT
        # What a script's function begins beside others has a time and steps of its own.
        SECONDS=0
        "$@"
        echo "done, $SECONDS s"
    ) >"$log" 2>&1 </dev/null &
    beside_pids+=("$!")
    set +m
}

# Waits for the steps that run beside, and shows what they said, in the order in which they began. Fails if one failed.
joined() {
    local number status failed=0
    for number in "${!beside_pids[@]}"; do
        status=0
        wait "${beside_pids[number]}" || status=$?
        step "${beside_names[number]}, beside the steps above"
        cat "${beside_logs[number]}"
        rm "${beside_logs[number]}"
        unset "beside_pids[number]" "beside_logs[number]"
        if [ "$status" -ne 0 ]; then
            echo "${beside_names[number]}: failed with status $status" >&2
            failed=1
        fi
    done
    beside_names=() beside_pids=() beside_logs=()
    return "$failed"
}

end_beside() {
    local pid
    for pid in "${beside_pids[@]}"; do
        kill -- "-$pid" 2>/dev/null || true
    done
    [ "${#beside_logs[@]}" -eq 0 ] || rm -f "${beside_logs[@]}"
}
