#!/usr/bin/env python3
"""What the program is built from, as a CycloneDX 1.5 bill of materials: name, version, licence and checksum of
every crate that reaches the program, from cargo's metadata and the lock file. Needs no network and no packages.

    scripts/sbom.py > righting.cdx.json
"""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def main() -> int:
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    output = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    metadata = json.loads(output)
    locked = tomllib.loads((ROOT / "Cargo.lock").read_text(encoding="utf-8"))["package"]
    checksums = {(package["name"], package["version"]): package.get("checksum") for package in locked}
    packages = {package["id"]: package for package in metadata["packages"]}
    (program,) = (package for package in packages.values() if package["name"] == "righting")
    reached = linked(program["id"], metadata["resolve"]["nodes"])
    components = [component(packages[identity], checksums) for identity in reached - {program["id"]}]
    components.sort(key=lambda part: part["purl"])
    bill = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "version": 1,
        "metadata": {"component": {**component(program, checksums), "type": "application"}},
        "components": components,
    }
    json.dump(bill, sys.stdout, indent=1, sort_keys=True)
    print()
    print(f"{len(components)} components", file=sys.stderr)
    return 0


def linked(start: str, nodes: list[dict]) -> set[str]:
    """What a package is built with: normal and build dependencies, no tests."""
    needs = {
        node["id"]: [
            dependency["pkg"]
            for dependency in node["deps"]
            if any(kind["kind"] in (None, "build") for kind in dependency["dep_kinds"])
        ]
        for node in nodes
    }
    reached, todo = {start}, [start]
    while todo:
        for needed in needs[todo.pop()]:
            if needed not in reached:
                reached.add(needed)
                todo.append(needed)
    return reached


def component(package: dict, checksums: dict[tuple[str, str], str | None]) -> dict:
    name, version = package["name"], package["version"]
    part: dict = {"type": "library", "name": name, "version": version, "purl": f"pkg:cargo/{name}@{version}"}
    if package["license"]:
        part["licenses"] = [{"expression": package["license"].replace("/", " OR ")}]
    if checksum := checksums.get((name, version)):
        part["hashes"] = [{"alg": "SHA-256", "content": checksum}]
    return part


if __name__ == "__main__":
    sys.exit(main())
