//! What was assumed while a file was read.

use crate::error::listed;

/// Remarks on what was accepted; alike ones are gathered, since robots have many links.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    lines: Vec<String>,
    /// Names of links without mass properties.
    pub massless: Vec<String>,
    /// Files of meshes that capsules stand for.
    pub bounded_meshes: Vec<String>,
    /// Files of meshes that were not read, and why.
    pub lost_meshes: Vec<String>,
}

impl Notes {
    /// Adds a remark.
    pub fn push(&mut self, line: String) {
        self.lines.push(line);
    }

    /// All of them, a sentence each.
    pub fn into_lines(self) -> Vec<String> {
        let gathered = [
            ("without <inertial>, taken without mass", self.massless),
            ("capsules stand for meshes", self.bounded_meshes),
            ("meshes that are not read, so that nothing stands for them", self.lost_meshes),
        ];
        let mut lines = self.lines;
        for (what, names) in gathered.iter().filter(|(_, names)| !names.is_empty()) {
            lines.push(format!("{what}: {}", listed(names.iter().map(String::as_str))));
        }
        lines
    }
}
