//! Values that readers trip over.

use arbitrary::{Result, Unstructured};
use serde_json::{Value, json};

/// Numbers at and beyond the edges of what makes sense.
const NUMBERS: [f64; 18] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-3,
    1e3,
    90.0,
    360.0,
    1e-300,
    -1e-300,
    5e-324,
    1e16,
    1e19,
    1e150,
    1e300,
    f64::MAX,
    f64::MIN,
];

/// Texts: empty, blank, long, of several lines, with signs that move the cursor, other scripts, paths.
const TEXTS: [&str; 12] = [
    "",
    " ",
    "a\nb",
    "\u{1b}[2J",
    "\u{202e}gnithgir",
    "\u{65e5}\u{672c}\u{8a9e}",
    "..",
    "systems/xlink_4dof.json",
    "slew_2dof.json",
    "null",
    "1e999",
    "\u{0}",
];

/// A number.
pub(crate) fn number(u: &mut Unstructured<'_>) -> Result<f64> {
    Ok(match u.int_in_range(0..=3)? {
        0 => *u.choose(&NUMBERS)?,
        1 => f64::from(u.arbitrary::<i16>()?) / 16.0,
        2 => f64::from(u.arbitrary::<i8>()?),
        _ => {
            let any = f64::from_bits(u.arbitrary()?);
            if any.is_finite() { any } else { 2.0 }
        }
    })
}

/// A text.
pub(crate) fn text(u: &mut Unstructured<'_>) -> Result<String> {
    Ok(match u.int_in_range(0..=9)? {
        0 => "x".repeat(usize::from(u.arbitrary::<u16>()?)),
        1 => u.arbitrary::<&str>()?.to_owned(),
        _ => (*u.choose(&TEXTS)?).to_owned(),
    })
}

/// Any JSON value, whatever should be there.
pub(crate) fn value(u: &mut Unstructured<'_>) -> Result<Value> {
    Ok(match u.int_in_range(0..=9)? {
        0 => Value::Null,
        1 => json!(u.arbitrary::<bool>()?),
        2 => json!(text(u)?),
        3 => json!([]),
        4 => json!({}),
        5 => json!([number(u)?, number(u)?, number(u)?]),
        6 => deep(usize::from(u.arbitrary::<u8>()?)),
        _ => json!(number(u)?),
    })
}

/// Arrays within arrays.
fn deep(levels: usize) -> Value {
    (0..levels).fold(json!(1), |inner, _| json!([inner]))
}
