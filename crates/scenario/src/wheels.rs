//! Arrays of reaction wheels.

use std::path::Path;

use nalgebra::Vector3;
use righting_multibody::Units;
use righting_scalar::Scalar;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::file;
use crate::json::{Bounds, Document, FileKind, Location, Number};

/// The most wheels an array may have.
pub const MAX_WHEELS: usize = 16;

const LIMIT: Bounds = Bounds::Above(0.0, 1e6);
const AXIS: Bounds = Bounds::Between(-1e6, 1e6);
const FRICTION: Bounds = Bounds::Between(0.0, 1e6);
const POWER: Bounds = Bounds::Between(0.0, 1e6);
/// What a wheel of a small spacecraft takes while it just spins: the paper's figure.
const STEADY_POWER_W: f64 = 5.0;

/// A reaction wheel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Wheel {
    /// Its axis, body axes, a unit vector.
    pub axis: [f64; 3],
    /// The most momentum it stores either way, N m s.
    pub momentum_max_n_m_s: f64,
    /// The most torque its motor gives either way, N m.
    pub torque_max_n_m: f64,
    /// Power it takes while it spins steadily, W.
    pub steady_power_w: f64,
    /// Momentum it stores at the start about its axis, relative to the base, N m s.
    pub initial_momentum_n_m_s: f64,
    /// Inertia of the rotor about its axis, kg m²; none where it is not known.
    pub inertia_kg_m2: Option<f64>,
    /// Viscous friction of its bearing, N m s (a rad); zero where the inertia is not known.
    pub viscous_friction_n_m_s: f64,
    /// Whether it gives no torque.
    pub failed: bool,
}

impl Wheel {
    /// Checks a wheel that was read from `place`.
    fn from_file(row: &file::Wheel, place: &Location) -> Result<Self, Error> {
        let axis_place = place.key("axis");
        axis_place.all_within(row.axis, AXIS)?;
        let axis = Vector3::from(row.axis).try_normalize(1e-9);
        let axis =
            axis.ok_or_else(|| axis_place.refuse("[0, 0, 0]", "a vector that is not zero"))?;
        let limit = |name: &str, value| place.key(name).within(value, LIMIT);
        let most = limit("momentum_max_n_m_s", row.momentum_max_n_m_s)?;
        let stored = row.initial_momentum_n_m_s.unwrap_or(0.0);
        let stored_place = place.key("initial_momentum_n_m_s");
        Ok(Self {
            axis: axis.into(),
            momentum_max_n_m_s: most,
            torque_max_n_m: limit("torque_max_n_m", row.torque_max_n_m)?,
            steady_power_w: match row.steady_power_w {
                Some(power_w) => place.key("steady_power_w").within(power_w, POWER)?,
                None => STEADY_POWER_W,
            },
            initial_momentum_n_m_s: stored_place.within(stored, Bounds::Between(-most, most))?,
            inertia_kg_m2: row
                .inertia_kg_m2
                .map(|inertia| place.key("inertia_kg_m2").within(inertia, LIMIT))
                .transpose()?,
            viscous_friction_n_m_s: match (row.viscous_friction_n_m_s, row.inertia_kg_m2) {
                (None, _) => 0.0,
                (Some(friction), Some(_)) => {
                    place.key("viscous_friction_n_m_s").within(friction, FRICTION)?
                }
                (Some(_), None) => {
                    let expected = "the rotor's inertia, which goes with viscous_friction_n_m_s";
                    return Err(place.key("inertia_kg_m2").missing(expected));
                }
            },
            failed: row.failed,
        })
    }

    /// Speed of the rotor relative to the base where it stores a momentum (N m s), rad/s; none where its inertia is not
    /// known.
    pub fn speed_rad_s(&self, momentum_n_m_s: f64) -> Option<f64> {
        self.inertia_kg_m2.map(|inertia| momentum_n_m_s / inertia)
    }

    /// What friction takes for each unit of momentum that is in store, 1/s.
    pub fn friction_1_s(&self) -> f64 {
        self.speed_rad_s(self.viscous_friction_n_m_s).unwrap_or(0.0)
    }

    /// Torque of the motor where a torque changes what the wheel stores, N m: that and what friction takes.
    pub fn motor_torque_n_m(&self, torque_n_m: f64, momentum_n_m_s: f64) -> f64 {
        torque_n_m + self.friction_1_s() * momentum_n_m_s
    }

    /// Checks wheels that were read from `place`.
    pub(crate) fn all_from_file(
        rows: &[file::Wheel],
        place: &Location,
    ) -> Result<Vec<Self>, Error> {
        if rows.len() > MAX_WHEELS {
            let allowed = format!("an array of at most {MAX_WHEELS} wheels");
            return Err(place.refuse(format!("{} wheels", rows.len()), allowed));
        }
        let rows = rows.iter().enumerate();
        rows.map(|(index, row)| Self::from_file(row, &place.index(index))).collect()
    }

    pub(crate) fn in_units(&self, units: &Units) -> Self {
        let momentum = units.torque_n_m() * units.time_s;
        Self {
            momentum_max_n_m_s: self.momentum_max_n_m_s / momentum,
            torque_max_n_m: self.torque_max_n_m / units.torque_n_m(),
            initial_momentum_n_m_s: self.initial_momentum_n_m_s / momentum,
            inertia_kg_m2: self
                .inertia_kg_m2
                .map(|inertia| inertia / (units.mass_kg * units.length_m.powi(2))),
            viscous_friction_n_m_s: self.viscous_friction_n_m_s / momentum,
            ..*self
        }
    }
}

/// Whether any wheel works.
pub fn any_works(wheels: &[Wheel]) -> bool {
    wheels.iter().any(|wheel| !wheel.failed)
}

