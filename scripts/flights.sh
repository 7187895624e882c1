#!/bin/sh
# Flies plans many times with spacecraft that are not as planned, ours and MuJoCo, in a Python environment of its own;
# scripts/flights.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/flights/environment "mujoco numpy" scripts/flights.py "$@"
