//! Arrays of reaction wheels.

use std::path::Path;

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::json::{Bounds, Document, FileKind, Location};

/// The most wheels an array may have.
pub const MAX_WHEELS: usize = 16;

const LIMIT: Bounds = Bounds::Above(0.0, 1e6);
const AXIS: Bounds = Bounds::Between(-1e6, 1e6);
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
    /// The most torque it gives either way, N m.
    pub torque_max_n_m: f64,
    /// Power it takes while it spins steadily, W.
    pub steady_power_w: f64,
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
    wheels: Vec<WheelRow>,
}

/// A reaction wheel.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a wheel")]
#[schemars(rename = "Wheel")]
struct WheelRow {
    /// Its axis in body axes, of any length but zero.
    axis: [f64; 3],
    /// The most momentum it stores either way, N m s.
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    momentum_max_n_m_s: f64,
    /// The most torque it gives either way, N m.
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    torque_max_n_m: f64,
    /// Power it takes while it spins steadily, W; 5 by default.
    #[serde(default)]
    #[schemars(range(min = 0, max = 1e6))]
    steady_power_w: Option<f64>,
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
        Self::of(&Document::read(file, FileKind::Wheels)?.decode()?, file)
    }

    /// The same of the text of a file; `file` names it in errors.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, Error> {
        Self::of(&Document::parse(file, text, FileKind::Wheels)?.decode()?, file)
    }

    fn of(rows: &WheelFile, file: &Path) -> Result<Self, Error> {
        let place = Location::root(file).key("wheels");
        if !(1..=MAX_WHEELS).contains(&rows.wheels.len()) {
            let allowed = format!("an array of 1 to {MAX_WHEELS} wheels");
            return Err(place.refuse(format!("{} wheels", rows.wheels.len()), allowed));
        }
        let wheel = |(index, row): (usize, &WheelRow)| {
            let place = place.index(index);
            let axis_place = place.key("axis");
            axis_place.all_within(row.axis, AXIS)?;
            let axis = Vector3::from(row.axis).try_normalize(1e-9);
            let axis =
                axis.ok_or_else(|| axis_place.refuse("[0, 0, 0]", "a vector that is not zero"))?;
            let limit = |name: &str, value| place.key(name).within(value, LIMIT);
            Ok(Wheel {
                axis: axis.into(),
                momentum_max_n_m_s: limit("momentum_max_n_m_s", row.momentum_max_n_m_s)?,
                torque_max_n_m: limit("torque_max_n_m", row.torque_max_n_m)?,
                steady_power_w: match row.steady_power_w {
                    Some(power_w) => place.key("steady_power_w").within(power_w, POWER)?,
                    None => STEADY_POWER_W,
                },
            })
        };
        let wheels: Result<_, Error> = rows.wheels.iter().enumerate().map(wheel).collect();
        Ok(Self { wheels: wheels? })
    }

    /// The wheels of a file, or [the pyramid](Self::pyramid) where none is named.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn read_or_pyramid(file: Option<&Path>) -> Result<Self, Error> {
        file.map_or_else(|| Ok(Self::pyramid()), Self::read)
    }

    /// The wheels.
    pub fn wheels(&self) -> &[Wheel] {
        &self.wheels
    }

    /// Power that all wheels take while they spin steadily, W.
    pub fn steady_power_w(&self) -> f64 {
        self.wheels.iter().map(|wheel| wheel.steady_power_w).sum()
    }
}
