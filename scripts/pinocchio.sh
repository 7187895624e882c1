#!/bin/sh
# Replays the plans of a folder with Pinocchio, in a Python environment of its own; scripts/pinocchio_replay.py.
set -eu
cd "$(dirname "$0")/.."
environment=out/pinocchio
if [ ! -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check pin numpy
fi
exec "$environment/bin/python" scripts/pinocchio_replay.py "$@"
