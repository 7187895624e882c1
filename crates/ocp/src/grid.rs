use crate::error::OcpError;

/// A uniform time grid t_k = k Δt, k = 0…N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    duration_s: f64,
    steps: usize,
    running_weight: f64,
}

impl Grid {
    /// `steps` equal steps over `duration_s`.
    ///
    /// # Errors
    /// [`OcpError::Grid`] when either is not positive or the duration is not finite.
    pub fn new(duration_s: f64, steps: usize) -> Result<Self, OcpError> {
        if steps == 0 || !duration_s.is_finite() || duration_s <= 0.0 {
            return Err(OcpError::Grid { duration_s, steps });
        }
        Ok(Self { duration_s, steps, running_weight: 1.0 })
    }

    /// The same horizon in another number of steps, with the running cost weighted so that the sum
    /// over the steps stays an approximation of the same integral.
    ///
    /// # Errors
    /// [`OcpError::Grid`] when `steps` is zero.
    pub fn with_steps(&self, steps: usize) -> Result<Self, OcpError> {
        let grid = Self::new(self.duration_s, steps)?;
        let running_weight = self.running_weight * self.steps as f64 / steps as f64;
        Ok(Self { running_weight, ..grid })
    }

    /// The first `steps` steps of this grid alone, divided into `in_steps` steps instead; the running cost is
    /// weighted as in [`with_steps`](Self::with_steps).
    ///
    /// # Errors
    /// [`OcpError::Grid`] when either is zero.
    pub fn beginning(&self, steps: usize, in_steps: usize) -> Result<Self, OcpError> {
        let duration_s = self.step_s() * steps as f64;
        let whole = Self::new(duration_s, steps)?;
        Self { running_weight: self.running_weight, ..whole }.with_steps(in_steps)
    }

    /// Length of the horizon.
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Number of steps N.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Length of a step Δt.
    pub fn step_s(&self) -> f64 {
        self.duration_s / self.steps as f64
    }

    /// Factor on the running cost: 1 on the grid the problem was stated for.
    pub fn running_weight(&self) -> f64 {
        self.running_weight
    }
}
