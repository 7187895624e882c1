#!/bin/sh
# Runs the comparison with CasADi in its own Python environment; arguments go to bench/compare.py.
set -eu
cd "$(dirname "$0")/.."
scripts/setup.sh bench
if [ ! -x bench/.venv/bin/python ]; then
    python3 -m venv bench/.venv
fi
bench/.venv/bin/python -m pip install --quiet --disable-pip-version-check -r bench/requirements.txt
cargo build --release --locked
cargo build --release --locked -p righting-planner --example costs
program="${CARGO_TARGET_DIR:-target}/release/righting"
exec bench/.venv/bin/python bench/compare.py --righting "$program" "$@"
