use std::path::Path;

use righting_ipopt::OptionValue;

use crate::Outcome;

/// What Ipopt's own clocks say, which run around any linear solver: processor time, s.
pub struct IpoptTiming {
    /// Assembling the augmented systems, factorising them and solving with them; without the
    /// symbolic factorisation, which is done once.
    pub augmented_system_s: f64,
    /// The same without assembling, where Ipopt times it: not around MUMPS.
    pub factor_and_solve_s: Option<f64>,
    /// Functions and derivatives.
    pub evaluation_s: f64,
    /// All iterations.
    pub total_s: f64,
}

impl IpoptTiming {
    /// Options that make Ipopt write its times to a file.
    pub fn options(file: &Path) -> Vec<(String, OptionValue)> {
        let text = |value: &str| OptionValue::Text(value.to_owned());
        vec![
            ("print_timing_statistics".to_owned(), text("yes")),
            ("output_file".to_owned(), text(&file.to_string_lossy())),
            ("file_print_level".to_owned(), OptionValue::Integer(3)),
        ]
    }

    /// Reads them: lines such as `LinearSystemFactorization..: 0.123 (sys: 0.0 wall: 0.1)`.
    pub fn read(file: &Path) -> Outcome<Self> {
        let text = std::fs::read_to_string(file)?;
        let processor_s = |name: &str| -> Outcome<f64> {
            let line = text.lines().map(str::trim).find_map(|line| line.strip_prefix(name));
            let value = line.and_then(|line| line.split_once(':')).ok_or("no times by Ipopt")?.1;
            Ok(value.split_whitespace().next().ok_or("no time")?.parse()?)
        };
        let factorization_s = processor_s("LinearSystemFactorization")?;
        let back_solve_s = processor_s("LinearSystemBackSolve")?;
        Ok(Self {
            augmented_system_s: processor_s("StdAugSystemSolverMultiSolve")?
                - processor_s("LinearSystemSymbolicFactorization")?,
            factor_and_solve_s: (factorization_s > 0.0).then_some(factorization_s + back_solve_s),
            evaluation_s: processor_s("Function Evaluations")?,
            total_s: processor_s("OverallAlgorithm")?,
        })
    }
}
