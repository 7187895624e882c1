//! Where instruments may look.

use nalgebra::Vector3;
use righting_multibody::Quaternion;

use crate::error::Error;
use crate::file;
use crate::initial::Initial;
use crate::json::{Bounds, Location, Number};
use crate::maneuver::Maneuver;
use crate::rounding::COMPUTED;
use crate::waypoints::Waypoint;

const COMPONENT: Bounds = Bounds::Between(-1e12, 1e12);
/// Shorter than this, the square of a vector is lost.
const SHORTEST: f64 = 1e-150;
const TIME_S: Bounds = Bounds::Between(-1e12, 1e12);
/// Times of a table at most.
const MOST_TIMES: usize = 1000;
const HALF_ANGLE_DEG: Bounds = Bounds::Above(0.0, 180.0);

/// An instrument and the cone that its boresight keeps out of, or stays in, all the time.
#[derive(Clone, Debug, PartialEq)]
pub struct Pointing {
    /// Name; each of its own.
    pub name: String,
    /// Unit vector along which the instrument looks, body axes.
    pub boresight: Vector3<f64>,
    /// The cone's axis.
    pub direction: Direction,
    /// Which side of the cone is allowed.
    pub side: ConeSide,
    /// Half-angle of the cone, rad.
    pub half_angle_rad: f64,
}

/// A direction in inertial axes, fixed or moving.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// Times from the start of the maneuver, s, each later than the one before; one where the direction is
    /// fixed.
    pub times_s: Vec<f64>,
    /// Unit vector at each of them. Between two the direction is that of the vector in between, linear in time.
    pub vectors: Vec<Vector3<f64>>,
}

impl Direction {
    /// Whether it never moves.
    pub fn is_fixed(&self) -> bool {
        self.vectors.len() == 1
    }

    /// Unit vector at a time from the start of the maneuver; before the first and after the last that is given
    /// it stays.
    pub fn at(&self, time_s: f64) -> Vector3<f64> {
        let after = self.times_s.partition_point(|&time| time <= time_s);
        let Some(before) = after.checked_sub(1) else { return self.vectors[0] };
        let (Some(&end_s), &start_s) = (self.times_s.get(after), &self.times_s[before]) else {
            return self.vectors[before];
        };
        let share = (time_s - start_s) / (end_s - start_s);
        (self.vectors[before] * (1.0 - share) + self.vectors[after] * share).normalize()
    }

    fn fixed(vector: Vector3<f64>) -> Self {
        Self { times_s: vec![0.0], vectors: vec![vector] }
    }

    /// Checks a table that was read from `place`, for a maneuver of this duration.
    fn from_table(
        table: &file::DirectionTable,
        duration_s: f64,
        place: &Location,
    ) -> Result<Self, Error> {
        let (times_place, vectors_place) = (place.key("t_s"), place.key("vectors"));
        let times_s = &table.t_s;
        if !(2..=MOST_TIMES).contains(&times_s.len()) {
            let found = format!("an array of {}", times_s.len());
            return Err(times_place.refuse(found, format_args!("2 to {MOST_TIMES} times")));
        }
        if table.vectors.len() != times_s.len() {
            let found = format!("an array of {}", table.vectors.len());
            let expected = format!("an array of {}, one a time", times_s.len());
            return Err(vectors_place.refuse(found, expected));
        }
        for (index, &time_s) in times_s.iter().enumerate() {
            let place = times_place.index(index);
            place.within(time_s, TIME_S)?;
            if index > 0 && time_s <= times_s[index - 1] {
                let before = Number(times_s[index - 1]);
                return Err(place.refuse(Number(time_s), format_args!("more than {before}")));
            }
        }
        let (first, last) = (times_s[0], times_s[times_s.len() - 1]);
        if first > 0.0 {
            let expected = "0 or less: the table covers the maneuver";
            return Err(times_place.index(0).refuse(Number(first), expected));
        }
        if last < duration_s {
            let duration = Number(duration_s);
            return Err(times_place.index(times_s.len() - 1).refuse(
                Number(last),
                format_args!(
                    "{duration}, horizon.duration_s, or more: the table covers the maneuver"
                ),
            ));
        }
        let vectors = table.vectors.iter().enumerate();
        let vectors: Vec<Vector3<f64>> = vectors
            .map(|(index, &vector)| unit(vector, &vectors_place.index(index)))
            .collect::<Result<_, _>>()?;
        for (index, pair) in vectors.windows(2).enumerate() {
            if pair[0].dot(&pair[1]) <= 0.0 {
                let turn_deg = Number::rounded(angle_rad(&pair[0], &pair[1]).to_degrees(), 4);
                return Err(vectors_place.index(index + 1).refuse(
                    format_args!("a direction {turn_deg}\u{b0} from the one before"),
                    "less than 90\u{b0}: times closer together",
                ));
            }
        }
        Ok(Self { times_s: times_s.clone(), vectors })
    }
}

/// The side of a cone on which a boresight stays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConeSide {
    /// Outside: the angle is at least the half-angle.
    Outside,
    /// Inside: the angle is at most the half-angle.
    Inside,
}

