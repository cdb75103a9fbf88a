# Sourced by ./run, ./test and ./dev: installs what is missing, in one step, and says in one line what it lacks where
# it cannot install. Everything is a Debian 12 package; the lists are tools/packages/*.txt.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

die() { echo "vagus: $*" >&2; exit 1; }

packages_in() {
    local list
    for list in "$@"; do grep -v '^#' "$root/tools/packages/$list.txt"; done
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# need build test …: the packages of these lists are there when it returns.
need() {
    command -v dpkg-query >/dev/null ||
        die "this is not Debian. Install what stands in tools/packages/*.txt by the names of your system, then set VAGUS_NO_INSTALL=1."
    [ -z "${VAGUS_NO_INSTALL:-}" ] || return 0
    local package missing=()
    for package in $(packages_in "$@"); do is_installed "$package" || missing+=("$package"); done
    [ ${#missing[@]} -eq 0 ] && return 0
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || die "missing Debian packages and no sudo to install them; as root: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    echo "vagus: installing ${missing[*]}" >&2
    install_packages "${as_root[@]}" -- "${missing[@]}" ||
        die "apt-get could not install: ${missing[*]} (its last words are above)"
}

# install_packages [sudo] -- PACKAGE…: quiet unless it fails.
install_packages() {
    local prefix=() log
    while [ "$1" != -- ]; do prefix+=("$1"); shift; done
    shift
    log=$(mktemp)
    if "${prefix[@]}" apt-get update -q >"$log" 2>&1 &&
        "${prefix[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@" >>"$log" 2>&1; then
        rm -f "$log"
        return 0
    fi
    tail -n 15 "$log" >&2
    rm -f "$log"
    return 1
}

# configure PRESET [OPTION…]: quiet unless it fails, and quick when nothing changed.
configure() {
    local preset=$1 log
    shift
    log=$(mktemp)
    (cd "$root" && cmake --preset "$preset" "$@") >"$log" 2>&1 || { cat "$log" >&2; rm -f "$log"; die "cmake --preset $preset failed"; }
    rm -f "$log"
}

# build PRESET [TARGET…]: a counting line on a terminal, otherwise only what goes wrong.
build() {
    local preset=$1
    shift
    if [ -t 2 ]; then
        ninja -C "$root/build/$preset" --quiet "$@" >&2 || die "the build failed; the first error above is the one to read"
        return
    fi
    local log
    log=$(mktemp)
    ninja -C "$root/build/$preset" "$@" >"$log" 2>&1 || { tail -n 60 "$log" >&2; rm -f "$log"; die "the build failed; the first error above is the one to read"; }
    rm -f "$log"
}
