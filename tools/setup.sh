# Sourced by ./run, ./test and ./dev: installs what is missing, in one step, configures and builds, and shows how far it
# is. Everything is a Debian 12 package; the lists are tools/packages/*.txt.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Without a terminal, seconds between two lines that say how far it is. Tests set it.
progress_every=${VAGUS_PROGRESS_EVERY:-30}

# On a terminal it takes the place of a line that another part of the build has left open.
say() { if [ -t 2 ]; then printf '\r\e[Kvagus: %s\n' "$*" >&2; else echo "vagus: $*" >&2; fi; }
die() { say "$*"; exit 1; }

# 75 -> 1:15
clock() { printf '%d:%02d' $(($1 / 60)) $(($1 % 60)); }

# The last step that a log of ninja ("[12/640] …") or ctest (" 12/1781 Test …") names: 12/640. Nothing before the first.
step_in() {
    tail -c 20000 "$1" 2>/dev/null | sed -nE 's/^\[([0-9]+\/[0-9]+)\].*/\1/p; s/^ *([0-9]+\/[0-9]+) Test .*/\1/p' | tail -n 1
}

# Says how far a log is until stdin is closed: on a terminal in one line that changes every second, else in a line from
# time to time.
tell_progress() {
    local what=$1 log=$2 every=$progress_every status step text
    ! [ -t 2 ] || every=1
    while status=0; read -rt "$every" || status=$?; [ "$status" -gt 128 ]; do
        step=$(step_in "$log")
        text="vagus: $what, ${step:+$step, }$(clock $SECONDS)"
        if [ -t 2 ]; then printf '\r\e[K%s' "$text" >&2; else echo "$text" >&2; fi
    done
    ! [ -t 2 ] || printf '\r\e[K' >&2
}

# with_progress WHAT LOG COMMAND …: what the command prints goes to the log; meanwhile a person sees how far it is.
# Progress ends with the command, however this shell ends: its pipe is closed then.
with_progress() {
    local what=$1 log=$2 pipe teller status=0
    shift 2
    : >"$log"
    SECONDS=0
    exec {pipe}> >(tell_progress "$what" "$log")
    teller=$!
    "$@" >"$log" 2>&1 {pipe}>&- || status=$?
    exec {pipe}>&-
    wait "$teller" || true
    return "$status"
}