/// What wheels store at the start together, body axes, N m s.
pub fn stored_at_start<'w>(wheels: impl IntoIterator<Item = &'w Wheel>) -> Vector3<f64> {
    let wheels = wheels.into_iter();
    wheels.map(|wheel| Vector3::from(wheel.axis) * wheel.initial_momentum_n_m_s).sum()
}

/// What wheels do to a base that turns at ω, as a couple on it, body axes, N m: −(τ + ω × h), with the momentum h that
/// is in store and the torque τ that is given, its rate.
pub fn reaction<T: Scalar>(
    angular_rate: &Vector3<T>,
    in_store: &Vector3<T>,
    given: &Vector3<T>,
) -> Vector3<T> {
    let (w, h) = (angular_rate, in_store);
    Vector3::new(
        w.z * h.y - w.y * h.z - given.x,
        w.x * h.z - w.z * h.x - given.y,
        w.y * h.x - w.x * h.y - given.z,
    )
}

/// The sum of the wheels' momenta (N m s), or torques (N m), as a vector in body axes; one value a wheel.
pub fn stored<T: Scalar>(wheels: &[Wheel], momenta: &[T]) -> Vector3<T> {
    let zero = Vector3::from_element(T::from(0.0));
    wheels.iter().zip(momenta).fold(zero, |sum, (wheel, &momentum)| {
        Vector3::from_fn(|i, _| sum[i] + momentum * wheel.axis[i])
    })
}

/// Checks the momenta of the wheels at an end that was read from `place`; none where a wheel's is free.
pub(crate) fn end_momenta(
    momenta: Option<&[Option<f64>]>,
    wheels: &[Wheel],
    place: &Location,
) -> Result<Vec<Option<f64>>, Error> {
    let Some(momenta) = momenta else { return Ok(vec![None; wheels.len()]) };
    if momenta.len() != wheels.len() {
        let allowed = format!("an array of {}, one a wheel", wheels.len());
        return Err(place.refuse(format!("an array of {}", momenta.len()), allowed));
    }
    let given = momenta.iter().zip(wheels).enumerate();
    given
        .map(|(index, (momentum, wheel))| {
            let Some(momentum) = *momentum else { return Ok(None) };
            let place = place.index(index);
            let most = wheel.momentum_max_n_m_s;
            place.within(momentum, Bounds::Between(-most, most))?;
            if wheel.failed && momentum != wheel.initial_momentum_n_m_s {
                let kept = Number(wheel.initial_momentum_n_m_s);
                return Err(place.refuse(
                    Number(momentum),
                    format_args!("{kept}, or null: the wheel has failed and keeps its momentum"),
                ));
            }
            Ok(Some(momentum))
        })
        .collect()
}

/// Wheels about any axes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WheelArray {
    wheels: Vec<Wheel>,
}

/// An array of reaction wheels.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "an object with `wheels`")]
#[schemars(title = "Righting wheels")]
pub(crate) struct WheelFile {
    /// The wheels, in any order.
    #[schemars(length(min = 1, max = 16))]
    wheels: Vec<file::Wheel>,
}

impl WheelArray {
    /// Four wheels of 1 N m s, 0.1 N m and 5 W with their axes along the diagonals (±1, ±1, 1)/√3 of the
    /// body, 35.26° above its xy plane: the pyramid that reaches as far along x, y and z.
    pub fn pyramid() -> Self {
        let wheel = |x: f64, y: f64| Wheel {
            axis: [x, y, 1.0].map(|entry| entry / 3.0_f64.sqrt()),
            momentum_max_n_m_s: 1.0,
            torque_max_n_m: 0.1,
            steady_power_w: STEADY_POWER_W,
            initial_momentum_n_m_s: 0.0,
            inertia_kg_m2: None,
            viscous_friction_n_m_s: 0.0,
            failed: false,
        };
        Self {
            wheels: vec![wheel(1.0, 1.0), wheel(-1.0, 1.0), wheel(-1.0, -1.0), wheel(1.0, -1.0)],
        }
    }

    /// Reads `{"wheels": [{"axis": [x, y, z], "momentum_max_n_m_s": …, "torque_max_n_m": …}, …]}`,
    /// each with its `steady_power_w` where that is not 5.
    ///
    /// # Errors
    /// Those of reading, and [`Error::Field`] for a field that is wrong.
    pub fn read(file: &Path) -> Result<Self, Error> {
        Self::checked(&Document::read(file, FileKind::Wheels)?.decode()?, file)
    }

    /// The same of the text of a file; `file` names it in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, Error> {
        Self::checked(&Document::parse(file, text, FileKind::Wheels)?.decode()?, file)
    }

    fn checked(rows: &WheelFile, file: &Path) -> Result<Self, Error> {
        let place = Location::root(file).key("wheels");
        if !(1..=MAX_WHEELS).contains(&rows.wheels.len()) {
            let allowed = format!("an array of 1 to {MAX_WHEELS} wheels");
            return Err(place.refuse(format!("{} wheels", rows.wheels.len()), allowed));
        }
        Ok(Self { wheels: Wheel::all_from_file(&rows.wheels, &place)? })
    }

    /// The wheels of a scenario, failed ones among them; none where it has none.
    pub fn of(wheels: &[Wheel]) -> Option<Self> {
        (!wheels.is_empty()).then(|| Self { wheels: wheels.to_vec() })
    }

    /// The wheels.
    pub fn wheels(&self) -> &[Wheel] {
        &self.wheels
    }

    /// Power that all wheels that work take while they spin steadily, W.
    pub fn steady_power_w(&self) -> f64 {
        self.wheels.iter().filter(|wheel| !wheel.failed).map(|wheel| wheel.steady_power_w).sum()
    }
}
