#!/bin/sh
# Builds and tests on Debian 13, whose Ipopt (3.14) comes with another interface, another way to a
# linear solver of one's own, and MPI: in a root of that release, made by debootstrap from the mirror
# that this machine's apt uses. Rust's toolchain and cargo's registry are this machine's, read only;
# sources are copied. Every mount is in a name space of its own and ends with it.
#
# Needs root and, on Debian or Ubuntu, debootstrap. The first run takes half an hour on two cores.
# Usage: scripts/test-debian13.sh [COMMAND...]   instead of building and testing, run COMMAND there
#   ROOT     where the root is, or shall be (default: out/debian13)
#   MIRROR   a mirror of Debian (default: that of apt on this machine)
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
root=${ROOT:-$here/out/debian13}

fail() { echo "test-debian13: $*" >&2; exit 1; }

# The second half, in the name space.
if [ "${1:-}" = --inside ]; then
    shift
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    # MPI leaves files there when it is killed.
    mount -t tmpfs none "$root/dev/shm"
    mount --bind -o ro "$SYSROOT" "$root/opt/rust"
    mount --bind -o ro "$REGISTRY" "$root/root/.cargo/registry"
    exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 TERM=dumb CARGO_NET_OFFLINE=true CARGO_INCREMENTAL=0 \
        CARGO_TARGET_DIR=/work/target PATH=/opt/rust/bin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
        "$@"
fi

[ "$(id -u)" = 0 ] || fail "found no root, which mounting and chroot need"
for needed in debootstrap unshare chroot rustc cargo; do
    command -v "$needed" > /dev/null || fail "$needed is missing: apt-get install debootstrap util-linux"
done
SYSROOT=$(rustc --print sysroot)
[ -x "$SYSROOT/bin/cargo" ] || fail "found no cargo in $SYSROOT, expected a toolchain of rustup"
REGISTRY=${CARGO_HOME:-$HOME/.cargo}/registry
export SYSROOT REGISTRY ROOT="$root"

if [ ! -e "$root/etc/debian_version" ]; then
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    mirror=${MIRROR:-$(apt-get indextargets --format '$(SITE)' "Codename: $codename" \
        "Component: main" "Created-By: Packages" | head -n 1)}
    [ -n "$mirror" ] || fail "found no mirror of Debian in apt's sources; name one: MIRROR=..."
    mkdir -p "$root"
    unshare --mount --propagation private debootstrap --variant=minbase trixie "$root" "$mirror" > "$root.log" 2>&1 || {
        tail -n 20 "$root.log" >&2
        rm -rf "$root"
        fail "debootstrap failed"
    }
    rm "$root.log"
fi
# Proxies, time-outs and the like.
apt-config dump --format '%f "%v";%n' Acquire > "$root/etc/apt/apt.conf.d/90this-machine"
cp /etc/resolv.conf "$root/etc/resolv.conf"

cargo fetch --quiet --locked --manifest-path "$here/Cargo.toml"
rm -rf "$root/work/righting"
mkdir -p "$root/work/righting" "$root/work/target" "$root/opt/rust" "$root/root/.cargo/registry"
(cd "$here" && git ls-files -z --cached --others --exclude-standard |
    tar --null --files-from - --create --ignore-failed-read 2> /dev/null) |
    tar --extract --directory "$root/work/righting"

inside() {
    unshare --mount --propagation private --pid --fork --kill-child "$0" --inside "$@"
}
if [ $# -gt 0 ]; then
    inside "$@"
    exit
fi

cat > "$root/work/test.sh" << 'TEST'
set -eu
command -v make > /dev/null || {
    apt-get -qq update
    DEBIAN_FRONTEND=noninteractive apt-get -qq install -y --no-install-recommends make > /dev/null
}
cd /work/righting
make test
cargo build --release --locked --quiet
righting=/work/target/release/righting
"$righting" doctor
folder=$(mktemp -d)
"$righting" solve scenarios/slew_4dof.json --out "$folder/plan" > /dev/null
echo
echo "A default plan:"
sed -n '/"versions"/,/}/p' "$folder/plan/solution.json"

# The median of eleven runs.
time_of() {
    for run in 1 2 3 4 5 6 7 8 9 10 11; do
        before=$(date +%s%N)
        "$righting" "$@" > /dev/null
        after=$(date +%s%N)
        echo $(((after - before) / 100000))
    done | sort -n | sed -n '6s/\(.*\)\(.\)$/\1.\2 ms/p'
}
echo
echo "From start to end, median of eleven:"
for command in --version schema "verify $folder/plan" "report $folder/plan" "figures $folder/plan" \
    "power $folder/plan" "export $folder/plan --format npz" "solve scenarios/slew_4dof.json --out $folder/again"; do
    # shellcheck disable=SC2086  # a list of words
    printf '  %-8s %s\n' "${command%% *}" "$(time_of $command)"
done
rm -rf "$folder"
TEST
inside sh /work/test.sh
