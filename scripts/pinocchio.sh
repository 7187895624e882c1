#!/bin/sh
# Replays the plans of a folder with Pinocchio, in a Python environment of its own; scripts/pinocchio_replay.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/pinocchio "pin numpy" scripts/pinocchio_replay.py "$@"
