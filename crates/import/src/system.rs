//! A robot as a free-floating system: a base, and the bodies that joints move.

use nalgebra::{Rotation3, Unit, Vector3};
use righting_multibody::{Placement, RigidBody};

use crate::error::{ImportError, OptionName, listed, quoted};
use crate::held::Held;
use crate::options::{BaseOption, Options};
use crate::outward::Step;
use crate::robot::{Joint, JointKind, Robot};
use crate::shape::Shape;

/// A free-floating system: what is held together is one body. SI units and radians.
#[derive(Clone, Debug)]
pub struct System {
    /// Name of the robot.
    pub name: String,
    /// Name of the link that the base or what is fixed to it is made from.
    pub base_name: String,
    /// Mass of all that is part of the base, in the base's frame: without that of the body itself where
    /// the robot is mounted on one.
    pub base: RigidBody,
    /// What it occupies, in the base's frame.
    pub base_shapes: Vec<Shape>,
    /// The bodies that joints move, each after the one that it hangs on.
    pub bodies: Vec<Body>,
    /// What was assumed, left out or put together, a sentence each.
    pub notes: Vec<String>,
}

/// A rigid body on a joint. Its frame is the joint's, turned about its axis or moved along it.
#[derive(Clone, Debug)]
pub struct Body {
    /// Name of the link that the joint moves.
    pub name: String,
    /// Index of the body that it hangs on; none for the base.
    pub parent: Option<usize>,
    /// The joint.
    pub joint: MovingJoint,
    /// Mass in the body's frame.
    pub body: RigidBody,
    /// What it occupies, in the body's frame.
    pub shapes: Vec<Shape>,
}

/// A joint with one coordinate. rad or m, rad/s or m/s, N m or N.
#[derive(Clone, Debug)]
pub struct MovingJoint {
    /// Its name.
    pub name: String,
    /// Whether it slides along its axis instead of turning about it.
    pub is_sliding: bool,
    /// Its frame at coordinate zero, in the frame of the body that it stands on.
    pub placement: Placement,
    /// Unit vector in that frame.
    pub axis: Vector3<f64>,
    /// Smallest coordinate; −∞ for none.
    pub lower: f64,
    /// Largest coordinate; ∞ for none.
    pub upper: f64,
    /// Largest rate, where the file gives one.
    pub rate_max: Option<f64>,
    /// Largest effort; ∞ for none.
    pub effort_max: f64,
}

impl Robot {
    /// Puts the robot together as a system: re-rooted at the base, with what is held merged.
    ///
    /// # Errors
    /// [`ImportError::Option`] where an option names what is not there, [`ImportError::Refused`] for a
    /// joint with more than one coordinate.
    pub fn system(&self, options: &Options) -> Result<System, ImportError> {
        let (base, pose) = match &options.base {
            BaseOption::Link(name) => (self.link(name, OptionName::Base)?, Placement::identity()),
            BaseOption::Mounted(placement) => (self.root, *placement),
        };
        let dropped = options
            .dropped
            .iter()
            .map(|name| self.link(name, OptionName::Dropped))
            .collect::<Result<Vec<usize>, _>>()?;
        if dropped.contains(&base) {
            let found = format!("{}, the base", quoted(&self.links[base].name));
            return Err(OptionName::Dropped.refuse(found, "links that hang on it"));
        }
        let steps = self.outward(base, &dropped);
        let way = self.way_to_tip(&steps, options)?;
        let locked = self.locked(options)?;
        let mut assembly = Assembly::new(self, base, pose);
        for (index, step) in steps.iter().enumerate().skip(1) {
            assembly.add(step, |joint| self.held(joint, &locked, way[index]))?;
        }
        Ok(assembly.finish(options))
    }

    fn link(&self, name: &str, option: OptionName) -> Result<usize, ImportError> {
        self.links.iter().position(|link| link.name == name).ok_or_else(|| {
            let names = listed(self.links.iter().map(|link| link.name.as_str()));
            option.refuse(quoted(name), format!("a link of the robot: {names}"))
        })
    }

