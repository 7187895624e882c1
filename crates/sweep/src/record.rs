//! One finished case as a line of text that knows whether it is whole.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::case::CaseId;
use crate::outcome::Outcome;

/// One finished case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Which case.
    pub case_id: CaseId,
    /// What it came to: the same in every run.
    pub outcome: Outcome,
    /// How it was computed: another time in every run.
    pub run: RunFacts,
}

/// How a case was computed. Nothing here is part of the result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunFacts {
    /// Time in the worker: planning and verifying, s.
    pub solve_s: f64,
    /// How many workers took it on; 2 if the first died.
    pub attempts: u32,
}

/// Hexadecimal digits of the checksum.
const CHECKSUM_DIGITS: usize = 16;

impl Record {
    /// The line, its end included: 16 hexadecimal digits of SHA-256 of the JSON, a space, the JSON.
    pub fn to_line(&self) -> String {
        let json = serde_json::to_string(self).expect("a record is made of what JSON has");
        format!("{} {json}\n", checksum(json.as_bytes()))
    }

    /// Reads a line without its end; none if it is damaged.
    pub fn from_line(line: &[u8]) -> Option<Self> {
        let (sum, json) = line.split_at_checked(CHECKSUM_DIGITS)?;
        let json = json.strip_prefix(b" ")?;
        if sum != checksum(json).as_bytes() {
            return None;
        }
        serde_json::from_slice(json).ok()
    }
}

fn checksum(json: &[u8]) -> String {
    let digest = Sha256::digest(json);
    let bytes: [u8; 8] = digest[..8].try_into().expect("eight bytes of 32");
    format!("{:0width$x}", u64::from_be_bytes(bytes), width = CHECKSUM_DIGITS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outcome::Trouble;

    #[test]
    fn a_line_survives_the_trip_and_damage_shows() {
        let record = Record {
            case_id: CaseId(0xfeed),
            outcome: Outcome::of_trouble(Trouble::Hung, "a\nb"),
            run: RunFacts { solve_s: 0.25, attempts: 2 },
        };
        let line = record.to_line();
        let bytes = line.as_bytes();
        assert_eq!(bytes.iter().filter(|&&byte| byte == b'\n').count(), 1);
        let whole = &bytes[..bytes.len() - 1];
        let read = Record::from_line(whole).unwrap();
        assert_eq!(read.to_line(), line);
        for cut in 0..whole.len() {
            assert!(Record::from_line(&whole[..cut]).is_none());
        }
        for at in 0..whole.len() {
            let mut changed = whole.to_vec();
            changed[at] ^= 1;
            assert!(Record::from_line(&changed).is_none(), "{at}");
        }
    }
}
