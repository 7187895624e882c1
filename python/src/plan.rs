use std::path::PathBuf;

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyDict, PyTuple};
use righting_analysis::PowerProfile;
use righting_analysis::power::PAPER_EFFICIENCY;
use righting_flight::{Control, Sensors, Settings, Spreads};
use righting_results::{SOLUTION_FILE, Solution, TRAJECTORY_FILE, Trajectory};
use righting_scenario::json::FileKind;
use righting_verifier::{Verified, verify_directory};

use crate::argument::{above_zero, not_negative, seconds, share};
use crate::check::Check;
use crate::columns::{Columns, to_tuple, trajectory};
use crate::export::export;
use crate::failure::{Failure, Outcome};
use crate::flights::Flights;
use crate::input::named;
use crate::json::{to_python, word};
use crate::power::Power;
use crate::scenario::Scenario;
use crate::verification::Verification;

/// A planned maneuver: its motion on N steps between N + 1 nodes, what it reached and whether it was proven.
///
/// `righting.solve` makes it, and `Plan.read` reads it from a folder. Its arrays are made once and read-only; copy
/// one to change it. j is the number of joints. Position and velocity are those of the origin of the body frame
/// (the base's center of mass) in inertial axes; the quaternion is scalar first and turns body vectors into
/// inertial ones; the angular rate is in body axes.
#[pyclass(frozen, module = "righting")]
pub struct Plan {
    /// With the duration that the plan chose, where it was free to.
    pub scenario: righting_scenario::Scenario,
    pub solution: Solution,
    pub trajectory: Trajectory,
    columns: PyOnceLock<Columns>,
}

impl Plan {
    pub fn new(
        scenario: righting_scenario::Scenario,
        solution: Solution,
        trajectory: Trajectory,
    ) -> Self {
        let scenario = match solution.duration_s {
            Some(duration_s) => scenario.with_duration(duration_s),
            None => scenario,
        };
        Self { scenario, solution, trajectory, columns: PyOnceLock::new() }
    }

    fn columns(&self, py: Python<'_>) -> PyResult<&Columns> {
        self.columns.get_or_try_init(py, || Columns::new(py, &self.trajectory))
    }

    /// The plan, if it was proven.
    ///
    /// # Errors
    /// [`Failure::NoPlan`] and [`Failure::Unproven`].
    pub fn proven(&self) -> Outcome<&Self> {
        if !self.solution.status.is_acceptable() {
            return Err(Failure::NoPlan(self.solution.status));
        }
        match self.solution.verification.failures().next() {
            Some(check) => Err(Failure::Unproven(check.clone())),
            None => Ok(self),
        }
    }
}

#[pymethods]
impl Plan {
    /// Reads a plan from the folder that `righting solve` or `save` wrote, and verifies it again.
    ///
    /// Raises
    /// ------
    /// FileError, InputError
    ///     A file cannot be read, or something in it is wrong. A plan that is wrong is none: see `verified`.
    #[staticmethod]
    fn read(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let read = py.detach(|| verify_directory(&folder));
        let Verified { solution, scenario, trajectory } =
            read.map_err(Failure::of_input(FileKind::Solution))?;
        Ok(Self::new(scenario, solution, trajectory))
    }

    /// Writes `trajectory.csv`, `solution.json` and `report.html`, the interactive page, to a folder, which is made
    /// if it is missing. Other files that it may have stay.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     A file cannot be written.
    /// NoPlanError
    ///     There is no plan to write.
    fn save(&self, folder: PathBuf) -> PyResult<()> {
        if !self.solution.has_plan() {
            return Err(Failure::NoPlan(self.solution.status).into());
        }
        let of_file = Failure::of_input(FileKind::Solution);
        let made = std::fs::create_dir_all(&folder)
            .map_err(|source| righting_scenario::Error::Write { file: folder.clone(), source });
        made.map_err(&of_file)?;
        let kinds = self.scenario.system().model.joint_kinds();
        self.trajectory.write_csv(&kinds, &folder.join(TRAJECTORY_FILE)).map_err(&of_file)?;
        self.solution.write_json(&folder.join(SOLUTION_FILE)).map_err(&of_file)?;
        let page = self.page();
        righting_scenario::file_io::replace(&folder.join("report.html"), |writer| {
            writer.write_all(page.as_bytes())
        })
        .map_err(&of_file)?;
        Ok(())
    }

    /// Name of the scenario.
    #[getter]
    fn name(&self) -> &str {
        self.scenario.name()
    }

    /// The scenario that was solved.
    #[getter]
    fn scenario(&self) -> Scenario {
        Scenario(self.scenario.clone())
    }

    /// How the optimizer ended: ``"solved"``, ``"acceptable"``, ``"infeasible"``, ``"iteration_limit"``,
    /// ``"time_limit"``, …
    #[getter]
    fn status(&self) -> String {
        word(&self.solution.status)
    }