packages_in() {
    local list
    for list in "$@"; do grep -v '^#' "$root/tools/packages/$list.txt"; done
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# need build test …: the packages of these lists are there when it returns.
need() {
    command -v dpkg-query >/dev/null ||
        die "this is not Debian. Install what tools/packages/*.txt lists, by the names of your system, then set VAGUS_NO_INSTALL=1."
    [ -z "${VAGUS_NO_INSTALL:-}" ] || return 0
    local package missing=()
    for package in $(packages_in "$@"); do is_installed "$package" || missing+=("$package"); done
    [ ${#missing[@]} -eq 0 ] && return 0
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "missing Debian packages and no sudo to install them; as root: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    say "installing ${#missing[@]} packages, a minute or two: ${missing[*]}"
    install_packages "${as_root[@]}" -- "${missing[@]}" ||
        die "apt-get could not install the packages; its last words are above. Check the network, then try: apt-get update &&" \
            "apt-get install ${missing[*]}"
}

# install_packages [sudo] -- PACKAGE…: quiet unless it fails.
install_packages() {
    local prefix=() log
    while [ "$1" != -- ]; do prefix+=("$1"); shift; done
    shift
    log=$(mktemp)
    # A password is asked for before progress writes over the question.
    [ ${#prefix[@]} -eq 0 ] || "${prefix[@]}" -v || return 1
    if with_progress "installing" "$log" "${prefix[@]}" apt-get update -q &&
        with_progress "installing" "$log" \
            "${prefix[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"; then
        rm -f "$log"
        return 0
    fi
    tail -n 15 "$log" >&2
    rm -f "$log"
    return 1
}

# A build folder knows its own place and that of its sources. One that was moved or copied here, or whose checkout was,
# cannot be used: it goes.
forget_moved_build() {
    local folder=$root/build/$1 entry place here
    [ -f "$folder/CMakeCache.txt" ] || return 0
    for entry in CMAKE_HOME_DIRECTORY:INTERNAL CMAKE_CACHEFILE_DIR:INTERNAL; do
        place=$(sed -n "s/^$entry=//p" "$folder/CMakeCache.txt")
        [ "$entry" = CMAKE_HOME_DIRECTORY:INTERNAL ] && here=$root || here=$folder
        if [ -n "$place" ] && ! [ "$place" -ef "$here" ]; then
            say "build/$1 was made in another place ($place); making it again"
            rm -rf "$folder"
            return 0
        fi
    done
}

is_configured() {
    forget_moved_build "$1"
    [ -f "$root/build/$1/build.ninja" ]
}

# configure PRESET [OPTION…]: quiet unless it fails, and quick when nothing changed.
configure() {
    local preset=$1 log
    shift
    forget_moved_build "$preset"
    log=$(mktemp)
    (cd "$root" && with_progress "configuring $preset" "$log" cmake --preset "$preset" "$@") ||
        { cat "$log" >&2; rm -f "$log"; die "cmake --preset $preset failed; the first error above says why. If none does: rm -r build/$preset, and again"; }
    rm -f "$log"
}

# build PRESET [TARGET…]: how far it is, and what goes wrong. On a terminal ninja's own line; nothing where all is built.
build() {
    local preset=$1 folder=$root/build/$1 log=$root/build/$1/build.log
    shift
    local advice="the build of $preset failed; the first error above is the one to read. If the memory was short: ninja -C build/$preset -j1, then again"
    ! is_built "$folder" "$@" || return 0
    if [ -t 2 ]; then
        (cd "$folder" && NINJA_STATUS='[%f/%t] ' ninja "$@" >&2) || die "$advice"
        return
    fi
    (cd "$folder" && with_progress "building $preset" "$log" ninja "$@") ||
        { grep -vE '^\[[0-9]+/[0-9]+\] ' "$log" | tail -n 60 >&2; die "$advice. All of it: build/$preset/build.log"; }
}

# So many places there are for tests beside each other: one that computes takes two (cmake/VagusModule.cmake).
places_for_tests() { echo $((2 * $(nproc) + 1)); }

# ninja FOLDER [TARGET…] would do nothing.
is_built() {
    local folder=$1
    shift
    (cd "$folder" && ninja -n "$@" 2>/dev/null | grep -q 'no work to do')
}

# Node that builds the pages: the machine's own from 22 on, else this one, as a package of npm inside web/.node.
node_version=22.23.3

# need_web: the studio's pages can be built when it returns 0. Where npm packages cannot be had it says so in one line
# and returns 1, so that a caller goes on without the studio.
need_web() {
    command -v npm >/dev/null || (need web) || { no_web "Debian's npm"; return 1; }
    use_node || { need_node && use_node; } || { no_web "Node $node_version"; return 1; }
    [ "$root/web/node_modules/.package-lock.json" -nt "$root/web/package-lock.json" ] && return 0
    say "fetching the npm packages of the studio's pages"
    quiet_npm "$root/web" ci || { no_web "the packages of web/package-lock.json"; return 1; }
    touch "$root/web/node_modules/.package-lock.json"
}

# use_node: node is new enough when it returns 0; nothing is fetched.
use_node() {
    local own
    own=$root/web/.node/node_modules/node-linux-$(node_machine)/bin
    [ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null || echo 0)" -lt 22 ] || return 0
    [ "$("$own/node" --version 2>/dev/null)" = "v$node_version" ] || return 1
    PATH="$own:$PATH"
}

# What the pages are built from: two pages of docs are the text of their help.
page_sources=(web docs/aesl.md docs/thymio.md src/serve/protocol/protocol.json)

# No source of the pages is younger than what was built from them.
are_pages_built() {
    local source sources=()
    [ -f "$root/web/dist/index.html" ] || return 1
    for source in "${page_sources[@]}"; do [ ! -e "$root/$source" ] || sources+=("$root/$source"); done
    [ -z "$(find "${sources[@]}" \( -name node_modules -o -name dist -o -name .node \) -prune \
        -o -type f -newer "$root/web/dist/index.html" -print -quit)" ]
}

# 0 when they are in web/dist; else it has said why they do not.
build_pages() {
    are_pages_built && return 0
    need_web || return 1
    quiet_npm "$root/web" run build || { say "the studio's pages could not be built; the words above say why"; return 1; }
}

node_machine() { if [ "$(uname -m)" = aarch64 ]; then echo arm64; else echo x64; fi; }

need_node() {
    local folder=$root/web/.node
    mkdir -p "$folder"
    echo '{ "private": true }' >"$folder/package.json"
    say "fetching Node $node_version for the studio's pages"
    quiet_npm "$folder" install --save-exact "node-linux-$(node_machine)@$node_version"
}

# quiet_npm FOLDER ARGUMENT…: its last words only if it fails.
quiet_npm() {
    local folder=$1 log
    shift
    log=$(mktemp)
    if (cd "$folder" && npm "$@" --no-audit --no-fund --loglevel=error) >"$log" 2>&1; then rm -f "$log"; return 0; fi
    tail -n 5 "$log" >&2
    rm -f "$log"
    return 1
}

no_web() { say "npm packages cannot be had now ($1); the studio's pages are not built"; }