    /// Whether the joint that leads to each step is on the way to the tip; all are where no tip is given.
    fn way_to_tip(&self, steps: &[Step], options: &Options) -> Result<Vec<bool>, ImportError> {
        let Some(name) = &options.tip else { return Ok(vec![true; steps.len()]) };
        let tip = self.link(name, OptionName::Tip)?;
        let mut is_on_the_way = vec![false; steps.len()];
        let mut next = steps.iter().position(|step| step.link == tip && !step.is_dropped);
        if next.is_none() {
            let found = format!("{}, which is left out", quoted(name));
            return Err(OptionName::Tip.refuse(found, "a link that is not"));
        }
        while let Some(step) = next {
            is_on_the_way[step] = true;
            next = steps[step].from.map(|connection| connection.step);
        }
        Ok(is_on_the_way)
    }
}

/// A system while it is put together.
struct Assembly<'r> {
    robot: &'r Robot,
    system: System,
    /// Of every step: the body that its link is part of, none for the base, and the link's frame in it;
    /// nothing where the link is left out.
    places: Vec<Option<(Option<usize>, Placement)>>,
    /// Of the base and then every body: the massive links that fixed joints add to it.
    fixed: Vec<Vec<usize>>,
    /// Links whose frames are not where the file has them.
    moved: Vec<usize>,
}

impl<'r> Assembly<'r> {
    fn new(robot: &'r Robot, base: usize, pose: Placement) -> Self {
        let link = &robot.links[base];
        let system = System {
            name: robot.name.clone(),
            base_name: link.name.clone(),
            base: at(&link.body, &pose),
            base_shapes: link.shapes.iter().map(|shape| shape.placed(&pose)).collect(),
            bodies: Vec::new(),
            notes: robot.notes.clone(),
        };
        Self {
            robot,
            system,
            places: vec![Some((None, pose))],
            fixed: vec![Vec::new()],
            moved: Vec::new(),
        }
    }

    /// Adds the next step, and says what it does.
    fn add(
        &mut self,
        step: &Step,
        held: impl Fn(usize) -> Option<Held>,
    ) -> Result<(), ImportError> {
        let Some(connection) = step.from else { return Ok(()) };
        let joint = &self.robot.joints[connection.joint];
        let link = &self.robot.links[step.link];
        let Some((near, near_pose)) = self.places[connection.step] else {
            self.places.push(None);
            return Ok(());
        };
        if step.is_dropped {
            self.note_drop(step, joint);
            self.places.push(None);
            return Ok(());
        }
        if joint.kind == JointKind::Loose {
            let expected = "a joint that is revolute, continuous, prismatic or fixed, or the link beyond \
                            it as base, or left out";
            return Err(joint.place.refuse("a joint of more than one coordinate", expected));
        }
        let frame = connection.joint_frame(joint, &near_pose);
        let axis = connection.axis(joint);
        let link_frame = connection.link_frame(joint);
        match held(connection.joint) {
            None => {
                if connection.is_reversed {
                    self.moved.push(step.link);
                }
                self.places.push(Some((Some(self.system.bodies.len()), link_frame)));
                self.fixed.push(Vec::new());
                self.system.bodies.push(Body {
                    name: link.name.clone(),
                    parent: near,
                    joint: MovingJoint::new(joint, frame, axis),
                    body: at(&link.body, &link_frame),
                    shapes: link.shapes.iter().map(|shape| shape.placed(&link_frame)).collect(),
                });
            }
            Some(held) => {
                let pose = frame.then(&motion(joint, &axis, held.coordinate())).then(&link_frame);
                self.note_held(step, joint, near, held);
                self.merge(step.link, near, &pose);
                self.places.push(Some((near, pose)));
            }
        }
        Ok(())
    }

