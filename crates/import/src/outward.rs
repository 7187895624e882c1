//! The robot's links from the base outward, whichever link the file has as its root.

use nalgebra::Vector3;
use righting_multibody::Placement;

use crate::robot::{Joint, JointKind, Robot};

/// A link on the way outward.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    /// Index of the link.
    pub link: usize,
    /// How it is reached; none of the base.
    pub from: Option<Connection>,
    /// Whether it, or a link between the base and it, is left out.
    pub is_dropped: bool,
    /// Mass of it and of all beyond it, kg.
    pub mass_beyond_kg: f64,
}

/// A joint that is passed outward.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Connection {
    /// The step of the link on the base's side.
    pub step: usize,
    /// Index of the joint.
    pub joint: usize,
    /// Whether it is passed from its child to its parent.
    pub is_reversed: bool,
}

impl Robot {
    /// All links from `base` outward, each after the one that it hangs on; those of `dropped` and what
    /// hangs on them marked. A massless root that hangs on a loose joint, the world of some files, is
    /// marked too.
    pub(crate) fn outward(&self, base: usize, dropped: &[usize]) -> Vec<Step> {
        let first = Step { link: base, from: None, is_dropped: false, mass_beyond_kg: 0.0 };
        let mut steps = vec![first];
        let mut next = 0;
        while next < steps.len() {
            let Step { link, from, is_dropped, .. } = steps[next];
            let came_by = from.map(|connection| connection.joint);
            let joints = self.links[link].parent_joint.iter().chain(&self.links[link].child_joints);
            for &joint in joints.filter(|joint| Some(**joint) != came_by) {
                let Joint { parent, child, .. } = self.joints[joint];
                let is_reversed = child == link;
                let link = if is_reversed { parent } else { child };
                steps.push(Step {
                    link,
                    from: Some(Connection { step: next, joint, is_reversed }),
                    is_dropped: is_dropped || dropped.contains(&link) || self.is_world(link, joint),
                    mass_beyond_kg: 0.0,
                });
            }
            next += 1;
        }
        for index in (0..steps.len()).rev() {
            steps[index].mass_beyond_kg += self.links[steps[index].link].body.mass_kg;
            if let Some(Connection { step, .. }) = steps[index].from {
                steps[step].mass_beyond_kg += steps[index].mass_beyond_kg;
            }
        }
        steps
    }

    fn is_world(&self, link: usize, joint: usize) -> bool {
        let world = &self.links[link];
        self.joints[joint].kind == JointKind::Loose
            && link == self.root
            && world.child_joints.len() == 1
            && world.body.mass_kg == 0.0
            && world.shapes.is_empty()
    }
}

impl Connection {
    /// The joint's frame at coordinate zero, in the frame in which the link on the base's side sits at
    /// `near`.
    pub fn joint_frame(&self, joint: &Joint, near: &Placement) -> Placement {
        if self.is_reversed { *near } else { near.then(&joint.placement) }
    }

    /// The axis that the outward link turns about or moves along, in that frame.
    pub fn axis(&self, joint: &Joint) -> Vector3<f64> {
        if self.is_reversed { -joint.axis } else { joint.axis }
    }

    /// The outward link's own frame in the moved joint's frame.
    pub fn link_frame(&self, joint: &Joint) -> Placement {
        if self.is_reversed { joint.placement.inverse() } else { Placement::identity() }
    }
}
