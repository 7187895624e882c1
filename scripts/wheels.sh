#!/bin/sh
# What arm and wheels do alone and together, in a Python environment of its own; scripts/wheels.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/pinocchio "pin numpy" scripts/wheels.py "$@"
