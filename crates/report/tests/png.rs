//! Figures as PNG, decoded again.
#![cfg(feature = "png")]

mod common;

use std::path::Path;

use resvg::tiny_skia::Pixmap;
use righting_report::{FigureWriter, attitude_svg};

/// Grey levels of a PNG, row by row, and its width and height.
fn decoded(path: &Path) -> (Vec<u8>, [u32; 2]) {
    let pixmap = Pixmap::load_png(path).expect("a whole PNG");
    let grey = pixmap.pixels().iter().map(|pixel| {
        assert_eq!(pixel.alpha(), 255, "the page is opaque");
        let sum = u16::from(pixel.red()) + u16::from(pixel.green()) + u16::from(pixel.blue());
        (sum / 3) as u8
    });
    (grey.collect(), [pixmap.width(), pixmap.height()])
}

/// Number of dark pixels in the rows of the title.
fn ink_of_title(path: &Path) -> usize {
    let (pixels, [width, _]) = decoded(path);
    let rows = pixels.chunks_exact(width as usize).take(60);
    rows.flatten().filter(|&&grey| grey < 80).count()
}

#[test]
fn a_png_shows_the_text_of_its_figure_at_twice_the_size() {
    let (solution, trajectory) = common::result("slew", 4, 600);
    let svg = attitude_svg(&solution, &trajectory);
    let folder = tempfile::tempdir().unwrap();
    let writer = FigureWriter::svg_and_png().expect("this machine has fonts");
    let files = writer.write(folder.path(), "attitude.svg", &svg).unwrap();
    let png = folder.path().join("attitude.png");
    assert_eq!(files, [folder.path().join("attitude.svg"), png.clone()]);

    let document = roxmltree::Document::parse(&svg).unwrap();
    let side = |name| document.root_element().attribute(name).unwrap().parse::<u32>().unwrap();
    let (pixels, size) = decoded(&png);
    assert_eq!(size, [2 * side("width"), 2 * side("height")]);
    assert_eq!(pixels[0], 255, "the page is white");

    // One stroke of a lowercase letter is some 17 pixels high and 2 wide; the title has seven letters.
    assert!(ink_of_title(&png) > 7 * 34, "{}", ink_of_title(&png));
    // The same rows without any text are bare.
    writer
        .write(folder.path(), "bare.svg", &svg.replace("<text", "<g").replace("</text", "</g"))
        .unwrap();
    assert_eq!(ink_of_title(&folder.path().join("bare.png")), 0);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 4);

    // One that cannot be drawn leaves no picture of what was there before.
    let vast = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1e9\" height=\"1e9\"/>";
    let refused = writer.write(folder.path(), "bare.svg", vast).unwrap_err();
    assert!(refused.to_string().ends_with("bare.png: the figure is too large"), "{refused}");
    assert!(!folder.path().join("bare.png").exists());
}

#[test]
fn without_being_asked_there_is_no_png() {
    let folder = tempfile::tempdir().unwrap();
    // That of an earlier figure would show something else than the new one.
    std::fs::write(folder.path().join("a.png"), "").unwrap();
    let files = FigureWriter::svg().write(folder.path(), "a.svg", "<svg/>").unwrap();
    assert_eq!(files, [folder.path().join("a.svg")]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}
