//! A joint and a number, as an argument says them.

use std::str::FromStr;

/// Such as `elbow=90`.
#[derive(Clone, Debug, PartialEq)]
pub struct JointValue {
    /// Name of the joint.
    pub joint: String,
    /// The number.
    pub value: f64,
}

impl FromStr for JointValue {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        // A joint's name may hold the sign itself.
        let (joint, value) = text.rsplit_once('=').ok_or("expected JOINT=VALUE")?;
        match value.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(Self { joint: joint.to_owned(), value }),
            _ => Err(format!("found {value} after the sign, expected a number")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_may_hold_the_sign() {
        let of = |text: &str| text.parse::<JointValue>();
        let value = |joint: &str, value| Ok(JointValue { joint: joint.to_owned(), value });
        assert_eq!(of("elbow=-90.5"), value("elbow", -90.5));
        assert_eq!(of("a=b=1"), value("a=b", 1.0));
        assert!(of("elbow").is_err());
        assert!(of("elbow=nan").is_err());
    }
}
