//! What kind of file a JSON text is, told by its fields.

use std::fmt;

use serde_json::Value;

/// The kinds of JSON file that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A maneuver to plan.
    Scenario,
    /// A spacecraft and its arm.
    System,
    /// Either of these two.
    SystemOrScenario,
    /// Many maneuvers.
    Sweep,
    /// A sweep that is planned: `sweep.json` of its folder.
    PlannedSweep,
    /// The base of a spacecraft alone.
    Base,
    /// Reaction wheels.
    Wheels,
    /// The outcome of a solve.
    Solution,
    /// The outcome of a search for what is possible.
    Reach,
}

impl FileKind {
    /// Such as "a scenario file".
    pub fn phrase(self) -> &'static str {
        match self {
            Self::Scenario => "a scenario file",
            Self::System => "a system file",
            Self::SystemOrScenario => "a system or scenario file",
            Self::Sweep => "a sweep file",
            Self::PlannedSweep => "a planned sweep",
            Self::Base => "a file with a base",
            Self::Wheels => "a file of wheels",
            Self::Solution => "a solution file",
            Self::Reach => "a file of reach",
        }
    }

    /// The kind that a file means to be, whatever else is wrong with it; none if it cannot be told.
    pub(crate) fn of(root: &Value) -> Option<Self> {
        let has = |key| root.get(key).is_some();
        let schema = root.get("schema").and_then(Value::as_str).unwrap_or_default();
        match schema.split('/').next() {
            Some("righting.solution") => Some(Self::Solution),
            Some("righting.reach") => Some(Self::Reach),
            Some("righting.sweep") => Some(Self::PlannedSweep),
            _ if has("vary") => Some(Self::Sweep),
            _ if has("maneuver") || has("system") => Some(Self::Scenario),
            _ if has("links") || has("bodies") => Some(Self::System),
            _ if has("wheels") => Some(Self::Wheels),
            _ if has("mass_kg") => Some(Self::Base),
            _ => None,
        }
    }

    /// Whether a file of kind `found` is one of this kind.
    pub(crate) fn includes(self, found: Self) -> bool {
        match self {
            Self::SystemOrScenario => matches!(found, Self::System | Self::Scenario),
            own => own == found,
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.phrase())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn kinds_are_told_by_fields_that_no_other_kind_has() {
        for (root, kind) in [
            (json!({ "system": "arm.json", "maneuver": {} }), Some(FileKind::Scenario)),
            (json!({ "system": {}, "wheels": [] }), Some(FileKind::Scenario)),
            (json!({ "base": {}, "links": [] }), Some(FileKind::System)),
            (json!({ "base": {}, "bodies": [] }), Some(FileKind::System)),
            (json!({ "scenario": "slew.json", "vary": [] }), Some(FileKind::Sweep)),
            (json!({ "schema": "righting.sweep/1", "sweep": {} }), Some(FileKind::PlannedSweep)),
            (json!({ "wheels": [] }), Some(FileKind::Wheels)),
            (json!({ "mass_kg": 150.0, "cube_side_m": 1.0 }), Some(FileKind::Base)),
            (json!({ "schema": "righting.solution/9" }), Some(FileKind::Solution)),
            (json!({ "schema": "righting.reach/1", "scenario": "a" }), Some(FileKind::Reach)),
            (json!({ "name": "a" }), None),
            (json!([]), None),
        ] {
            assert_eq!(FileKind::of(&root), kind, "{root}");
        }
    }
}
