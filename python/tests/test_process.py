"""What a solve does to its process: signals, forks."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import righting as rt

# Sends itself Ctrl-C from within the solve: the handler runs at the next look.
INTERRUPTED = """
import os, signal, sys
import righting as rt
scenario = rt.Scenario(sys.argv[1]).to_dict()
scenario["solver"] = {"formulation": "full", "guess": {"starts": 500}}
sent = []
def interrupt(iteration):
    if not sent:
        sent.append(os.kill(os.getpid(), signal.SIGINT))
try:
    rt.solve(scenario, on_iteration=interrupt)
except KeyboardInterrupt:
    print("interrupted")
assert rt.solve(sys.argv[1]).verified
print("solved")
"""


def test_ctrl_c_stops_a_solve_and_the_next_one_works(scenarios: Path) -> None:
    command = [sys.executable, "-c", INTERRUPTED, str(scenarios / "slew_4dof.json")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert done.stdout.split() == ["interrupted", "solved"], done.stderr


def test_ctrl_c_from_outside_stops_a_solve_without_callback(scenarios: Path) -> None:
    script = """
import sys
import righting as rt
scenario = rt.Scenario(sys.argv[1]).to_dict()
scenario["solver"] = {"formulation": "full", "guess": {"starts": 1000}}
print("solving", flush=True)
rt.solve(scenario)
"""
    command = [sys.executable, "-c", script, str(scenarios / "slew_canadarm2.json")]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout is not None
    assert process.stdout.readline() == "solving\n"
    process.send_signal(signal.SIGINT)
    _, complaint = process.communicate(timeout=60)
    assert complaint.rstrip().endswith("KeyboardInterrupt"), complaint


@pytest.mark.filterwarnings("ignore:This process .* is multi-threaded:DeprecationWarning")
def test_a_fork_of_a_process_that_solved_says_why_it_cannot(scenarios: Path, plan: rt.Plan) -> None:
    assert plan.verified
    child = os.fork()
    if child == 0:
        try:
            rt.solve(scenarios / "slew_2dof.json")
        except rt.NotReadyError as error:
            os._exit(0 if "forked" in str(error) else 1)
        os._exit(2)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == 0
