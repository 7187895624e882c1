//! The XML of a robot's file, with the line of every element.

use roxmltree::{Document, Node, ParsingOptions};

use crate::error::{ImportError, Place, quoted};

/// The most nodes of a document that is read; public robots have a few thousand.
const MAX_NODES: u32 = 1_000_000;

/// An XML document.
pub(crate) struct Source<'t> {
    document: Document<'t>,
    /// Byte where each line starts.
    line_starts: Vec<usize>,
}

impl<'t> Source<'t> {
    /// Parses a text. Document types are refused, and with them entities of any kind.
    pub fn parse(text: &'t str) -> Result<Self, ImportError> {
        let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
        let document = Document::parse_with_options(text, options).map_err(|error| {
            let position = error.pos();
            let reason = match error {
                roxmltree::Error::DtdDetected => {
                    "a document type (<!DOCTYPE>), which a robot's file does not have".to_owned()
                }
                roxmltree::Error::NodesLimitReached => {
                    format!("more than {MAX_NODES} elements and texts")
                }
                // The place stands before the message; control characters would break its line.
                error => {
                    let text = error.to_string();
                    let text = text.strip_suffix(&format!(" at {position}")).unwrap_or(&text);
                    text.chars().flat_map(shown).collect()
                }
            };
            ImportError::NotXml {
                line: position.row as usize,
                column: position.col as usize,
                reason,
            }
        })?;
        let after_breaks = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let line_starts = std::iter::once(0).chain(after_breaks.map(|(at, _)| at + 1)).collect();
        Ok(Self { document, line_starts })
    }

    /// The outermost element.
    pub fn root(&self) -> Element<'_> {
        Element { node: self.document.root_element(), source: self }
    }
}

fn shown(c: char) -> impl Iterator<Item = char> {
    let escaped = c.is_control().then(|| c.escape_default());
    let plain = (!c.is_control()).then_some(c);
    escaped.into_iter().flatten().chain(plain)
}

/// An element of a document.
#[derive(Clone, Copy)]
pub(crate) struct Element<'s> {
    node: Node<'s, 's>,
    source: &'s Source<'s>,
}

