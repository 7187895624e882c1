//! Small XML documents: elements, attributes and comments, indented.

use std::fmt;

/// An element with its attributes in order.
pub(crate) struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Child>,
}

enum Child {
    Element(Element),
    Comment(String),
}

impl Element {
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), children: Vec::new() }
    }

    pub fn with(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((name, value.into()));
        self
    }

    pub fn with_number(self, name: &'static str, value: f64) -> Self {
        self.with(name, number(value))
    }

    pub fn with_numbers(self, name: &'static str, values: impl IntoIterator<Item = f64>) -> Self {
        self.with(name, numbers(values))
    }

    pub fn holding(mut self, child: Self) -> Self {
        self.push(child);
        self
    }

    pub fn noting(mut self, comment: impl Into<String>) -> Self {
        self.children.push(Child::Comment(comment.into()));
        self
    }

    pub fn push(&mut self, child: Self) {
        self.children.push(Child::Element(child));
    }

    fn write(&self, depth: usize, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let indent = "  ".repeat(depth);
        write!(f, "{indent}<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"{}\"", escaped(value))?;
        }
        if self.children.is_empty() {
            return writeln!(f, "/>");
        }
        writeln!(f, ">")?;
        for child in &self.children {
            match child {
                Child::Element(element) => element.write(depth + 1, f)?,
                // Two hyphens end a comment's text.
                Child::Comment(text) => {
                    writeln!(f, "{indent}  <!-- {} -->", text.replace("--", "- -"))?;
                }
            }
        }
        writeln!(f, "{indent}</{}>", self.name)
    }
}

/// The document that the element is the root of.
impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>")?;
        self.write(0, f)
    }
}

/// The shortest decimal that reads back as the same number.
pub(crate) fn number(value: f64) -> String {
    // No reader needs the sign of a zero.
    format!("{:?}", value + 0.0)
}

/// Numbers between blanks.
pub(crate) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

/// Text as an attribute holds it; what no XML document can hold is left out.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars().filter(|c| !c.is_control()) {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_what_was_meant() {
        let element = Element::new("robot")
            .with("name", "a<b & \"c\"")
            .noting("one -- two")
            .holding(Element::new("mass").with_numbers("values", [0.1, -0.0, 1e-17, 3e20]));
        let text = element.to_string();
        let document = roxmltree::Document::parse(&text).expect("well formed");
        let root = document.root_element();
        assert_eq!(root.attribute("name"), Some("a<b & \"c\""));
        let values = root.first_element_child().and_then(|mass| mass.attribute("values"));
        assert_eq!(values, Some("0.1 0.0 1e-17 3e20"));
    }
}
