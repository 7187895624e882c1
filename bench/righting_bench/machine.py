"""What ran the comparison: processor, compilers and libraries by version."""

from __future__ import annotations

import os
import platform
import subprocess
from dataclasses import dataclass
from pathlib import Path

import casadi as ca


@dataclass(frozen=True)
class Machine:
    """Identity of a run's machine and tools, and how busy it was at the start (load average)."""

    cpu: str
    cores: int
    system: str
    gcc: str
    casadi: str
    load: float


def this_machine() -> Machine:
    """Read it off this machine."""
    cpu = platform.processor()
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            cpu = line.partition(":")[2].strip()
            break
    release = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    gcc = subprocess.run(["gcc", "-dumpfullversion"], capture_output=True, text=True, check=True).stdout
    return Machine(
        cpu=cpu,
        cores=len(os.sched_getaffinity(0)),
        system=release,
        gcc=gcc.strip(),
        casadi=ca.__version__,
        load=os.getloadavg()[0],
    )
