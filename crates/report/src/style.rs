//! Every colour, size and stroke of every figure.
//!
//! Colours are Okabe and Ito's (2008), which stay apart for every kind of colour vision; each also
//! keeps its own lightness, so that a greyscale print still tells the curves from each other.
//! Lengths are CSS pixels (1/96 inch).

/// Vermillion: the x component.
pub const X: &str = "#D55E00";
/// Bluish green: the y component.
pub const Y: &str = "#009E73";
/// Blue: the z component, and the curve of a panel that has only one.
pub const Z: &str = "#0072B2";
/// Reddish purple: the scalar part of a quaternion.
pub const W: &str = "#CC79A7";
/// Magnitudes.
pub const MAGNITUDE: &str = "#000000";
/// Limits and bounds, always dashed.
pub const LIMIT: &str = "#A33B00";
/// What curves are compared with, always dashed.
pub const REFERENCE: &str = "#555555";
/// Curves told apart by number: joints, variants, repeated with another dash where there are more.
/// Okabe and Ito's yellow is left out, which is too light for a line on white,
/// and so is black, which sums are drawn in.
pub const SERIES: [&str; 7] =
    ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#7A7A7A"];
/// Dashes of the first, second … round of [`SERIES`].
pub const SERIES_DASHES: [&str; 3] = ["", "7 3", "2 2"];

/// Text.
pub const INK: &str = "#1A1A1A";
/// Text of lesser weight: subtitles, notes in the corner of a panel.
pub const FAINT_INK: &str = "#5A5A5A";
/// Panel borders.
pub const FRAME: &str = "#8C8C8C";
/// Grid lines.
pub const GRID: &str = "#E4E4E4";
/// The page.
pub const PAPER: &str = "#FFFFFF";

/// Text is left to the reader's own sans serif: no font is embedded.
pub const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

/// Colour and dash pattern of the curve of a joint, counted from zero.
pub fn joint(index: usize) -> (&'static str, &'static str) {
    let round = index / SERIES.len() % SERIES_DASHES.len();
    (SERIES[index % SERIES.len()], SERIES_DASHES[round])
}

/// The title of a figure.
pub const TITLE_SIZE: f64 = 16.0;
/// Headings of panels and axis labels.
pub const LABEL_SIZE: f64 = 12.0;
/// Tick labels, legends, notes.
pub const SMALL_SIZE: f64 = 10.5;
/// Mean advance of a character over the font size, for laying out legends without font metrics.
pub const CHARACTER_ADVANCE: f64 = 0.62;

/// Curves.
pub const CURVE_WIDTH: f64 = 1.6;
/// Limits, targets.
pub const RULE_WIDTH: f64 = 1.1;
/// Frames, ticks and grid.
pub const HAIR_WIDTH: f64 = 0.8;
/// Dash pattern of limits.
pub const LIMIT_DASH: &str = "6 4";
/// Dash pattern of targets.
pub const TARGET_DASH: &str = "1.5 3";

/// Room around the whole figure.
pub const MARGIN: f64 = 14.0;
/// Room left of a panel for its tick labels, up to −2.0e−16.
pub const TICK_LABEL_WIDTH: f64 = 64.0;
/// Room left of a tick column for the rotated axis label.
pub const AXIS_LABEL_WIDTH: f64 = 18.0;
/// Room under the last row for tick labels and the time axis label.
pub const TIME_AXIS_HEIGHT: f64 = 38.0;
/// Room above a panel that has a heading or a legend.
pub const HEADING_HEIGHT: f64 = 20.0;
/// Room between two rows of panels.
pub const ROW_GAP: f64 = 12.0;
/// Room between two columns of panels.
pub const COLUMN_GAP: f64 = 16.0;

/// A limit is drawn to scale while the curves keep this share of the panel's height; otherwise it
/// is drawn at the edge and marked as off scale.
pub const LEAST_CURVE_SHARE: f64 = 0.15;

/// Corners of the colour ramp: viridis (van der Walt and Smith, 2015), even in lightness for every
/// kind of colour vision.
const RAMP: [[u8; 3]; 6] =
    [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81], [253, 231, 37]];

/// The colour at `share` of the ramp, from 0 to 1.
pub fn ramp(share: f64) -> String {
    let last = (RAMP.len() - 1) as f64;
    let at = if share.is_finite() { share.clamp(0.0, 1.0) * last } else { 0.0 };
    let below = (at.floor() as usize).min(RAMP.len() - 2);
    let [r, g, b]: [u8; 3] = std::array::from_fn(|i| {
        let [low, high] = [RAMP[below][i], RAMP[below + 1][i]].map(f64::from);
        (low + (at - below as f64) * (high - low)).round() as u8
    });
    format!("#{r:02X}{g:02X}{b:02X}")
}