    /// Whether the optimizer converged and every check of the independent verification passed.
    #[getter]
    fn verified(&self) -> bool {
        self.solution.status.is_acceptable() && self.solution.verification.passed
    }

    /// The verification that was made with the plan.
    #[getter]
    fn verification(&self) -> Verification {
        Verification::of(self.solution.verification.clone())
    }

    /// Verifies the plan again, from its first node and its controls alone.
    fn verify(&self, py: Python<'_>) -> Verification {
        let verify = || righting_verifier::verify(&self.scenario, &self.trajectory);
        Verification::of(py.detach(verify))
    }

    /// Returns the plan if it was verified, and raises otherwise.
    ///
    /// Raises
    /// ------
    /// NoPlanError
    ///     The optimizer did not converge; `status` says how it ended.
    /// VerificationError
    ///     The plan does not do what it claims; `check` names the first check that failed.
    fn raise_for_status(slf: PyRef<'_, Self>) -> PyResult<PyRef<'_, Self>> {
        slf.proven()?;
        Ok(slf)
    }

    /// Value of the objective, in the scenario's weights.
    #[getter]
    fn objective(&self) -> f64 {
        self.solution.objective
    }

    /// Iterations of the optimizer on the asked grid.
    #[getter]
    fn iterations(&self) -> usize {
        self.solution.iterations
    }

    /// Duration, s: the one that was chosen where the scenario leaves it free.
    #[getter]
    fn duration_s(&self) -> f64 {
        self.scenario.horizon().duration_s
    }

    /// Number of steps N.
    #[getter]
    fn steps(&self) -> usize {
        self.trajectory.steps()
    }

    /// Number of joints j.
    #[getter]
    fn joint_count(&self) -> usize {
        self.trajectory.joints()
    }

    /// Norm of the vector part of the attitude error quaternion at the end; 0 for a detumble.
    #[getter]
    fn attitude_error(&self) -> f64 {
        self.solution.terminal.attitude_error
    }

    /// Angle of the attitude error at the end, deg.
    #[getter]
    fn attitude_error_deg(&self) -> f64 {
        self.solution.terminal.attitude_error_deg
    }

    /// Norm of the base's angular rate at the end, deg/s.
    #[getter]
    fn final_rate_deg_s(&self) -> f64 {
        self.solution.terminal.angular_rate_deg_s
    }

    /// What a reader should know, a sentence each: what was assumed, what stood in the way.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.solution.notes.clone()
    }

    /// Every limit that holds along the way, at its worst place, between the nodes too.
    #[getter]
    fn limits(&self) -> Vec<Check> {
        let checks = self.solution.verification.checks.iter();
        checks.filter(|check| check.is_limit).map(Check::of).collect()
    }

