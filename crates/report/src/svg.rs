//! A writer of the few SVG elements that a line figure needs.

use std::fmt::Write;

use crate::style;

/// An SVG document under construction. Coordinates are pixels, y downwards.
pub(crate) struct Svg {
    text: String,
}

/// Where a text's coordinates lie on it.
#[derive(Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a line is stroked.
#[derive(Clone, Copy)]
pub(crate) struct Stroke {
    pub color: &'static str,
    pub width: f64,
    /// An SVG dash pattern; empty for a solid line.
    pub dash: &'static str,
}

impl Svg {
    /// A white page of the given size, described for readers who cannot see it.
    pub fn new(width: f64, height: f64, title: &str, description: &str) -> Self {
        let mut svg = Self { text: String::with_capacity(64 * 1024) };
        svg.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\" font-family=\"{}\" \
             stroke-linejoin=\"round\">\n<title>{}</title>\n<desc>{}</desc>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"{}\"/>\n",
            style::FONT,
            escaped(title),
            escaped(description),
            style::PAPER,
        ));
        svg
    }

    /// The finished document.
    pub fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        self.push(format_args!(
            "<path d=\"M{:.2} {:.2}L{:.2} {:.2}\"",
            from[0], from[1], to[0], to[1]
        ));
        self.stroke(stroke);
    }

    /// Polylines, one per run of points.
    pub fn polylines<'a>(&mut self, runs: impl Iterator<Item = &'a [[f64; 2]]>, stroke: Stroke) {
        self.text.push_str("<path d=\"");
        for run in runs {
            for (i, [x, y]) in run.iter().enumerate() {
                let verb = if i == 0 { 'M' } else { 'L' };
                self.push(format_args!("{verb}{x:.2} {y:.2}"));
            }
        }
        self.text.push('"');
        self.stroke(stroke);
    }

    /// Filled squares of one colour by their upper left corners.
    pub fn squares(&mut self, corners: impl Iterator<Item = [f64; 2]>, side: f64, color: &str) {
        self.text.push_str("<path d=\"");
        for [x, y] in corners {
            self.push(format_args!("M{x:.2} {y:.2}h{side:.2}v{side:.2}h-{side:.2}z"));
        }
        self.push(format_args!("\" fill=\"{color}\"/>\n"));
    }

    /// The outline of a rectangle.
    pub fn frame(&mut self, corner: [f64; 2], size: [f64; 2], stroke: Stroke) {
        self.push(format_args!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\"",
            corner[0], corner[1], size[0], size[1]
        ));
        self.stroke(stroke);
    }

    /// A filled rectangle.
    pub fn rectangle(&mut self, corner: [f64; 2], size: [f64; 2], color: &str) {
        self.push(format_args!(
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" fill=\"{color}\"/>\n",
            corner[0], corner[1], size[0], size[1]
        ));
    }

    /// A filled circle with an outline.
    pub fn dot(&mut self, center: [f64; 2], radius: f64, fill: &str, stroke: Stroke) {
        self.push(format_args!(
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{}\" \
             stroke-width=\"{}\"/>\n",
            center[0], center[1], stroke.color, stroke.width
        ));
    }

    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, size: f64, color: &str, text: &str) {
        self.push(format_args!(
            "<text x=\"{:.2}\" y=\"{:.2}\" font-size=\"{size}\" fill=\"{color}\"{}>{}</text>\n",
            at[0],
            at[1],
            anchor.attribute(),
            escaped(text)
        ));
    }

    /// A text read from bottom to top, centred on `at`.
    pub fn vertical_text(&mut self, at: [f64; 2], size: f64, color: &str, text: &str) {
        self.push(format_args!(
            "<text transform=\"translate({:.2} {:.2}) rotate(-90)\" font-size=\"{size}\" \
             fill=\"{color}\" text-anchor=\"middle\">{}</text>\n",
            at[0],
            at[1],
            escaped(text)
        ));
    }

    fn stroke(&mut self, stroke: Stroke) {
        self.push(format_args!(
            " fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"",
            stroke.color, stroke.width
        ));
        if !stroke.dash.is_empty() {
            self.push(format_args!(" stroke-dasharray=\"{}\"", stroke.dash));
        }
        self.text.push_str("/>\n");
    }

    fn push(&mut self, arguments: std::fmt::Arguments<'_>) {
        self.text.write_fmt(arguments).expect("a string takes all that is written to it");
    }
}

impl Anchor {
    fn attribute(self) -> &'static str {
        match self {
            Self::Start => "",
            Self::Middle => " text-anchor=\"middle\"",
            Self::End => " text-anchor=\"end\"",
        }
    }
}

/// `text` as XML character data: names come from users' files and may hold anything.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            // XML 1.0 has no way to write control characters.
            c if c.is_control() => out.push(' '),
            '\u{FFFE}' | '\u{FFFF}' => out.push('\u{FFFD}'),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_from_users_cannot_break_the_document() {
        assert_eq!(escaped("a<b>&\u{7}\n\u{FFFF}é"), "a&lt;b&gt;&amp;  \u{FFFD}é");
    }
}
