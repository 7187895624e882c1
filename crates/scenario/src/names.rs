//! What the parts of a system and its joints are called.

use std::collections::BTreeMap;
use std::fmt;

use crate::bodies::{ArmPart, Piece};
use crate::collision::Between;
use crate::error::Error;
use crate::file::{self, JointPlace};
use crate::json::{Location, shown};

/// Names of links, bodies and joints. What has none goes by its number, counted from one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Names {
    links: Vec<Option<String>>,
    bodies: Vec<String>,
    joints: Vec<Option<String>>,
}

impl Names {
    /// The names that a file gives, if no two are the same.
    pub(crate) fn new(system: &file::System, place: &Location) -> Result<Self, Error> {
        let names = Self::of(system);
        let links = names.links.iter().enumerate().filter_map(|(index, name)| {
            Some((name.as_deref()?, place.key("links").index(index).key("name")))
        });
        let bodies = names.bodies.iter().enumerate();
        let bodies = bodies
            .map(|(index, name)| (name.as_str(), place.key("bodies").index(index).key("name")));
        let base = std::iter::once((system.base.name(), place.key("base").key("name")));
        check(base.chain(bodies), "body")?;
        check(links, "link")?;
        let rows = system.joints();
        let joints = rows.iter().filter_map(|row| match row.place {
            JointPlace::Link(_) => None,
            JointPlace::Body(_) => Some((row.name.as_deref()?, row.at(place).key("name"))),
        });
        check(joints, "joint")?;
        Ok(names)
    }

    /// The names that a checked file gives.
    pub fn of(system: &file::System) -> Self {
        Self {
            links: system.links.iter().map(|link| link.name.clone()).collect(),
            bodies: system.bodies.iter().flatten().map(|body| body.name.clone()).collect(),
            joints: system.joints().into_iter().map(|row| row.name).collect(),
        }
    }

    /// A joint, counted from zero: its name, or such as "joint 2".
    pub fn joint(&self, joint: usize) -> String {
        match self.joints.get(joint).and_then(Option::as_ref) {
            Some(name) => name.clone(),
            None => format!("joint {}", joint + 1),
        }
    }

    /// The name of a joint, counted from zero, if it has one.
    pub fn of_joint(&self, joint: usize) -> Option<&str> {
        self.joints.get(joint)?.as_deref()
    }

    /// The name of a link, counted from zero, if it has one.
    pub fn of_link(&self, link: usize) -> Option<&str> {
        self.links.get(link)?.as_deref()
    }

    /// The name of a body, counted from zero.
    pub fn of_body(&self, body: usize) -> Option<&str> {
        self.bodies.get(body).map(String::as_str)
    }

    /// A link, body or payload: its name, or such as "link 2".
    pub fn part(&self, part: ArmPart) -> String {
        let name = match part {
            ArmPart::Link(link) => self.of_link(link),
            ArmPart::Body(body) => self.of_body(body),
            ArmPart::Payload => None,
        };
        name.map_or_else(|| part.to_string(), str::to_owned)
    }

    /// A piece of a part, such as "left_forearm shape 2".
    pub fn piece(&self, piece: Piece) -> String {
        let part = self.part(piece.part);
        match piece.shape {
            Some(shape) => format!("{part} shape {}", shape + 1),
            None => part,
        }
    }

    /// What a clearance is between, such as "left_forearm and body".
    pub fn between(&self, between: &Between) -> String {
        let is_unnamed = |piece: &Piece| self.part(piece.part) == piece.part.to_string();
        match between {
            Between::Body(piece) => format!("{} and body", self.piece(*piece)),
            Between::KeepOut(piece, k) => format!("{} and keep-out {}", self.piece(*piece), k + 1),
            Between::Pieces(a, b) if is_unnamed(a) && is_unnamed(b) => between.to_string(),
            Between::Pieces(a, b) => format!("{} and {}", self.piece(*a), self.piece(*b)),
        }
    }
}

impl file::JointRow {
    /// Where the joint's fields stand in the system file at `place`.
    pub(crate) fn at(&self, place: &Location) -> Location {
        match self.place {
            JointPlace::Link(index) => place.key("links").index(index),
            JointPlace::Body(index) => place.key("bodies").index(index).key("joint"),
        }
    }
}

/// No name is empty, and no two are the same.
fn check<'a>(
    names: impl Iterator<Item = (&'a str, Location)>,
    of: impl fmt::Display,
) -> Result<(), Error> {
    let mut known: BTreeMap<&str, Location> = BTreeMap::new();
    for (name, place) in names {
        if name.trim().is_empty() {
            return Err(place.refuse("\"\"", "a name"));
        }
        if let Some(other) = known.get(name) {
            let expected = format!("a name of its own: the {of} at {} has this one", other.path());
            return Err(place.refuse(shown(&name.into()), expected));
        }
        known.insert(name, place);
    }
    Ok(())
}
