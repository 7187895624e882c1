//! The reaction wheels that an arm is compared with.

use pyo3::prelude::*;
use righting_scenario::WheelArray;
use righting_scenario::json::FileKind;

use crate::failure::{Failure, Outcome};
use crate::input::{Input, named};

/// Those of a file or a mapping; the pyramid of four where none are given.
pub fn wheels(source: Option<&Bound<'_, PyAny>>) -> Outcome<WheelArray> {
    let Some(source) = source else { return Ok(WheelArray::pyramid()) };
    let read = match Input::of(source)? {
        Input::File(file) => WheelArray::read(&file),
        Input::Text(text) => WheelArray::parse(&text, &named(None, "wheels")),
    };
    read.map_err(Failure::of_input(FileKind::Wheels))
}