impl Pointing {
    /// The angle between the boresight and the cone's axis in an attitude (body → inertial, of any length) at a
    /// time from the start of the maneuver, rad.
    pub fn angle_rad(&self, attitude: &Quaternion<f64>, time_s: f64) -> f64 {
        let looks = attitude.normalized().to_inertial(&self.boresight);
        angle_rad(&looks, &self.direction.at(time_s))
    }

    /// How far an angle is on the wrong side of the cone, rad; negative where it is on the right one.
    pub fn excess_rad(&self, angle_rad: f64) -> f64 {
        match self.side {
            ConeSide::Outside => self.half_angle_rad - angle_rad,
            ConeSide::Inside => angle_rad - self.half_angle_rad,
        }
    }

    fn from_file(
        pointing: &file::Pointing,
        duration_s: f64,
        place: &Location,
    ) -> Result<Self, Error> {
        if pointing.name.trim().is_empty() {
            return Err(place.key("name").refuse("\"\"", "a name"));
        }
        let boresight = unit(pointing.boresight_body, &place.key("boresight_body"))?;
        let direction_place = place.key("direction_inertial");
        let direction = match (pointing.direction_inertial, &pointing.direction_table) {
            (Some(direction), None) => Direction::fixed(unit(direction, &direction_place)?),
            (None, None) => {
                return Err(direction_place.missing("the direction, or a direction_table"));
            }
            (Some(_), Some(_)) => {
                return Err(place
                    .key("direction_table")
                    .refuse("both direction_inertial and direction_table", "one of them"));
            }
            (None, Some(table)) => {
                Direction::from_table(table, duration_s, &place.key("direction_table"))?
            }
        };
        let keep_in_place = place.key("keep_in_deg");
        let keep_out_place = place.key("keep_out_deg");
        let (side, half_angle_deg) = match (pointing.keep_out_deg, pointing.keep_in_deg) {
            (Some(angle), None) => {
                (ConeSide::Outside, keep_out_place.within(angle, HALF_ANGLE_DEG)?)
            }
            (None, Some(angle)) => (ConeSide::Inside, keep_in_place.within(angle, HALF_ANGLE_DEG)?),
            (None, None) => {
                return Err(keep_out_place.missing("the half-angle of the cone, or keep_in_deg"));
            }
            (Some(_), Some(_)) => {
                return Err(
                    keep_in_place.refuse("both keep_out_deg and keep_in_deg", "one of them")
                );
            }
        };
        let half_angle_rad = half_angle_deg.to_radians();
        Ok(Self { name: pointing.name.clone(), boresight, direction, side, half_angle_rad })
    }

    /// Refuses a maneuver that asks for an attitude on the wrong side.
    fn check(
        &self,
        (attitude, time_s): (&Quaternion<f64>, f64),
        which: &str,
        place: &Location,
    ) -> Result<(), Error> {
        let angle_rad = self.angle_rad(attitude, time_s);
        if self.excess_rad(angle_rad) <= COMPUTED {
            return Ok(());
        }
        let (field, sense) = match self.side {
            ConeSide::Outside => ("keep_out_deg", "at least"),
            ConeSide::Inside => ("keep_in_deg", "at most"),
        };
        let [angle, half_angle] =
            [angle_rad, self.half_angle_rad].map(|angle| Number::rounded(angle.to_degrees(), 6));
        Err(place.key(field).refuse(
            format_args!("{which} {angle}\u{b0} from the direction of \"{}\"", self.name),
            format_args!("{sense} {half_angle}\u{b0}"),
        ))
    }
}

/// Checks the cones that were read from `place`, and that the maneuver starts, and is asked to pass and to end, on
/// their right side. Where a direction moves in a maneuver whose duration is free, nobody knows yet where it is in the end.
pub(crate) fn pointing(
    given: &[file::Pointing],
    (initial, maneuver, waypoints): (&Initial, &Maneuver, &[Waypoint]),
    (longest_s, is_duration_free): (f64, bool),
    place: &Location,
) -> Result<Vec<Pointing>, Error> {
    let mut checked: Vec<Pointing> = Vec::with_capacity(given.len());
    for (index, given) in given.iter().enumerate() {
        let place = place.index(index);
        let pointing = Pointing::from_file(given, longest_s, &place)?;
        if checked.iter().any(|other| other.name == pointing.name) {
            let found = format!("\"{}\" again", pointing.name);
            return Err(place.key("name").refuse(found, "a name of its own"));
        }
        pointing.check((&initial.attitude, 0.0), "a start", &place)?;
        let is_end_known = pointing.direction.is_fixed() || !is_duration_free;
        if let (Maneuver::Slew(slew), true) = (maneuver, is_end_known) {
            pointing.check((&slew.target, longest_s), "a target", &place)?;
        }
        for waypoint in waypoints {
            for share in [waypoint.arrival, waypoint.departure] {
                pointing.check((&waypoint.target, share * longest_s), "a waypoint", &place)?;
            }
        }
        checked.push(pointing);
    }
    Ok(checked)
}

/// Angle between two unit vectors, rad; exact for small ones too.
fn angle_rad(a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

fn unit(vector: [f64; 3], place: &Location) -> Result<Vector3<f64>, Error> {
    place.all_within(vector, COMPONENT)?;
    Vector3::from(vector).try_normalize(SHORTEST).ok_or_else(|| {
        let [x, y, z] = vector.map(Number);
        place.refuse(format!("[{x}, {y}, {z}]"), "a vector that is not zero")
    })
}
