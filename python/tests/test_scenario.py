"""Scenarios and systems: from files, from dictionaries, and what is wrong with them."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import pytest
import righting as rt


def test_a_scenario_is_the_same_from_its_file_and_from_what_it_holds(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "slew_4dof.json")
    assert rt.Scenario(scenario.to_dict()) == scenario
    assert rt.Scenario(str(scenarios / "slew_4dof.json")) == scenario
    assert scenario.name == "slew_4dof"
    assert (scenario.duration_s, scenario.steps) == (30.0, 600)
    assert scenario.system.joint_count == 4
    assert scenario.to_dict()["weights"]["control"] == 0.01
    assert rt.Scenario(scenario.to_dict()).sha256 == scenario.sha256


def test_a_dictionary_may_hold_systems_paths_and_arrays(scenarios: Path) -> None:
    system = rt.System(scenarios / "systems/xlink_4dof.json")
    given = {
        "name": "mine",
        "initial": {"joint_angles_deg": np.zeros(4)},
        "maneuver": {"type": "slew", "axis": np.array([0.0, 0.6, 0.8]), "angle_deg": np.float64(20)},
        "horizon": {"duration_s": 30.0, "steps": np.int64(100)},
    }
    scenario = rt.Scenario({**given, "system": system})
    assert scenario.system == system
    assert rt.Scenario({**given, "system": Path("systems/xlink_4dof.json")}, folder=scenarios) == scenario
    assert scenario.steps == 100


def test_a_system_says_what_it_is(scenarios: Path) -> None:
    system = rt.System(scenarios / "systems/xlink_4dof.json")
    assert (system.name, system.joint_count) == ("xlink_4dof", 4)
    links = system.to_dict()["links"]
    assert system.mass_kg == pytest.approx(300.0 + sum(link["mass_kg"] for link in links))
    assert rt.System(system.to_dict()) == system


def test_scenarios_and_systems_can_be_pickled(scenarios: Path) -> None:
    scenario = rt.Scenario(scenarios / "detumble_2dof.json")
    assert pickle.loads(pickle.dumps(scenario)) == scenario
    assert pickle.loads(pickle.dumps(scenario.system)) == scenario.system


def test_errors_name_the_field_what_stands_there_and_what_should(scenarios: Path) -> None:
    wrong = rt.Scenario(scenarios / "slew_4dof.json").to_dict()
    wrong["horizon"]["steps"] = 0
    with pytest.raises(rt.InputError) as raised:
        rt.Scenario(wrong)
    error = raised.value
    assert error.file == "scenario"
    assert error.field == "horizon.steps"
    assert error.found == "0"
    assert error.expected == "a whole number from 1 to 100000"
    assert error.hint is not None and "righting.schema" in error.hint
    assert str(error) == "scenario: horizon.steps: found 0, expected a whole number from 1 to 100000"
    copied = pickle.loads(pickle.dumps(error))
    assert (copied.field, str(copied)) == (error.field, str(error))


def test_a_misspelt_field_is_named_with_the_one_that_was_meant(scenarios: Path) -> None:
    wrong = rt.Scenario(scenarios / "slew_4dof.json").to_dict()
    wrong["maneuver"]["angel_deg"] = wrong["maneuver"].pop("angle_deg")
    with pytest.raises(ValueError, match="did you mean `angle_deg`") as raised:
        rt.Scenario(wrong)
    assert isinstance(raised.value, rt.InputError) and raised.value.field == "maneuver.angel_deg"


def test_a_number_that_is_not_finite_is_named(scenarios: Path) -> None:
    wrong = rt.Scenario(scenarios / "slew_4dof.json").to_dict()
    wrong["maneuver"]["angle_deg"] = float("nan")
    with pytest.raises(rt.InputError, match=r"maneuver\.angle_deg"):
        rt.Scenario(wrong)


def test_a_missing_file_is_an_os_error(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="no such file") as raised:
        rt.Scenario(tmp_path / "none.json")
    assert isinstance(raised.value, rt.FileError)
    assert raised.value.file == str(tmp_path / "none.json")


def test_another_kind_of_file_is_told_apart(scenarios: Path) -> None:
    with pytest.raises(rt.InputError, match="a system file") as raised:
        rt.Scenario(scenarios / "systems/xlink_4dof.json")
    assert raised.value.hint == "righting.System reads it"


def test_what_cannot_stand_in_a_file_is_a_type_error() -> None:
    with pytest.raises(TypeError, match="cannot stand in a file"):
        rt.Scenario({"name": object()})


def test_schemas_are_dictionaries() -> None:
    assert rt.schema()["title"] == "Righting scenario"
    assert rt.schema("system")["title"] == "Righting system"
    with pytest.raises(rt.InputError) as raised:
        rt.schema("nothing")
    assert raised.value.field == "file"


URDF = """<robot name="arm">
  <link name="foot"/>
  <link name="upper"><inertial><origin xyz="0 0 0.3"/><mass value="6"/>
    <inertia ixx="0.19" iyy="0.19" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0 0.25"/><mass value="4"/>
    <inertia ixx="0.09" iyy="0.09" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="yaw" type="revolute"><parent link="foot"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" velocity="0.3" effort="40"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.6"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="2" velocity="0.3" effort="20"/></joint>
</robot>"""
BUS = {"name": "bus", "mass_kg": 200.0, "inertia_kg_m2": np.diag([20.0, 18.0, 16.0]), "keep_out_radius_m": 0.3}


def test_a_robot_is_read_from_urdf(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    system = rt.System.from_urdf(file, on=BUS, mount_position_m=[0, 0, 0.4], acceleration_max_deg_s2=10.0)
    assert system.joint_names == ["yaw", "elbow"]
    assert system.mass_kg == 210.0
    assert rt.System(system.to_dict()).to_dict() == system.to_dict()
    held = rt.System.from_urdf(file, on=BUS, locked={"yaw": 0.0}, acceleration_max_deg_s2=10.0)
    assert held.joint_names == ["elbow"]
    # The elbow's axis is y, and everything is symmetric about its plane.
    assert np.abs(held.explain()["only_axis"]) == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)


def test_what_is_wrong_with_a_robot_is_named(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    for options, field in [
        ({"on": BUS}, "acceleration_max_deg_s2"),
        ({"on": BUS, "acceleration_max_deg_s2": 0.0}, "acceleration_max_deg_s2"),
        ({"base": "none"}, "base"),
        ({"base": "foot", "speed": 1}, "speed"),
        ({}, "base"),
    ]:
        with pytest.raises(rt.InputError) as raised:
            rt.System.from_urdf(file, **options)
        assert raised.value.field is not None and raised.value.field.endswith(field)
    with pytest.raises(rt.FileError):
        rt.System.from_urdf(tmp_path / "none.urdf", base="foot")
    file.write_text(URDF.replace('<child link="lower"/>', '<child link="elsewhere"/>'))
    with pytest.raises(rt.InputError, match="elsewhere"):
        rt.System.from_urdf(file, on=BUS, acceleration_max_deg_s2=10.0)
