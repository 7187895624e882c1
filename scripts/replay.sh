#!/bin/sh
# Flies the paper's plans in MuJoCo and Basilisk by their exported files alone, and has other programs read every
# export, in a Python environment of its own; scripts/replay.py.
set -eu
cd "$(dirname "$0")/.."
environment=out/replay/environment
if [ ! -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check \
        bsk mujoco numpy pin pyyaml scipy spiceypy
fi
exec "$environment/bin/python" scripts/replay.py "$@"
