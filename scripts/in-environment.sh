#!/bin/sh
# Runs a Python script in an environment of its own, which is made with the packages if it is missing:
# scripts/in-environment.sh FOLDER "PACKAGE…" SCRIPT [ARGUMENT…]
set -eu
cd "$(dirname "$0")/.."
environment=$1 packages=$2 script=$3
shift 3
if [ ! -x "$environment/bin/python" ]; then
    python3 -m venv "$environment"
    # Split at spaces: each is a package.
    # shellcheck disable=SC2086
    "$environment/bin/python" -m pip install --quiet --disable-pip-version-check $packages
fi
exec "$environment/bin/python" "$script" "$@"
