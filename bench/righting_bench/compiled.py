"""Stage functions as native code: CasADi's C, this machine's compiler, loaded back as external functions."""

from __future__ import annotations

import hashlib
import json
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import casadi as ca

FLAGS = ("-O3", "-march=native", "-fPIC", "-shared")


@dataclass(frozen=True)
class Compiled:
    """The same functions by name, and the seconds the compiler took (when it ran, if cached)."""

    functions: dict[str, ca.Function]
    compile_s: float


def compile_functions(functions: list[ca.Function], cache: Path) -> Compiled:
    """Compile functions into one library under `cache`, unless the very same source is there already."""
    cache.mkdir(parents=True, exist_ok=True)
    generator = ca.CodeGenerator("stage.c")
    for function in functions:
        generator.add(function)
    source = generator.dump()
    name = hashlib.sha256(" ".join((*FLAGS, source)).encode()).hexdigest()[:16]
    library, note = cache / f"{name}.so", cache / f"{name}.json"
    if not (library.exists() and note.exists()):
        path = cache / f"{name}.c"
        path.write_text(source)
        begun = time.perf_counter()
        subprocess.run(["gcc", *FLAGS, str(path), "-o", str(library), "-lm"], check=True)
        note.write_text(json.dumps({"compile_s": time.perf_counter() - begun, "flags": FLAGS}))
    loaded = {function.name(): ca.external(function.name(), str(library)) for function in functions}
    return Compiled(loaded, json.loads(note.read_text())["compile_s"])
