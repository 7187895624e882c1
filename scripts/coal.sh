#!/bin/sh
# Measures the clearances of plans with coal, in a Python environment of its own; scripts/coal_distances.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/coal "coal numpy" scripts/coal_distances.py "$@"
