//! A part of a sweep's cases.

use std::fmt;
use std::str::FromStr;

/// Shard i of n: the cases i − 1, i − 1 + n, i − 1 + 2n, … of the plan. Neighbours go to different
/// shards, so that hard corners of a sweep are shared out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

/// The most shards.
const MOST: usize = 1_000_000;

impl Shard {
    /// The whole sweep.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Indices of its cases in a sweep of so many.
    pub fn indices(self, cases: usize) -> impl Iterator<Item = usize> {
        (self.number - 1..cases).step_by(self.of)
    }

    /// Whether it is the only one.
    pub fn is_whole(self) -> bool {
        self.of == 1
    }

    /// Name of its file of records.
    pub fn file_name(self) -> String {
        format!("{}-of-{}.jsonl", self.number, self.of)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text.split_once('/').and_then(|(number, of)| {
            Some(Self { number: number.parse().ok()?, of: of.parse().ok()? })
        });
        parsed
            .filter(|shard| shard.of <= MOST && (1..=shard.of).contains(&shard.number))
            .ok_or_else(|| format!("expected i/n with i from 1 to n and n up to {MOST}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_share_out_every_case_once() {
        let mut all: Vec<usize> =
            (1..=7).flat_map(|i| format!("{i}/7").parse::<Shard>().unwrap().indices(100)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..100).collect::<Vec<_>>());
        assert_eq!("7/8".parse::<Shard>().unwrap().indices(3).count(), 0);
        for bad in ["", "1", "0/3", "4/3", "1/0", "a/b", "1/3/4", "-1/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
