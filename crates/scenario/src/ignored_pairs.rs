//! Pairs of bodies that may touch and cross, by the names of the fields that describe them.

use std::fmt;

use crate::bodies::{ArmPart, Piece};
use crate::collision::Between;
use crate::error::Error;
use crate::file;
use crate::json::{Location, shown};

/// Bodies that a name of `ignored_pairs` stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// Every piece of a link or of the payload.
    Part(ArmPart),
    /// One shape of it.
    Piece(Piece),
    /// One shape of `base.keep_out`.
    KeepOut(usize),
    /// The keep-out sphere.
    Sphere,
}

impl Named {
    /// Reads a name such as `links[2].shapes[0]`; none if it is no such name. Whether there is such a body
    /// is not looked at.
    pub fn parse(name: &str) -> Option<Self> {
        if name == "base.keep_out_radius_m" {
            return Some(Self::Sphere);
        }
        if let Some(rest) = name.strip_prefix("base.keep_out") {
            return index(rest).filter(|(_, rest)| rest.is_empty()).map(|(k, _)| Self::KeepOut(k));
        }
        let (part, rest) = match name.strip_prefix("links") {
            Some(rest) => index(rest).map(|(link, rest)| (ArmPart::Link(link), rest))?,
            None => match name.strip_prefix("bodies") {
                Some(rest) => index(rest).map(|(body, rest)| (ArmPart::Body(body), rest))?,
                None => (ArmPart::Payload, name.strip_prefix("payload")?),
            },
        };
        if rest.is_empty() {
            return Some(Self::Part(part));
        }
        let (shape, rest) = index(rest.strip_prefix(".shapes")?)?;
        rest.is_empty().then_some(Self::Piece(Piece { part, shape: Some(shape) }))
    }

    /// Whether this piece of the arm is meant.
    pub fn is_piece(&self, piece: Piece) -> bool {
        match *self {
            Self::Part(part) => part == piece.part,
            Self::Piece(named) => named == piece,
            Self::KeepOut(_) | Self::Sphere => false,
        }
    }

    fn part(&self) -> Option<ArmPart> {
        match *self {
            Self::Part(part) | Self::Piece(Piece { part, .. }) => Some(part),
            Self::KeepOut(_) | Self::Sphere => None,
        }
    }

    /// What there is, if it is not this.
    fn check(&self, system: &file::System, has_sphere: bool) -> Result<(), String> {
        let count = |count: usize, what: &str| match count {
            0 => format!("this system has no {what}"),
            _ => format!("this system has {what}[0] to {what}[{}]", count - 1),
        };
        let within = |index: usize, length: usize, what: &str| match index < length {
            true => Ok(()),
            false => Err(count(length, what)),
        };
        match *self {
            Self::Sphere if has_sphere => Ok(()),
            Self::Sphere => Err("this system has no keep-out sphere".to_owned()),
            Self::KeepOut(k) => {
                within(k, system.base.keep_out.as_ref().map_or(0, Vec::len), "base.keep_out")
            }
            Self::Part(part) | Self::Piece(Piece { part, .. }) => {
                let (name, shapes) = match part {
                    ArmPart::Link(link) => {
                        within(link, system.links.len(), "links")?;
                        (format!("links[{link}].shapes"), &system.links[link].shapes)
                    }
                    ArmPart::Body(body) => {
                        let bodies = system.bodies.as_deref().unwrap_or_default();
                        within(body, bodies.len(), "bodies")?;
                        (format!("bodies[{body}].shapes"), &bodies[body].shapes)
                    }
                    ArmPart::Payload => match &system.payload {
                        Some(payload) => ("payload.shapes".to_owned(), &payload.shapes),
                        None => return Err("this system has no payload".to_owned()),
                    },
                };
                match *self {
                    Self::Piece(Piece { shape: Some(shape), .. }) => {
                        within(shape, shapes.as_ref().map_or(0, Vec::len), &name)
                    }
                    _ => Ok(()),
                }
            }
        }
    }
}

impl fmt::Display for Named {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let part = |f: &mut fmt::Formatter<'_>, part: ArmPart| match part {
            ArmPart::Link(link) => write!(f, "links[{link}]"),
            ArmPart::Body(body) => write!(f, "bodies[{body}]"),
            ArmPart::Payload => f.write_str("payload"),
        };
        match *self {
            Self::Part(named) | Self::Piece(Piece { part: named, shape: None }) => part(f, named),
            Self::Piece(Piece { part: named, shape: Some(shape) }) => {
                part(f, named)?;
                write!(f, ".shapes[{shape}]")
            }
            Self::KeepOut(k) => write!(f, "base.keep_out[{k}]"),
            Self::Sphere => f.write_str("base.keep_out_radius_m"),
        }
    }
}

