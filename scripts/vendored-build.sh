#!/bin/sh
# The program from a copy of everything that it is built from, without the network: scripts/vendored-build.sh FOLDER.
# The folder then holds `vendor`, the target and the configuration that a build on another machine needs.
set -eu
cd "$(dirname "$0")/.."
folder=${1:-out/vendored}
mkdir -p "$folder/.cargo"
folder=$(cd "$folder" && pwd)
cargo vendor --locked --versioned-dirs "$folder/vendor" >"$folder/.cargo/config.toml"
# A home without any registry: what is not in the folder cannot be found.
CARGO_HOME="$folder/home" cargo build --release --locked --offline \
    --config "$folder/.cargo/config.toml" --target-dir "$folder/target"
"$folder/target/release/righting" --version
