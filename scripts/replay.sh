#!/bin/sh
# Flies the paper's plans and others in MuJoCo and Basilisk by their exported files alone, and has other programs read every
# export, in a Python environment of its own; scripts/replay.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/replay/environment "bsk example-robot-data mujoco numpy pin pyyaml scipy spiceypy" scripts/replay.py "$@"
