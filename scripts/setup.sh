#!/bin/sh
# Makes sure that everything the build needs is there; with "test", also fonts and the browser that
# the tests drive, with "bench", also what the comparison needs.
# Installs missing Debian or Ubuntu packages when it may, otherwise prints the line that does.
set -eu

say() { printf '%s\n' "$*" >&2; }

missing() {
    command -v cc >/dev/null 2>&1 || printf ' gcc libc6-dev'
    command -v pkg-config >/dev/null 2>&1 || printf ' pkg-config'
    { command -v pkg-config >/dev/null 2>&1 && pkg-config --exists ipopt; } ||
        printf ' coinor-libipopt-dev'
    if [ "${1:-}" = test ] && [ -z "${RIGHTING_BROWSER:-}" ]; then
        for browser in chromium chromium-browser google-chrome google-chrome-stable chrome none; do
            command -v "$browser" >/dev/null 2>&1 && break
        done
        [ "$browser" = none ] && printf ' chromium'
    fi
    # The text of figures as PNG; other systems come with fonts of their own, elsewhere.
    if [ "${1:-}" = test ] && command -v apt-get >/dev/null 2>&1; then
        fonts=$(find /usr/share/fonts /usr/local/share/fonts "${HOME:-}/.local/share/fonts" \
            -name '*.[ot]t[cf]' 2>/dev/null || true)
        [ -z "$fonts" ] && printf ' fonts-dejavu-core'
    fi
    if [ "${1:-}" = bench ]; then
        python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || printf ' python3-venv'
    fi
}

check_rust() {
    needed=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
    if ! command -v cargo >/dev/null 2>&1; then
        say "error: cargo is not installed; Rust $needed or newer comes from https://rustup.rs"
        return 1
    fi
    found=$(rustc --version | sed 's/^rustc \([0-9.]*\).*/\1/')
    oldest=$(printf '%s\n%s\n' "$needed" "$found" | sort -V | head -n 1)
    if [ "$oldest" != "$needed" ]; then
        say "error: Rust $found is too old, $needed is needed; run: rustup update stable"
        return 1
    fi
}

cd "$(dirname "$0")/.."
check_rust

packages=$(missing "${1:-}")
[ -z "$packages" ] && exit 0

if ! command -v apt-get >/dev/null 2>&1; then
    say "error: not installed (Debian's names):$packages"
    say "       install these (Ipopt with its headers), then run this again"
    exit 1
fi

if [ "$(id -u)" -eq 0 ]; then
    as_root=env
elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
    as_root="sudo -n env"
else
    say "error: not installed:$packages"
    say "       run: sudo apt-get update && sudo apt-get install -y$packages"
    exit 1
fi

say "installing$packages"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt_get() {
    # shellcheck disable=SC2086  # a list of words
    $as_root DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=120 "$@" \
        >"$log" 2>&1 || { cat "$log" >&2; say "error: apt-get $* failed"; exit 1; }
}
apt_get update
# shellcheck disable=SC2086
apt_get install -y --no-install-recommends $packages

packages=$(missing "${1:-}")
if [ -n "$packages" ]; then
    say "error: still missing after installing:$packages"
    exit 1
fi
