#!/bin/sh
# Compares imported robots with Pinocchio's and MuJoCo's models of them, in a Python environment of its own;
# scripts/check_import.py.
set -eu
exec "$(dirname "$0")/in-environment.sh" out/import/environment "example-robot-data mujoco numpy pin" scripts/check_import.py "$@"