impl<'s> Element<'s> {
    /// Its tag, without a namespace.
    pub fn tag(&self) -> &'s str {
        self.node.tag_name().name()
    }

    /// The first element in here, itself included, that waits for `xacro`.
    pub fn macro_call(&self) -> Option<Self> {
        let mut descendants = self.node.descendants();
        let node = descendants.find(|node| {
            node.is_element()
                && node.tag_name().namespace().is_some_and(|space| space.ends_with("xacro"))
        })?;
        Some(Self { node, ..*self })
    }

    /// Where it stands.
    pub fn place(&self) -> Place {
        let start = self.node.range().start;
        let line = self.source.line_starts.partition_point(|&line_start| line_start <= start);
        let mut steps: Vec<String> = self
            .node
            .ancestors()
            .filter(|node| node.is_element())
            .map(|node| match node.attribute("name") {
                Some(name) => format!("{} {}", node.tag_name().name(), quoted(name)),
                None => node.tag_name().name().to_owned(),
            })
            .collect();
        // Everything stands in the one robot.
        if steps.len() > 1 {
            steps.pop();
        }
        steps.reverse();
        Place { line, element: steps.join(", ") }
    }

    /// Where one of its attributes stands.
    pub fn place_of(&self, attribute: &str) -> Place {
        let mut place = self.place();
        place.element = format!("{} {attribute}", place.element);
        place
    }

    /// Every element with this tag in it.
    pub fn children(&self, tag: &'s str) -> impl Iterator<Item = Self> {
        let source = self.source;
        self.node
            .children()
            .filter(move |node| node.is_element() && node.tag_name().name() == tag)
            .map(move |node| Self { node, source })
    }

    /// The element with this tag in it, if there is one.
    pub fn child(&self, tag: &'s str) -> Result<Option<Self>, ImportError> {
        let mut children = self.children(tag);
        let first = children.next();
        match children.next() {
            Some(second) => Err(second.place().refuse(format!("a second <{tag}>"), "one")),
            None => Ok(first),
        }
    }

    /// The element with this tag in it.
    pub fn required_child(&self, tag: &'s str) -> Result<Self, ImportError> {
        self.child(tag)?.ok_or_else(|| self.place().refuse(format!("no <{tag}>"), "one"))
    }

    /// The only element in it.
    pub fn only_child(&self) -> Result<Self, ImportError> {
        let mut elements = self.node.children().filter(Node::is_element);
        match (elements.next(), elements.next()) {
            (Some(node), None) => Ok(Self { node, ..*self }),
            (None, _) => Err(self.place().refuse("no element", "one")),
            (_, Some(second)) => {
                let second = Self { node: second, ..*self };
                Err(second.place().refuse("a second element", "one"))
            }
        }
    }

    /// An attribute.
    pub fn text(&self, attribute: &str) -> Option<&'s str> {
        self.node.attribute(attribute)
    }

    /// An attribute that must be there and not empty.
    pub fn required_text(&self, attribute: &str) -> Result<&'s str, ImportError> {
        match self.text(attribute) {
            Some(text) if !text.trim().is_empty() => Ok(text),
            _ => Err(self.missing(attribute)),
        }
    }

    /// A finite number.
    pub fn number(&self, attribute: &str) -> Result<Option<f64>, ImportError> {
        let Some(value) = self.number_or_infinity(attribute)? else { return Ok(None) };
        if value.is_finite() {
            Ok(Some(value))
        } else {
            Err(self.place_of(attribute).refuse(value, "a finite number"))
        }
    }

    /// A number that may be infinite, as limits are in some files.
    pub fn number_or_infinity(&self, attribute: &str) -> Result<Option<f64>, ImportError> {
        let Some(text) = self.text(attribute) else { return Ok(None) };
        self.parsed(attribute, text, text).map(Some)
    }

    /// A finite number that must be there.
    pub fn required_number(&self, attribute: &str) -> Result<f64, ImportError> {
        self.number(attribute)?.ok_or_else(|| self.missing(attribute))
    }

    /// Three finite numbers with spaces between them.
    pub fn vector(&self, attribute: &str) -> Result<Option<[f64; 3]>, ImportError> {
        let Some(text) = self.text(attribute) else { return Ok(None) };
        let mut words = text.split_whitespace();
        let mut values = [0.0; 3];
        for value in &mut values {
            let word = words.next().ok_or_else(|| self.no_vector(attribute, text))?;
            *value = self.parsed(attribute, word, text)?;
            if !value.is_finite() {
                return Err(self.place_of(attribute).refuse(quoted(text), "three finite numbers"));
            }
        }
        match words.next() {
            None => Ok(Some(values)),
            Some(_) => Err(self.no_vector(attribute, text)),
        }
    }

    fn parsed(&self, attribute: &str, word: &str, text: &str) -> Result<f64, ImportError> {
        match word.trim().parse::<f64>() {
            Ok(value) if !value.is_nan() => Ok(value),
            Ok(_) => Err(self.place_of(attribute).refuse(quoted(text), "a number")),
            Err(_) => {
                let is_xacro = text.contains("${") || text.contains("$(");
                let expected = if is_xacro {
                    "a number: expand the file first, with `xacro robot.xacro > robot.urdf`"
                } else {
                    "a number"
                };
                Err(self.place_of(attribute).refuse(quoted(text), expected))
            }
        }
    }

    fn no_vector(&self, attribute: &str, text: &str) -> ImportError {
        self.place_of(attribute).refuse(quoted(text), "three numbers")
    }

    fn missing(&self, attribute: &str) -> ImportError {
        self.place().refuse(format!("no {attribute}"), "one")
    }
}
