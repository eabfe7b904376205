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
