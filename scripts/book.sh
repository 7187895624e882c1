#!/bin/sh
# The book in out/book/html. mdBook is built from its crate where this version is not there yet.
# `scripts/book.sh --righting target/release/righting`.
set -eu
cd "$(dirname "$0")/.."
version=0.5.4
tools="${CARGO_TARGET_DIR:-target}/mdbook"
if ! "$tools/bin/mdbook" --version 2>/dev/null | grep -q "v$version\$"; then
    cargo install mdbook --version "$version" --locked --no-default-features --features search --root "$tools"
fi
exec scripts/book.py "$@" --mdbook "$tools/bin/mdbook" --out out/book
