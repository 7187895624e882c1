#!/usr/bin/env python3
"""The reference of momenta, accelerations and joint torques, by Pinocchio: crates/multibody/tests/data/dynamics.json.

States and controls stay as they stand in the file; everything that follows from them is computed anew. The file names
this script, its SHA-256 and the version of Pinocchio, and a test says when script and file part ways. Needs `pin` and
`numpy`; `make references` runs it in an environment of its own.
"""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin

import pinocchio_replay as replay

ROOT = Path(__file__).resolve().parent.parent
REFERENCE = ROOT / "crates" / "multibody" / "tests" / "data" / "dynamics.json"
# Pinocchio's model is built by the other: both make the numbers.
SCRIPTS = ("scripts/reference_dynamics.py", "scripts/pinocchio_replay.py")
# So far may numbers of another version of Pinocchio be off, of the largest of their vector.
SAME = 1e-12


def main() -> int:
    reference = json.loads(REFERENCE.read_text(encoding="utf-8"))
    worst = 0.0
    for name, samples in reference["systems"].items():
        system = json.loads((ROOT / f"scenarios/systems/{name}.json").read_text(encoding="utf-8"))
        model, _ = replay.build(system)
        for sample in samples:
            found = computed(model, np.array(sample["x"]), np.array(sample["u"]))
            for key, values in found.items():
                before = np.array(sample[key])
                worst = max(worst, np.abs(values - before).max() / max(np.abs(before).max(), 1e-300))
                if worst > SAME:
                    sample[key] = values.tolist()
    reference["source"] = f"Pinocchio {pin.__version__} (free-flyer base, crba/rnea/centroidal), states of seed 7"
    reference["made_by"] = {script: digest(ROOT / script) for script in SCRIPTS}
    order = ("source", "made_by", "conventions", "systems")
    text = json.dumps({key: reference[key] for key in order}, indent=0)
    REFERENCE.write_text(text + "\n", encoding="utf-8")
    print(f"{REFERENCE.relative_to(ROOT)}: Pinocchio {pin.__version__}, {worst:.1e} off what stood there")
    return 0


def computed(model: pin.Model, x: np.ndarray, u: np.ndarray) -> dict[str, np.ndarray]:
    """What follows from a state and a control."""
    data, joints = model.createData(), len(u)
    turn = replay.rotation(x[3:7])
    q = replay.configuration(x[:3], x[3:7], x[13 : 13 + joints])
    v = np.r_[turn.T @ x[7:10], x[10:13], x[13 + joints :]]
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    bias = pin.rnea(model, data, q, v, np.zeros(model.nv))
    base = np.linalg.solve(mass[:6, :6], -bias[:6] - mass[:6, 6:] @ u)
    pin.computeCentroidalMomentum(model, data, q, v)
    momentum, spin = data.hg.vector, x[10:13]
    # The base's own acceleration is that of its velocity in body axes, which turn.
    acceleration = turn @ (base[:3] + np.cross(spin, v[:3]))
    quaternion = 0.5 * np.r_[-x[4:7] @ spin, x[3] * spin + np.cross(x[4:7], spin)]
    return {
        "xdot": np.r_[x[7:10], quaternion, acceleration, base[3:], x[13 + joints :], u],
        "angular_momentum_body": turn.T @ momentum[3:],
        "angular_momentum_inertial": momentum[3:],
        "linear_momentum_inertial": momentum[:3],
        "center_of_mass_inertial": pin.centerOfMass(model, data, q),
        "joint_torque": (mass @ np.r_[base, u] + bias)[6:],
    }


def digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


if __name__ == "__main__":
    sys.exit(main())
