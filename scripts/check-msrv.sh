#!/bin/sh
# The oldest Rust that the project promises (MSRV): `rust-version` in Cargo.toml. Fails when another
# file says otherwise, or when nothing here builds with that version: the toolchain in use is what CI
# compiles and tests everything with, so it has to be that one. With a newer toolchain in use, the
# oldest one checks the workspace if rustup has it.
set -eu
cd "$(dirname "$0")/.."

fail() {
    printf 'check-msrv: %s\n' "$*" >&2
    exit 1
}

oldest=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
[ -n "$oldest" ] || fail 'Cargo.toml: found no rust-version'

for manifest in Cargo.toml ipopt-sys/Cargo.toml crates/*/Cargo.toml; do
    grep -q '^rust-version\.workspace = true' "$manifest" ||
        fail "$manifest: expected rust-version.workspace = true"
done
grep -q "^rust-version = \"$oldest\"" python/Cargo.toml ||
    fail "python/Cargo.toml: expected rust-version = \"$oldest\""
for file in README.md CONTRIBUTING.md; do
    found=$(grep -o 'Rust [0-9][0-9.]*[0-9]' "$file" | sort -u)
    [ "$found" = "Rust $oldest" ] ||
        fail "$file: found \"$(echo "$found" | tr '\n' ' ')\", expected Rust $oldest alone"
done
# Clippy takes rust-version unless its own file has another.
found=$(sed -n 's/^msrv = "\(.*\)"/\1/p' clippy.toml)
[ "${found:-$oldest}" = "$oldest" ] || fail "clippy.toml: found msrv $found, expected $oldest"

used=$(rustc --version | sed 's/^rustc \([0-9]*\.[0-9]*\).*/\1/')
if [ "$used" = "$oldest" ]; then
    echo "check-msrv: Rust $oldest, which is the toolchain in use"
elif command -v rustup >/dev/null 2>&1 && rustup toolchain list | grep -q "^$oldest"; then
    cargo "+$oldest" check --workspace --all-targets --locked
    echo "check-msrv: Rust $oldest checks the workspace"
else
    fail "found Rust $used, expected $oldest; run: rustup toolchain install $oldest"
fi
