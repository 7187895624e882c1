#!/bin/sh
# What limits cost and whether they hold outside, in a Python environment of its own; scripts/limits.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/pinocchio "pin numpy" scripts/limits.py "$@"
