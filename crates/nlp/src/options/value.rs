use std::fmt;

/// The value of an option, by its type in Ipopt's reference.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// A floating-point number.
    Number(f64),
    /// An integer.
    Integer(i32),
    /// A keyword; yes and no too are keywords.
    Text(String),
}

impl fmt::Display for OptionValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => write!(f, "{value:?}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Text(value) => f.write_str(value),
        }
    }
}

/// A field's value as an [`OptionValue`].
pub(super) trait Field {
    fn value(self) -> OptionValue;
}

impl Field for f64 {
    fn value(self) -> OptionValue {
        OptionValue::Number(self)
    }
}

impl Field for u32 {
    fn value(self) -> OptionValue {
        OptionValue::Integer(self.try_into().unwrap_or(i32::MAX))
    }
}

impl Field for i32 {
    fn value(self) -> OptionValue {
        OptionValue::Integer(self)
    }
}

impl Field for bool {
    fn value(self) -> OptionValue {
        OptionValue::Text(if self { "yes" } else { "no" }.to_owned())
    }
}

macro_rules! keywords {
    ($($(#[$doc:meta])* $name:ident { $($(#[$item:meta])* $variant:ident = $keyword:literal,)* })*)
    => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name {
            $($(#[$item])* $variant,)*
        }

        impl Field for $name {
            fn value(self) -> OptionValue {
                OptionValue::Text(match self { $(Self::$variant => $keyword,)* }.to_owned())
            }
        }
    )*};
}

keywords! {
    /// How objective and constraints are scaled.
    NlpScaling {
        /// So that no gradient at the start is larger than
        /// [`Options::nlp_scaling_max_gradient`](crate::Options::nlp_scaling_max_gradient).
        GradientBased = "gradient-based",
        /// Not at all.
        None = "none",
    }

    /// What becomes of variables with equal bounds.
    FixedVariables {
        /// They are taken out of the problem; their bound multipliers are then zero.
        MakeParameter = "make_parameter",
        /// They get an equality constraint each.
        MakeConstraint = "make_constraint",
        /// Their bounds are relaxed.
        RelaxBounds = "relax_bounds",
    }

    /// Where the Hessian of the Lagrangian comes from.
    Hessian {
        /// From [`Problem::hessian`](crate::Problem::hessian).
        Exact = "exact",
        /// From gradients, by a limited-memory quasi-Newton update.
        LimitedMemory = "limited-memory",
    }

    /// How the barrier parameter goes down.
    MuStrategy {
        /// In steps, after each barrier problem is solved (Fiacco & McCormick).
        Monotone = "monotone",
        /// Anew in each iteration.
        Adaptive = "adaptive",
    }

    /// What bound multipliers start from.
    MultiplierInitialization {
        /// A constant.
        Constant = "constant",
        /// μ over the distance from the bound.
        MuBased = "mu-based",
    }
}
