//! Systems from URDF files.

use std::path::{Path, PathBuf};

use nalgebra::{Matrix3, Vector3};
use righting_import::{
    BaseOption, Body, Capsule, ImportError, MovingJoint, Options, ReadOptions, Robot, Shape, System,
};
use righting_multibody::{self as multibody, Placement, RigidBody};

use crate::error::Error;
use crate::file::{self, JointType, SystemOptions};
use crate::file_io;
use crate::json::{Bounds, Location};
use crate::system_description::{LENGTH_M, base};
use crate::system_file::SystemFile;

/// The ending by which a path says that it is a URDF file's.
const EXTENSION: &str = "urdf";
const ANGLE_DEG: Bounds = Bounds::Between(-360.0, 360.0);
const COORDINATE: Bounds = Bounds::Between(-1e6, 1e6);

/// Whether a path is that of a robot rather than of a system file.
pub(crate) fn is_urdf(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Reads a robot from a URDF file, puts it together as `options` say, and checks it like any system.
/// Complaints about options name the URDF file.
///
/// # Errors
/// Those of reading, [`Error::Robot`] for what is wrong with the robot, [`Error::Field`] for an option or
/// what follows from it.
pub fn import_urdf(file: &Path, options: &SystemOptions) -> Result<SystemFile, Error> {
    let mut notes = Vec::new();
    let system = system_from_urdf(file, options, &Location::root(file), &mut notes)?;
    SystemFile::noted(system, file, notes)
}

/// Reads a robot from a URDF file as the system file that `options` make of it; `place` is where they
/// stand. What was assumed is said in `notes`.
///
/// Bodies have the names of the links that joints move, and joints their own. A base that is a link has
/// that link's frame as body frame. Boxes of moving bodies become capsules around them; on the base they
/// stay boxes where they lie along its axes. Bodies on joints of the base are exempt from its keep-out
/// shapes, which they touch.
///
/// # Errors
/// Those of reading, [`Error::Robot`] for what is wrong with the robot, [`Error::Field`] for an option.
pub(crate) fn system_from_urdf(
    file: &Path,
    options: &SystemOptions,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<file::System, Error> {
    let text = file_io::read(file, "a URDF file", file_io::JSON_LIMIT_BYTES)?;
    let refused = |error| refuse(error, file, place);
    let read_options = ReadOptions {
        folder: Some(folder_of(file)),
        point_masses: options.point_masses,
        project_inertias: options.project_inertias,
    };
    let robot = Robot::from_urdf(&text, &read_options).map_err(refused)?;
    let system = robot.system(&taken(options, &robot, place)?).map_err(refused)?;
    // The folder is known, and the same in every note.
    let name = file.file_name().unwrap_or_default().display();
    notes.extend(system.notes.iter().map(|note| format!("{name}: {note}")));
    let base = whole_base(&system, options, &place.key("on"))?;
    let base_name = base.name().to_owned();
    let mut bodies = Vec::new();
    for body in &system.bodies {
        let parent = match body.parent {
            Some(index) => system.bodies[index].name.clone(),
            None => base_name.clone(),
        };
        bodies.push(self::body(body, parent, options, place, notes)?);
    }
    Ok(file::System {
        name: system.name,
        description: None,
        base,
        mount: None,
        dh_convention: None,
        links: Vec::new(),
        bodies: Some(bodies),
        project_inertias: false,
        payload: None,
        ignored_pairs: None,
    })
}

/// An error of the robot in its file, or of an option at its place.
fn refuse(error: ImportError, file: &Path, place: &Location) -> Error {
    match error {
        ImportError::Option { option, found, expected } => {
            place.key(&option.to_string()).refuse(found, expected)
        }
        source => Error::Robot { file: file.to_owned(), source },
    }
}

/// The options in the words of the importer.
fn taken(options: &SystemOptions, robot: &Robot, place: &Location) -> Result<Options, Error> {
    let mount = mount(options, place)?;
    let base = match (&options.base, &options.on) {
        (Some(link), None) => BaseOption::Link(link.clone()),
        (None, Some(_)) => BaseOption::Mounted(mount),
        (Some(_), Some(_)) => {
            return Err(place.key("on").refuse("both base and on", "one of them"));
        }
        (None, None) => {
            let expected = format!(
                "the link that floats, such as the root \"{}\", or `on` with the base that the root is \
                 fixed to",
                robot.root()
            );
            return Err(place.key("base").missing(expected));
        }
    };
    let mut locked = std::collections::BTreeMap::new();
    for (joint, &value) in &options.locked {
        let value = place.key("locked").key(joint).within(value, COORDINATE)?;
        let is_sliding = robot.is_sliding(joint).unwrap_or(false);
        locked.insert(joint.clone(), if is_sliding { value } else { value.to_radians() });
    }
    Ok(Options { base, tip: options.tip.clone(), locked, dropped: options.dropped.clone() })
}

fn mount(options: &SystemOptions, place: &Location) -> Result<Placement, Error> {
    let [position_place, angles_place] =
        ["mount_position_m", "mount_rpy_deg"].map(|key| place.key(key));
    if options.on.is_none() {
        let given = options.mount_position_m.map(|_| &position_place);
        if let Some(place) = given.or(options.mount_rpy_deg.map(|_| &angles_place)) {
            return Err(
                place.refuse("a mount without `on`", "`on`, the base to mount the robot on")
            );
        }
    }
    let position_m = options.mount_position_m.unwrap_or_default();
    let angles_deg = options.mount_rpy_deg.unwrap_or_default();
    let position_m = position_place.all_within(position_m, LENGTH_M)?;
    let angles_deg = angles_place.all_within(angles_deg, ANGLE_DEG)?;
    Ok(Placement::from_roll_pitch_yaw(position_m.into(), angles_deg.map(f64::to_radians)))
}

/// The base: the floating link, or the given one with what is fixed to it.
fn whole_base(
    system: &System,
    options: &SystemOptions,
    place: &Location,
) -> Result<file::Base, Error> {
    let Some(given) = &options.on else {
        let mut base = file::Base { name: Some(system.base_name.clone()), ..file::Base::default() };
        set_body(&mut base, &system.base);
        base.keep_out = Some(keep_out(&system.base_shapes));
        return Ok(base);
    };
    let mut base = given.clone();
    if system.base.mass_kg == 0.0 && system.base_shapes.is_empty() {
        return Ok(base);
    }
    let (multibody::Base { mass_kg, center_of_mass_m, inertia_kg_m2 }, keep_out_radius_m) =
        self::base(given, place)?;
    // What a cube keeps out without being asked stays, whatever is added to it.
    base.keep_out_radius_m = keep_out_radius_m;
    if system.base.mass_kg > 0.0 {
        let alone = RigidBody { mass_kg, center_of_mass_m, inertia_kg_m2 };
        let whole = alone.joined(&system.base, &Placement::identity());
        base.cube_side_m = None;
        set_body(&mut base, &whole);
    }
    if !system.base_shapes.is_empty() {
        base.keep_out.get_or_insert_default().extend(keep_out(&system.base_shapes));
    }
    Ok(base)
}

fn set_body(base: &mut file::Base, body: &RigidBody) {
    base.mass_kg = body.mass_kg;
    base.center_of_mass_m = Some(array(&body.center_of_mass_m));
    base.inertia_kg_m2 = Some(rows(&body.inertia_kg_m2));
}

fn body(
    body: &Body,
    parent: String,
    options: &SystemOptions,
    place: &Location,
    notes: &mut Vec<String>,
) -> Result<file::Body, Error> {
    let RigidBody { mass_kg, center_of_mass_m, inertia_kg_m2 } = body.body;
    let boxes = body.shapes.iter().filter(|shape| matches!(shape, Shape::Cuboid(_))).count();
    if boxes > 0 {
        notes.push(format!("{}: a capsule stands for each box of its shape ({boxes})", body.name));
    }
    Ok(file::Body {
        name: body.name.clone(),
        parent,
        joint: joint(&body.joint, options, place)?,
        mass_kg,
        center_of_mass_m: (mass_kg > 0.0).then(|| array(&center_of_mass_m)),
        inertia_kg_m2: (mass_kg > 0.0).then(|| rows(&inertia_kg_m2)),
        shapes: Some(capsules(&body.shapes)),
        body_exempt: body.parent.is_none(),
    })
}

fn joint(
    joint: &MovingJoint,
    options: &SystemOptions,
    place: &Location,
) -> Result<file::Joint, Error> {
    let is_limited = joint.lower.is_finite() || joint.upper.is_finite();
    let angles = joint.placement.roll_pitch_yaw_rad().map(degrees);
    let placed = file::Joint {
        name: Some(joint.name.clone()),
        position_m: Some(array(&joint.placement.position_m)),
        rpy_deg: angles.iter().any(|angle| *angle != 0.0).then_some(angles),
        axis: Some(array(&joint.axis)),
        ..file::Joint::of_kind(match (joint.is_sliding, is_limited) {
            (true, _) => JointType::Prismatic,
            (false, true) => JointType::Revolute,
            (false, false) => JointType::Continuous,
        })
    };
    let effort = joint.effort_max.is_finite().then_some(joint.effort_max);
    if joint.is_sliding {
        return sliding(joint, file::Joint { force_max_n: effort, ..placed }, options, place);
    }
    let limit_deg = |limit: f64| limit.is_finite().then(|| degrees(limit));
    let acceleration = options.acceleration_max_deg_s2.ok_or_else(|| {
        place.key("acceleration_max_deg_s2").missing(
            "the largest acceleration of joints that turn, deg/s², which URDF does not have",
        )
    })?;
    let rate = match joint.rate_max {
        Some(rate) => degrees(rate),
        None => options.rate_max_deg_s.ok_or_else(|| {
            place.key("rate_max_deg_s").missing(format!(
                "the largest rate of joints like \"{}\", deg/s, for which the file has no velocity limit",
                joint.name
            ))
        })?,
    };
    Ok(file::Joint {
        angle_min_deg: limit_deg(joint.lower),
        angle_max_deg: limit_deg(joint.upper),
        rate_max_deg_s: Some(rate),
        acceleration_max_deg_s2: Some(acceleration),
        torque_max_n_m: effort,
        ..placed
    })
}

/// The limits of a joint that slides.
fn sliding(
    joint: &MovingJoint,
    placed: file::Joint,
    options: &SystemOptions,
    place: &Location,
) -> Result<file::Joint, Error> {
    if !(joint.lower.is_finite() && joint.upper.is_finite()) {
        return Err(place
            .key("locked")
            .key(&joint.name)
            .missing("where this joint is held: it slides, and the file does not say how far"));
    }
    let acceleration = options.acceleration_max_m_s2.ok_or_else(|| {
        place.key("acceleration_max_m_s2").missing(
            "the largest acceleration of joints that slide, m/s², which URDF does not have",
        )
    })?;
    let speed = joint.rate_max.or(options.speed_max_m_s).ok_or_else(|| {
        place.key("speed_max_m_s").missing(format!(
            "the largest speed of joints like \"{}\", m/s, for which the file has no velocity limit",
            joint.name
        ))
    })?;
    Ok(file::Joint {
        travel_min_m: Some(joint.lower),
        travel_max_m: Some(joint.upper),
        speed_max_m_s: Some(speed),
        acceleration_max_m_s2: Some(acceleration),
        ..placed
    })
}

/// Capsules for every shape, without those inside another.
fn capsules(shapes: &[Shape]) -> Vec<file::Shape> {
    let capsules: Vec<Capsule> = shapes.iter().map(Shape::bounding_capsule).collect();
    Capsule::outermost(&capsules).iter().map(shape).collect()
}

fn shape(capsule: &Capsule) -> file::Shape {
    let Capsule { ends_m: [from, to], radius_m } = *capsule;
    if from == to {
        let sphere = file::Sphere { center_m: array(&from), radius_m };
        return file::Shape { sphere: Some(sphere), capsule: None };
    }
    let capsule = file::Capsule { from_m: array(&from), to_m: array(&to), radius_m };
    file::Shape { sphere: None, capsule: Some(capsule) }
}

/// Boxes along the base's axes, and capsules for every other shape.
fn keep_out(shapes: &[Shape]) -> Vec<file::KeepOut> {
    let aligned = |shape: &Shape| match shape {
        Shape::Cuboid(cuboid) => cuboid.aligned(),
        Shape::Capsule(_) => None,
    };
    let boxes = shapes.iter().filter_map(aligned).map(|cuboid| {
        let center_m = array(&cuboid.placement.position_m);
        let cuboid = file::Cuboid { center_m, size_m: array(&cuboid.size_m) };
        file::KeepOut { cuboid: Some(cuboid), ..file::KeepOut::default() }
    });
    let others: Vec<Shape> =
        shapes.iter().filter(|shape| aligned(shape).is_none()).copied().collect();
    let capsules = capsules(&others)
        .into_iter()
        .map(|file::Shape { sphere, capsule }| file::KeepOut { sphere, capsule, cuboid: None });
    boxes.chain(capsules).collect()
}

/// Without the sign of negative zeros.
fn array(vector: &Vector3<f64>) -> [f64; 3] {
    [vector.x + 0.0, vector.y + 0.0, vector.z + 0.0]
}

fn rows(matrix: &Matrix3<f64>) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|row| array(&matrix.row(row).transpose()))
}

/// An angle in deg, rad to deg.
fn degrees(angle_rad: f64) -> f64 {
    angle_rad.to_degrees() + 0.0
}

/// The folder that a file stands in.
fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}