    /// Everything that `solution.json` holds, as a dictionary.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.solution)
    }

    /// Times of the nodes, s. Shape (N + 1,).
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<Py<PyArray1<f64>>> {
        Ok(self.columns(py)?.time_s.clone_ref(py))
    }

    /// Position of the body frame's origin, inertial axes, m. Shape (N + 1, 3).
    #[getter]
    fn position_m(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.position_m.clone_ref(py))
    }

    /// Attitude as unit quaternions w, x, y, z (Hamilton), body to inertial axes. Shape (N + 1, 4).
    #[getter]
    fn quaternion(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.quaternion.clone_ref(py))
    }

    /// Velocity of the body frame's origin, inertial axes, m/s. Shape (N + 1, 3).
    #[getter]
    fn velocity_m_s(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.velocity_m_s.clone_ref(py))
    }

    /// Angular rate of the base, body axes, rad/s. Shape (N + 1, 3).
    #[getter]
    fn angular_rate_rad_s(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.angular_rate_rad_s.clone_ref(py))
    }

    /// Joint angles, rad. Shape (N + 1, j).
    #[getter]
    fn joint_angles_rad(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.joint_angles_rad.clone_ref(py))
    }

    /// Joint rates, rad/s. Shape (N + 1, j).
    #[getter]
    fn joint_rates_rad_s(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.joint_rates_rad_s.clone_ref(py))
    }

    /// Joint accelerations at the first node of each step, rad/s². They are held to the next node, unless jerks are
    /// limited: then they are linear. Shape (N, j).
    #[getter]
    fn joint_accelerations_rad_s2(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.joint_accelerations_rad_s2.clone_ref(py))
    }

    /// Joint jerks, held over each step, rad/s³; None where jerks are not limited. Shape (N, j).
    #[getter]
    fn joint_jerks_rad_s3(&self, py: Python<'_>) -> PyResult<Option<Py<PyArray2<f64>>>> {
        Ok(self.columns(py)?.joint_jerks_rad_s3.as_ref().map(|jerks| jerks.clone_ref(py)))
    }

    /// Joint torques at the first node of each step, N m. Shape (N, j).
    #[getter]
    fn joint_torques_n_m(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.joint_torques_n_m.clone_ref(py))
    }

    /// Mechanical power of all joints at the nodes, W. Shape (N + 1,).
    #[getter]
    fn power_w(&self, py: Python<'_>) -> PyResult<Py<PyArray1<f64>>> {
        Ok(self.columns(py)?.power_w.clone_ref(py))
    }

    /// Momenta of the wheels about their axes at the nodes, N m s. Shape (N + 1, w); (0, 0) without wheels.
    #[getter]
    fn wheel_momenta_n_m_s(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.wheel_momenta_n_m_s.clone_ref(py))
    }

    /// Torques of the wheels, held over the steps, N m. Shape (N, w); (0, 0) without wheels.
    #[getter]
    fn wheel_torques_n_m(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        Ok(self.columns(py)?.wheel_torques_n_m.clone_ref(py))
    }

    /// Joint torques and the power that they draw, counted in four ways, beside the power of reaction wheels.
    ///
    /// Parameters
    /// ----------
    /// efficiency
    ///     Overall efficiency of the joints' actuators; the paper's 0.1 by default.
    /// wheels
    ///     The wheels to compare with: the path of a file of wheels, or a mapping; by default a pyramid of four of
    ///     5 W each.
    #[pyo3(signature = (*, efficiency=None, wheels=None))]
    fn power(
        &self,
        py: Python<'_>,
        efficiency: Option<f64>,
        wheels: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Power> {
        let wheels = crate::wheels::wheels(wheels)?;
        let profile = py.detach(|| PowerProfile::new(&self.scenario, &self.trajectory));
        let drives = &self.scenario.system().drives;
        let efficiency = efficiency.unwrap_or(PAPER_EFFICIENCY);
        Ok(Power::new(profile.map_err(Failure::from)?, drives, wheels, efficiency)?)
    }

    /// Flies the plan many times with spacecraft that are not as planned: open loop, and with what is
    /// done about it. Flight i is the same whatever the number of flights.
    ///
    /// Parameters
    /// ----------
    /// flights, seed
    ///     How many, and the seed of all draws.
    /// mode
    ///     What is done about it: ``"replan"``, the rest of the maneuver is planned anew time and again; ``"feedback"``,
    ///     the gains of the plan correct every step of a slew; ``"both"``; ``"open-loop"``, nothing.
    /// period_s, deadline_ms, delay_s
    ///     Time from one replan to the next; a replan that takes longer than the deadline is missed. Time from a
    ///     measurement to the first step of the replan that it leads to.
    /// estimate_masses
    ///     Whether replans are made with the masses that the flight has shown, rather than the plan's.
    /// mass_percent, inertia_percent, center_m, mount_m
    ///     By how much masses, inertias, centers of mass and the mount are off, at most, either way.
    /// attitude_noise_deg, joint_noise_deg, joint_rate_noise_deg_s
    ///     Standard deviations of what is measured.
    ///
    /// Raises
    /// ------
    /// NoPlanError, VerificationError
    ///     The plan was not verified.
    /// InputError
    ///     An argument is not a number of its range.
    #[pyo3(signature = (flights=100, *, seed=0, mode="replan", period_s=1.0, deadline_ms=None, delay_s=0.0,
        estimate_masses=true, mass_percent=10.0, inertia_percent=10.0, center_m=0.0, mount_m=0.0, attitude_noise_deg=0.0, joint_noise_deg=0.0,
        joint_rate_noise_deg_s=0.0))]
    #[allow(clippy::too_many_arguments)] // Each has a name where it is called.
    fn fly(
        &self,
        py: Python<'_>,
        flights: usize,
        seed: u64,
        mode: &str,
        period_s: f64,
        deadline_ms: Option<f64>,
        delay_s: f64,
        estimate_masses: bool,
        mass_percent: f64,
        inertia_percent: f64,
        center_m: f64,
        mount_m: f64,
        attitude_noise_deg: f64,
        joint_noise_deg: f64,
        joint_rate_noise_deg_s: f64,
    ) -> PyResult<Flights> {
        let control = match mode {
            "replan" => Control::Replan,
            "feedback" => Control::Feedback,
            "both" => Control::Both,
            "open-loop" => Control::OpenLoop,
            other => {
                let found = format!("{other:?}");
                let expected = "\"replan\", \"feedback\", \"both\" or \"open-loop\"";
                return Err(Failure::Argument { name: "mode", found, expected }.into());
            }
        };
        let settings = Settings {
            control,
            spreads: Spreads {
                masses: share("mass_percent", mass_percent)?,
                inertias: share("inertia_percent", inertia_percent)?,
                centers_m: not_negative("center_m", center_m)?,
                mount_m: not_negative("mount_m", mount_m)?,
            },
            sensors: Sensors {
                attitude_rad: not_negative("attitude_noise_deg", attitude_noise_deg)?.to_radians(),
                joint_angle_rad: not_negative("joint_noise_deg", joint_noise_deg)?.to_radians(),
                joint_rate_rad_s: not_negative("joint_rate_noise_deg_s", joint_rate_noise_deg_s)?
                    .to_radians(),
            },
            period_s: above_zero("period_s", period_s)?,
            deadline: deadline_ms.map(|ms| seconds("deadline_ms", ms / 1e3)).transpose()?,
            delay_s: not_negative("delay_s", delay_s)?,
            estimates_masses: estimate_masses,
            seed,
            ..Settings::default()
        };
        Ok(Flights::of(py, self.proven()?, settings, flights)?)
    }

    /// Writes the plan or its system in the format of another program; the files written.
    ///
    /// Parameters
    /// ----------
    /// format
    ///     ``"urdf"``, ``"mjcf"``, ``"joint-trajectory"`` (JSON where the file ends in .json, else YAML), ``"ck"`` (with
    ///     clock and frame kernels beside it), ``"stk"``, ``"aem"``, ``"npz"``, ``"mat"``, ``"basilisk"`` or
    ///     ``"mujoco"``.
    /// file
    ///     Where to; its folder is made if it is missing.
    /// epoch
    ///     AEM, STK, CK: time of the first node, such as ``"2027-03-01T12:00:00"``; 2000-01-01T12:00:00 by default.
    /// frame
    ///     AEM, STK, CK: the inertial frame; EME2000 by default.
    /// time_system, object_name
    ///     AEM, CK: UTC and the system's name by default.
    /// object_id, originator
    ///     AEM: UNKNOWN and RIGHTING by default.
    /// naif_id
    ///     CK: NAIF's number of the spacecraft, below zero; -999 by default.
    ///
    /// Raises
    /// ------
    /// NoPlanError, VerificationError
    ///     The plan was not verified.
    /// InputError
    ///     There is no such format, it does not take one of the arguments, or a value is not one that it takes.
    #[pyo3(signature = (format, file, **message))]
    fn export(
        &self,
        format: &str,
        file: PathBuf,
        message: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Vec<PathBuf>> {
        Ok(export(self, format, &file, message)?)
    }

    /// The interactive page, an HTML document that opens from disk and loads nothing.
    fn page(&self) -> String {
        righting_report::report_html(&self.scenario, &self.solution, &self.trajectory)
    }

    /// Shows the interactive page: inline in a notebook, `height` pixels high; elsewhere in a browser, and the file is
    /// returned.
    #[pyo3(signature = (*, height = 760))]
    fn show<'py>(slf: &Bound<'py, Self>, height: u32) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("righting._show")?.call_method1("show", (slf, height))
    }

    /// A figure of matplotlib with six axes over time: attitude, angular rate, and the joints' angles, rates,
    /// accelerations and torques.
    fn plot<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("righting._plot")?.call_method1("plot", (slf,))
    }

    /// A plan from what `__reduce__` gave: its solution as JSON, and its arrays.
    #[staticmethod]
    fn _of(solution: &str, arrays: &Bound<'_, PyTuple>) -> PyResult<Self> {
        let solution: Solution = serde_json::from_str(solution)
            .map_err(|error| PyValueError::new_err(format!("solution: {error}")))?;
        let name = named(None, "scenario");
        let scenario = righting_scenario::Scenario::from_file(solution.scenario.clone(), &name);
        let scenario = scenario.map_err(Failure::of_input(FileKind::Solution))?;
        Ok(Self::new(scenario, solution, trajectory(arrays)?))
    }

    #[allow(clippy::type_complexity)] // What pickle asks for.
    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (String, Bound<'py, PyTuple>))> {
        let (py, plan) = (slf.py(), slf.get());
        let solution = serde_json::to_string(&plan.solution)
            .map_err(|error| PyValueError::new_err(error.to_string()))?;
        let arrays = to_tuple(py, plan.columns(py)?)?;
        Ok((slf.get_type().getattr("_of")?, (solution, arrays)))
    }

    /// The summary that `righting solve` prints.
    fn __str__(&self) -> String {
        righting_report::summary(&self.solution, &[])
    }

    fn __repr__(&self) -> String {
        let verdict = match self.verified() {
            true => "verified".to_owned(),
            false if self.solution.status.is_acceptable() => "NOT VERIFIED".to_owned(),
            false if self.solution.has_plan() => {
                format!("verified, not optimal: {}", self.status())
            }
            false => format!("NO PLAN, {}", self.status()),
        };
        let asked = righting_report::maneuver_phrase(&self.solution);
        format!("Plan({:?}: {asked}, {} steps, {verdict})", self.name(), self.steps())
    }
}
