use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

use arbitrary::Unstructured;
use clap::ValueEnum;

use crate::workspace::Workspace;
use crate::{journal, json, plan_files, robot, solve};

/// What inputs are made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, ValueEnum)]
pub enum Target {
    /// Scenario files.
    Scenario,
    /// System files.
    System,
    /// Files of wheels.
    Wheels,
    /// Sweep files.
    Sweep,
    /// Robots as URDF.
    Urdf,
    /// Tables of trajectories.
    Trajectory,
    /// Folders of plans, read and verified.
    Solution,
    /// Files of records of a sweep.
    Journal,
    /// Whole solves of random maneuvers.
    Solve,
}

/// What became of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// A reader took it.
    Accepted,
    /// It was refused with a message.
    Refused,
    /// A maneuver that no motion of the arm makes.
    Impossible,
    /// The solve ended without a plan.
    NoPlan,
    /// With one that failed its verification.
    NotVerified,
    /// With one that passed.
    Verified,
}

impl Target {
    /// Runs the input that these bytes make; the property that it breaks, if any.
    ///
    /// # Errors
    /// What is wrong, in a sentence with the input or a part of it.
    pub fn check(self, bytes: &[u8], workspace: &Workspace) -> Result<Outcome, String> {
        let mut u = Unstructured::new(bytes);
        let run = AssertUnwindSafe(|| match self {
            Self::Scenario => json::SCENARIO.check(&mut u),
            Self::System => json::SYSTEM.check(&mut u),
            Self::Wheels => json::WHEELS.check(&mut u),
            Self::Sweep => json::SWEEP.check(&mut u),
            Self::Urdf => robot::check(&mut u, workspace),
            Self::Trajectory => plan_files::check_table(&mut u, workspace),
            Self::Solution => plan_files::check_folder(&mut u, workspace),
            Self::Journal => journal::check(&mut u, workspace),
            Self::Solve => solve::check(&mut u, workspace),
        });
        // The panic itself says where it was.
        catch_unwind(run).unwrap_or_else(|_| Err("a panic".to_owned()))
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Accepted => "accepted",
            Self::Refused => "refused",
            Self::Impossible => "impossible",
            Self::NoPlan => "no plan",
            Self::NotVerified => "not verified",
            Self::Verified => "verified",
        })
    }
}