    /// Puts a link into a body, or into the base.
    fn merge(&mut self, link: usize, body: Option<usize>, pose: &Placement) {
        let link = &self.robot.links[link];
        let (own, shapes) = match body {
            Some(index) => {
                let body = &mut self.system.bodies[index];
                (&mut body.body, &mut body.shapes)
            }
            None => (&mut self.system.base, &mut self.system.base_shapes),
        };
        *own = own.joined(&link.body, pose);
        shapes.extend(link.shapes.iter().map(|shape| shape.placed(pose)));
    }

    fn note_held(&mut self, step: &Step, joint: &Joint, near: Option<usize>, held: Held) {
        if held == Held::Fixed {
            if self.robot.links[step.link].body.mass_kg > 0.0 {
                self.fixed[near.map_or(0, |index| index + 1)].push(step.link);
            }
            return;
        }
        let note = joint.place.note(format_args!(
            "held at {}, {}; {} kg beyond it move with {}",
            joint.shown(held.coordinate()),
            held.reason(),
            step.mass_beyond_kg,
            self.body_name(near)
        ));
        self.system.notes.push(note);
    }

    fn note_drop(&mut self, step: &Step, joint: &Joint) {
        let note = joint.place.note(format_args!(
            "the link {} is left out with all that hangs on it, {} kg",
            quoted(&self.robot.links[step.link].name),
            step.mass_beyond_kg
        ));
        self.system.notes.push(note);
    }

    fn body_name(&self, index: Option<usize>) -> String {
        match index {
            Some(index) => quoted(&self.system.bodies[index].name),
            None => "the base".to_owned(),
        }
    }

    fn finish(mut self, options: &Options) -> System {
        for (index, links) in self.fixed.iter().enumerate().filter(|(_, links)| !links.is_empty()) {
            let mass_kg: f64 = links.iter().map(|&link| self.robot.links[link].body.mass_kg).sum();
            let names = listed(links.iter().map(|&link| self.robot.links[link].name.as_str()));
            let body = self.body_name(index.checked_sub(1));
            self.system.notes.push(format!("fixed to {body}, {mass_kg} kg: {names}"));
        }
        if !self.moved.is_empty() {
            let names = listed(self.moved.iter().map(|&link| self.robot.links[link].name.as_str()));
            self.system.notes.push(format!(
                "joints are turned around, since the base is not the root: the frames of {names} sit in \
                 the joints that move them now"
            ));
        }
        if options.tip.is_some() && self.system.bodies.is_empty() {
            self.system.notes.push("no joint on the way to the tip moves".to_owned());
        }
        self.system
    }
}

impl MovingJoint {
    fn new(joint: &Joint, placement: Placement, axis: Vector3<f64>) -> Self {
        Self {
            name: joint.name.clone(),
            is_sliding: joint.kind == JointKind::Sliding,
            placement,
            axis,
            lower: joint.limits.lower,
            upper: joint.limits.upper,
            rate_max: joint.limits.rate_max,
            effort_max: joint.limits.effort_max,
        }
    }
}

/// The frame of a joint that has moved to `coordinate`, in its frame at zero.
fn motion(joint: &Joint, axis: &Vector3<f64>, coordinate: f64) -> Placement {
    match joint.kind {
        JointKind::Turning => Placement {
            position_m: Vector3::zeros(),
            rotation: Rotation3::from_axis_angle(&Unit::new_unchecked(*axis), coordinate)
                .into_inner(),
        },
        JointKind::Sliding => Placement { position_m: axis * coordinate, ..Placement::identity() },
        JointKind::Fixed | JointKind::Loose => Placement::identity(),
    }
}

/// A body in the frame in which its own sits at `pose`.
fn at(body: &RigidBody, pose: &Placement) -> RigidBody {
    let Placement { position_m, rotation } = pose;
    RigidBody {
        mass_kg: body.mass_kg,
        center_of_mass_m: position_m + rotation * body.center_of_mass_m,
        inertia_kg_m2: rotation * body.inertia_kg_m2 * rotation.transpose(),
    }
}
