#!/usr/bin/env python3
"""Fly plans in MuJoCo and Basilisk by their exported files alone, and check every exported file.

Plans the eight maneuvers of the paper's Table I, its 75 degree slew, slews by two arms, by an arm with a joint that
slides, by an arm that is imported from a URDF file, with wheels, and in a gravity gradient, exports each in every
format, runs the exported scripts, and has other programs read the other files (check_exports.py). Writes
docs/replay.md. Exit code 1 when a flight or a file is farther off than it may be.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

import check_exports

ROOT = Path(__file__).resolve().parents[1]
SCENARIOS = [
    *(f"slew_{arm}" for arm in ("2dof", "4dof", "canadarm2_table", "canadarm2")),
    *(f"detumble_{arm}" for arm in ("2dof", "4dof", "canadarm2_table", "canadarm2")),
    "slew75_4dof",
    "real/slew_two_arms",
    "real/slew_stanford",
    "slew_xarm7",
    "wheels/slew_4dof_one_wheel_failed",
    "real/slew_4dof_gravity_gradient",
]
# Basilisk's arms have no joints that slide, and its script knows neither wheels nor what acts from outside.
NOT_BASILISK = ["real/slew_stanford", "wheels/slew_4dof_one_wheel_failed", "real/slew_4dof_gravity_gradient"]
# A slew whose system is a URDF file, that of a seven-joint arm in the package example-robot-data.
URDF = "share/example-robot-data/robots/xarm_description/urdf/xarm7.urdf"
OF_URDF = {
    "name": "slew_xarm7",
    "system_options": {
        "on": {"mass_kg": 100, "cube_side_m": 0.6},
        "mount_position_m": [0, 0, 0.52],
        "acceleration_max_deg_s2": 20,
    },
    "initial": {"joint_angles_deg": [0, -30, 0, 60, 0, 60, 0]},
    "maneuver": {"type": "slew", "axis": [0.3, 0.5, 0.8], "angle_deg": 15},
    "horizon": {"duration_s": 60, "steps": 300},
}
# Wheels' torques jump where joints' do: MuJoCo takes smaller steps for the same error.
SMALLER_STEP_S = {"wheels/slew_4dof_one_wheel_failed": 0.001}
FORMATS = ["urdf", "mjcf", "joint-trajectory", "ck", "stk", "aem", "npz", "mat", "basilisk", "mujoco"]
FLIGHTS = ["mujoco", "basilisk"]
STATES = 20
# However exact the torques are, the arm leaves the plan: an error grows by a factor of some 10,000 in three seconds.
UNSTABLE = ["detumble_canadarm2"]
# What a flight may be off at its end (rad) and in its peak torques (percent), and what files may be off.
ATTITUDE_RAD = 1e-4
TORQUE_PERCENT = 0.1
FILES = {
    "URDF in Pinocchio": 1e-11,
    "MJCF in MuJoCo": 1e-11,
    "CK in SPICE": 1e-9,
    "STK and AEM": 1e-12,
    "MAT in SciPy": 0.0,
    "NPZ in NumPy": 0.0,
    "YAML and JSON": 1e-9,
}


def main() -> int:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("names", nargs="*", help="these scenarios; all of the page by default")
    options.add_argument("--righting", type=Path, default=ROOT / "target/release/righting")
    options.add_argument("--reference", type=Path, default=ROOT / "target/release/examples/reference")
    options.add_argument("--out", type=Path, default=ROOT / "out/replay")
    options.add_argument("--step", type=float, default=0.005, help="the largest step of a simulator, s")
    options = options.parse_args()
    options.righting, options.reference = options.righting.resolve(), options.reference.resolve()
    options.out.mkdir(parents=True, exist_ok=True)
    # MuJoCo leaves its log where it runs.
    os.chdir(options.out)
    options.out = Path.cwd()
    flights, files, wrong = [], {}, []
    for name in options.names or SCENARIOS:
        folder = options.out / Path(name).name
        scenario = of_urdf(options.out) if name == OF_URDF["name"] else ROOT / "scenarios" / f"{name}.json"
        run(options.righting, "solve", scenario, "--out", folder, "--figures", "none", "--no-report")
        flown = [simulator for simulator in FLIGHTS if simulator == "mujoco" or name not in NOT_BASILISK]
        for kind in FORMATS:
            if kind in FLIGHTS and kind not in flown:
                continue
            run(options.righting, "export", folder, "--format", kind)
        message = folder / "joint_trajectory.json"
        run(options.righting, "export", folder, "--format", "joint-trajectory", "--out", message)
        for simulator in flown:
            script = folder / f"fly_{simulator}.py"
            track = ["--track"] if name in UNSTABLE else []
            step = SMALLER_STEP_S.get(name, options.step)
            flight = json.loads(run(sys.executable, script, "--json", "--step", step, *track))
            flights.append((name, flight))
            print(f"{name:26} {flight['simulator']:16} {flight['attitude_error_rad']:.1e} rad, "
                  f"{flight['peak_torque_difference_percent']:.1e} %", flush=True)
            if flight["attitude_error_rad"] > ATTITUDE_RAD:
                wrong.append(f"{name}: {flight['simulator']}: {flight['attitude_error_rad']:.1e} rad")
            if flight["peak_torque_difference_percent"] > TORQUE_PERCENT:
                wrong.append(f"{name}: {flight['simulator']}: {flight['peak_torque_difference_percent']:.1e} %")
        states = [json.loads(line) for line in run(options.reference, scenario, STATES).splitlines()]
        for kind, deviation in check_exports.checked(folder, states).items():
            files[kind] = max(files.get(kind, 0.0), deviation)
            if not deviation <= FILES[kind]:
                wrong.append(f"{name}: {kind}: {deviation:.1e}, allowed {FILES[kind]:.0e}")
    for kind, deviation in files.items():
        print(f"{kind:20} {deviation:.1e}")
    if not options.names:
        (ROOT / "docs/replay.md").write_text(page(flights, files), encoding="utf-8")
    for problem in wrong:
        print(f"WRONG: {problem}")
    return 1 if wrong else 0


def of_urdf(folder: Path) -> Path:
    """The scenario whose system is a URDF file."""
    robot = next(path for path in (Path(entry) / "cmeel.prefix" / URDF for entry in sys.path) if path.is_file())
    file = folder / f"{OF_URDF['name']}.json"
    file.write_text(json.dumps(OF_URDF | {"system": str(robot)}), encoding="utf-8")
    return file


def run(*command: object) -> str:
    """What the command prints; its complaints where it fails."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def page(flights: list, files: dict[str, float]) -> str:
    simulators = " and ".join(sorted({flight["simulator"] for _, flight in flights}, reverse=True))
    lines = [
        "# Plans flown by other programs",
        "",
        "This page is written by `make replay` (`scripts/replay.py`). It plans the eight maneuvers of the paper's Table I",
        "and its 75° slew, a slew by two arms, one by the Stanford arm, whose third joint slides (Basilisk has no such joints",
        "in an arm), one by the seven-joint arm xArm 7, whose URDF file of the package example-robot-data is the",
        "scenario's system, one with four wheels of which one has failed, and one in a gravity gradient (the Basilisk script",
        "knows neither). It exports them and flies them from the exported files alone: the scripts of",
        "`righting export --format mujoco` and `--format basilisk`. The simulated joints get the plan's torques and",
        "nothing else. Nothing tracks the plan, so what a simulator's dynamics do otherwise than the plan's stays visible.",
        f"The simulators are {simulators}.",
        "",
        "*Attitude* is the angle between the base at the end of the flight and at the end of the plan; it may be at most",
        f"{ATTITUDE_RAD:.0e} rad. *Joints* is the largest difference of a joint coordinate there. *Torque* is the largest",
        "difference between a joint's peak torque in the plan and the one that the simulator's equations need for the",
        f"plan's joint accelerations; it may be at most {TORQUE_PERCENT} %.",
        "",
        "| plan | simulator | integrator, step | attitude, rad | joints, rad or m | torque, % |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for name, flight in flights:
        simulator = flight["simulator"].split()[0]
        mark = " (tracked)" if name in UNSTABLE else ""
        lines.append(
            f"| `{Path(name).name}`{mark} | {simulator} | {flight['integrator']}, {1000 * flight['step_s']:g} ms "
            f"| {flight['attitude_error_rad']:.1e} | {flight['joint_error_rad']:.1e} "
            f"| {flight['peak_torque_difference_percent']:.1e} |"
        )
    tracking = {flight["simulator"].split()[0]: flight["tracking_torque_percent"]
                for _, flight in flights if "tracking_torque_percent" in flight}
    said = ", ".join(f"{percent:.1e} % in {simulator}" for simulator, percent in tracking.items())
    lines += [
        "",
        f"One plan cannot be flown by its torques alone: {', '.join(f'`{name}`' for name in UNSTABLE)}. Its motion is unstable: an",
        "error of the joint angles grows by a factor of some 10,000 in three seconds, so over 30 s no precision of torques",
        "or integration is enough. It is flown with `--track`, which holds the joints to the plan. What that takes is,",
        f"of a joint's peak torque, {said}.",
        "",
        "The other exports of the same plans are read by the programs that they are for. Models are compared at",
        f"{STATES} random states a system: mass matrix, center of mass, momenta, and the forces of inverse dynamics, each",
        "relative to its largest entry.",
        "",
        "| files | largest deviation | allowed |",
        "| --- | --- | --- |",
    ]
    units = {"CK in SPICE": " rad, rad/s", "STK and AEM": " s, deg/s", "YAML and JSON": " s, SI units"}
    for kind, deviation in files.items():
        lines.append(f"| {kind} | {deviation:.1e}{units.get(kind, '')} | {FILES[kind]:.0e} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(main())
