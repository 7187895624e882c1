#!/bin/sh
# The Debian package of this release of Debian in out/deb, with manual pages and completions, by cargo-deb, which it builds
# in out/deb/tools if it is missing. "--try" also installs it in a root of that release that has no Rust, plans there and
# removes it; needs root and debootstrap.
#   CARGO_DEB   cargo-deb, if it is somewhere else
#   MIRROR      a mirror of Debian for --try (default: that of apt on this machine)
set -eu
cd "$(dirname "$0")/.."

fail() { echo "deb: $*" >&2; exit 1; }

# The version of cargo-deb that the package was tried with.
version=3.8.0
out=out/deb
program=${CARGO_TARGET_DIR:-target}/release/righting
codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
case $codename in
    bookworm) variant= ;;
    trixie) variant=--variant=trixie ;;
    *) fail "found Debian release \"$codename\", expected bookworm or trixie: its package of Ipopt is not known" ;;
esac

cargo_deb=${CARGO_DEB:-$out/tools/bin/cargo-deb}
[ -x "$cargo_deb" ] || cargo install --quiet --locked --root "$out/tools" "cargo-deb@$version"
rm -rf "$out/man" && mkdir -p "$out/man"
"$program" manpages "$out/man" > /dev/null
for shell in bash zsh fish; do "$program" completions "$shell" > "$out/righting.$shell"; done
# shellcheck disable=SC2086
package=$("$cargo_deb" deb $variant --no-build --locked --output "$out/")
echo "$package"
[ "${1:-}" = --try ] || exit 0

[ "$(id -u)" = 0 ] || fail "found no root, which --try needs"
root=$out/root
mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE)' "Codename: $codename" "Component: main" \
    "Created-By: Packages" | head -n 1)}
if [ ! -e "$root/etc/debian_version" ]; then
    debootstrap --variant=minbase "$codename" "$root" "$mirror" > "$out/root.log" 2>&1 ||
        fail "debootstrap failed: $out/root.log"
fi
apt-config dump --format '%f "%v";%n' Acquire > "$root/etc/apt/apt.conf.d/90this-machine"
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp "$package" "$root/tmp/righting.deb"
# A name space of its own takes the mounts with it when it ends.
inside() { unshare --mount sh -c 'root=$1; shift; mount -t proc proc "$root/proc" && mount --rbind /dev "$root/dev" && exec chroot "$root" "$@"' sh "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"; }
inside apt-get -qq update
inside apt-get -qq install --yes --no-install-recommends /tmp/righting.deb > /dev/null
inside righting doctor
inside righting solve /usr/share/righting/scenarios/slew_4dof.json --out /tmp/plan --figures none > /dev/null
inside righting verify /tmp/plan > /dev/null
inside test -s /usr/share/man/man1/righting-solve.1.gz
inside apt-get -qq remove --yes righting > /dev/null
if inside sh -c 'command -v righting || ls -d /usr/share/righting' 2> /dev/null; then fail "remove left files"; fi
echo "installed, planned, verified and removed on $codename"
