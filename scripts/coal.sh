#!/bin/sh
# Measures the clearances of plans with coal, in a Python environment of its own; scripts/coal_distances.py.
set -eu
cd "$(dirname "$0")/.."
environment=out/coal
if [ ! -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check coal numpy
fi
exec "$environment/bin/python" scripts/coal_distances.py "$@"
