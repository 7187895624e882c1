//! Figures as PNG, for what takes no SVG.

use std::sync::Arc;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::fontdb::{Database, Family, Query};
use resvg::usvg::{Options, Tree};

use crate::ReportError;

/// Pixels a CSS pixel: 192 to the inch.
const SCALE: f32 = 2.0;

/// Draws figures with the fonts of this machine.
pub struct PngPainter {
    options: Options<'static>,
}

impl PngPainter {
    /// Looks for fonts, once for all figures.
    ///
    /// # Errors
    /// [`ReportError::NoFonts`] where there are none: text would be left out silently.
    pub fn new() -> Result<Self, ReportError> {
        let mut fonts = Database::new();
        fonts.load_system_fonts();
        Self::with(fonts)
    }

    fn with(mut fonts: Database) -> Result<Self, ReportError> {
        let sans_serif = Query { families: &[Family::SansSerif], ..Query::default() };
        if fonts.query(&sans_serif).is_none() {
            // Whatever is there stands in for a sans serif that the machine names but lacks.
            let family = fonts.faces().find_map(|face| Some(face.families.first()?.0.clone()));
            fonts.set_sans_serif_family(family.ok_or(ReportError::NoFonts)?);
        }
        Ok(Self { options: Options { fontdb: Arc::new(fonts), ..Options::default() } })
    }

    /// A figure as the bytes of a PNG file, or what is in the way.
    pub fn paint(&self, svg: &str) -> Result<Vec<u8>, String> {
        let tree = Tree::from_str(svg, &self.options).map_err(|error| error.to_string())?;
        let size = tree.size().to_int_size().scale_by(SCALE);
        let pixmap = size.and_then(|size| Pixmap::new(size.width(), size.height()));
        let mut pixmap = pixmap.ok_or("the figure is too large")?;
        resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixmap.as_mut());
        pixmap.encode_png().map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_without_fonts_is_refused() {
        let refused = PngPainter::with(Database::new()).err();
        assert!(matches!(refused, Some(ReportError::NoFonts)), "{refused:?}");
    }

    #[test]
    fn what_is_no_figure_is_refused() {
        let painter = PngPainter::new().expect("this machine has fonts");
        assert!(painter.paint("no figure").is_err());
        let vast = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1e9\" height=\"1e9\"/>";
        assert_eq!(painter.paint(vast).unwrap_err(), "the figure is too large");
    }
}
