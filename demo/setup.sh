# Sourced by demo/run, tests/run and .ci/run: installs what dependencies.txt names and is missing, then builds.
# shellcheck shell=bash

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

die() {
    echo "error: $*" >&2
    exit 1
}

# Names in one [section] of dependencies.txt.
packages_of() {
    awk -v want="[$1]" '/^\[/ { on = ($1 == want); next } on && NF && !/^#/ { print $1 }' "$root/dependencies.txt"
}

# install_missing SECTION...: quick when everything is there (one dpkg-query).
install_missing() {
    local missing=() name section
    command -v dpkg-query >/dev/null || die "this script installs Debian packages; see dependencies.txt for what to install here"
    for section in "$@"; do
        for name in $(packages_of "$section"); do
            [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
        done
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    [ "$(id -u)" -eq 0 ] || die "missing packages; as root run: apt-get install --no-install-recommends ${missing[*]}"
    echo "installing ${#missing[@]} packages: ${missing[*]}"
    apt_install "${missing[@]}"
}

# apt_install PACKAGE...: quiet unless it fails; then one line that says why, and where apt-get's own words are.
# Lists that cannot be fetched are no error yet: an unrelated source may be down, or the packages be here already.
apt_install() {
    local log fresh=yes
    log=$(mktemp)
    apt-get -qq -o APT::Update::Error-Mode=any update >"$log" 2>&1 || fresh=no
    if ! DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >>"$log" 2>&1; then
        [ "$fresh" = yes ] || die "packages cannot be fetched: connect this machine to its package mirror and run this again (details: $log)"
        die "apt-get could not install $*: $(grep '^E: ' "$log" | head -1) (details: $log)"
    fi
    rm -f "$log"
}

# build TARGET...: scons, quiet unless something is wrong.
build() {
    (cd "$root" && scons -Q --silent -j "$(nproc)" "$@") || die "the build failed"
}