impl Between {
    /// Whether this is a pair of `ignored_pairs`.
    pub fn is_named(&self, [a, b]: &[Named; 2]) -> bool {
        let is = |x: &Named, y: &Named| match *self {
            Self::Body(piece) => x.is_piece(piece) && *y == Named::Sphere,
            Self::KeepOut(piece, k) => x.is_piece(piece) && *y == Named::KeepOut(k),
            Self::Pieces(p, q) => x.is_piece(p) && y.is_piece(q),
        };
        is(a, b) || is(b, a)
    }

    /// The pair of `ignored_pairs` that this one is.
    pub(crate) fn named(&self) -> [Named; 2] {
        match *self {
            Self::Body(piece) => [Named::Piece(piece), Named::Sphere],
            Self::KeepOut(piece, k) => [Named::Piece(piece), Named::KeepOut(k)],
            Self::Pieces(a, b) => [Named::Piece(a), Named::Piece(b)],
        }
    }

    /// The same as a file says it.
    pub(crate) fn field_names(&self) -> String {
        let [a, b] = self.named();
        format!("[\"{a}\", \"{b}\"]")
    }
}

/// `[3]rest` as 3 and `rest`.
fn index(text: &str) -> Option<(usize, &str)> {
    let (digits, rest) = text.strip_prefix('[')?.split_once(']')?;
    let is_number = !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit());
    is_number.then(|| digits.parse().ok()).flatten().map(|number| (number, rest))
}

/// Checks the pairs of a system.
pub(crate) fn ignored_pairs(
    system: &file::System,
    has_sphere: bool,
    place: &Location,
) -> Result<Vec<[Named; 2]>, Error> {
    let place = place.key("ignored_pairs");
    let mut pairs = Vec::new();
    for (index, names) in system.ignored_pairs.iter().flatten().enumerate() {
        let place = place.index(index);
        let read = |which: usize| -> Result<Named, Error> {
            let place = place.index(which);
            let found = shown(&names[which].as_str().into());
            let named = Named::parse(&names[which]).ok_or_else(|| {
                place.refuse(
                    &found,
                    "a name such as \"links[0]\", \"links[0].shapes[1]\", \"payload\", \
                     \"base.keep_out[0]\" or \"base.keep_out_radius_m\"",
                )
            })?;
            named.check(system, has_sphere).map_err(|there_is| {
                place.refuse(&found, format_args!("a body that there is: {there_is}"))
            })?;
            Ok(named)
        };
        let pair = [read(0)?, read(1)?];
        let found = || format!("[\"{}\", \"{}\"]", names[0], names[1]);
        match pair.map(|named| named.part()) {
            [None, None] => {
                return Err(place.refuse(found(), "at least one link or the payload"));
            }
            [a, b] if a == b => return Err(place.refuse(found(), "two parts that move apart")),
            _ => pairs.push(pair),
        }
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_the_paths_of_fields() {
        let piece = |part, shape| Named::Piece(Piece { part, shape: Some(shape) });
        for (name, named) in [
            ("links[12]", Some(Named::Part(ArmPart::Link(12)))),
            ("links[0].shapes[3]", Some(piece(ArmPart::Link(0), 3))),
            ("payload", Some(Named::Part(ArmPart::Payload))),
            ("payload.shapes[0]", Some(piece(ArmPart::Payload, 0))),
            ("base.keep_out[1]", Some(Named::KeepOut(1))),
            ("base.keep_out_radius_m", Some(Named::Sphere)),
            ("links", None),
            ("links[+1]", None),
            ("links[1", None),
            ("links[]", None),
            ("links[1].shapes", None),
            ("links[1].shapes[0].sphere", None),
            ("links[99999999999999999999999]", None),
            ("base.keep_out", None),
            ("base.keep_out[0]x", None),
            ("base", None),
            ("payloads", None),
            ("", None),
        ] {
            assert_eq!(Named::parse(name), named, "{name}");
            assert!(named.is_none_or(|named| named.to_string() == name), "{name}");
        }
    }
}
