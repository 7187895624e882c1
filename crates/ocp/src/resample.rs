use crate::decision_layout::{DecisionLayout, ShootingDimensions};
use crate::primal_dual_point::PrimalDualPoint;

/// Weights of linear interpolation: `(1 − fraction) · before + fraction · after`.
#[derive(Clone, Copy)]
struct LinearInterpolation {
    before: usize,
    after: usize,
    fraction: f64,
}

impl LinearInterpolation {
    /// At `position` among samples at 0, 1, …, `last`; held beyond the ends.
    fn new(position: f64, last: usize) -> Self {
        let position = position.clamp(0.0, last as f64);
        let before = (position.floor() as usize).min(last);
        Self { before, after: (before + 1).min(last), fraction: position - before as f64 }
    }

    fn blend(self, sample: impl Fn(usize) -> f64) -> f64 {
        (1.0 - self.fraction) * sample(self.before) + self.fraction * sample(self.after)
    }
}

impl PrimalDualPoint {
    /// The point carried over to a grid of `steps` steps over the same horizon, from `initial`, x_0
    /// without the passive states.
    ///
    /// States are interpolated at the nodes, controls at the middles of the steps and costates at
    /// their ends. The multipliers of bounds, path and stage constraints are densities in time: they
    /// shrink with the step.
    pub fn resampled(&self, initial: &[f64], steps: usize) -> Self {
        let old = self.layout;
        let coarse = old.dimensions().steps;
        let layout = DecisionLayout::new(ShootingDimensions { steps, ..old.dimensions() });
        let ratio = coarse as f64 / steps as f64;
        let mut point = Self {
            layout,
            z: vec![0.0; layout.variables()],
            constraints: vec![0.0; layout.constraints()],
            lower: vec![0.0; layout.variables()],
            upper: vec![0.0; layout.variables()],
        };
        for index in layout.free() {
            point.z[index] = self.z[index];
            point.lower[index] = self.lower[index];
            point.upper[index] = self.upper[index];
        }
        for step in 0..steps {
            let middle = LinearInterpolation::new((step as f64 + 0.5) * ratio - 0.5, coarse - 1);
            for (index, target) in layout.control(step).enumerate() {
                let source = |k: usize| old.control(k).start + index;
                point.z[target] = middle.blend(|k| self.z[source(k)]);
                point.lower[target] = ratio * middle.blend(|k| self.lower[source(k)]);
                point.upper[target] = ratio * middle.blend(|k| self.upper[source(k)]);
            }
            // Node k is sample k; the quantities that only exist at nodes 1…N hold before node 1.
            let node = LinearInterpolation::new((step as f64 + 1.0) * ratio, coarse);
            let inner = LinearInterpolation::new((step as f64 + 1.0) * ratio - 1.0, coarse - 1);
            for (index, target) in layout.state(step + 1).enumerate() {
                let source = |k: usize| old.state(k).start + index;
                point.z[target] =
                    node.blend(|k| if k == 0 { initial[index] } else { self.z[source(k)] });
                point.lower[target] = ratio * inner.blend(|k| self.lower[source(k + 1)]);
                point.upper[target] = ratio * inner.blend(|k| self.upper[source(k + 1)]);
            }
            for (index, target) in layout.defect(step).enumerate() {
                point.constraints[target] =
                    inner.blend(|k| self.constraints[old.defect(k).start + index]);
            }
            for (index, target) in layout.stage(step).enumerate() {
                point.constraints[target] =
                    ratio * middle.blend(|k| self.constraints[old.stage(k).start + index]);
            }
            for (index, target) in layout.path(step + 1).enumerate() {
                point.constraints[target] =
                    ratio * inner.blend(|k| self.constraints[old.path(k + 1).start + index]);
            }
        }
        point.constraints[layout.terminal()].copy_from_slice(&self.constraints[old.terminal()]);
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One state x = t², one control u = 2t held at the middle of each step, on t ∈ [0, 1].
    fn parabola(steps: usize) -> PrimalDualPoint {
        let layout = DecisionLayout::new(ShootingDimensions {
            states: 1,
            free: 0,
            controls: 1,
            path: 1,
            stage: 1,
            terminal: 0,
            steps,
        });
        let mut z = vec![0.0; layout.variables()];
        let mut constraints = vec![0.0; layout.constraints()];
        for k in 0..steps {
            let end = (k + 1) as f64 / steps as f64;
            z[layout.control(k).start] = 2.0 * (k as f64 + 0.5) / steps as f64;
            z[layout.state(k + 1).start] = end * end;
            constraints[layout.defect(k).start] = 1.0 - end;
            constraints[layout.path(k + 1).start] = 1.0 / steps as f64;
            constraints[layout.stage(k).start] = (k as f64 + 0.5) / (steps as f64).powi(2);
        }
        let bounds = vec![0.5 / steps as f64; z.len()];
        PrimalDualPoint { layout, z, constraints, lower: bounds.clone(), upper: bounds }
    }

    #[test]
    fn a_finer_grid_sees_the_same_functions_of_time() {
        let (coarse, fine) = (parabola(10), parabola(40));
        let resampled = coarse.resampled(&[0.0], 40);
        let layout = fine.layout;
        for step in 2..38 {
            let (control, state) = (layout.control(step).start, layout.state(step).start);
            assert!((resampled.z[control] - fine.z[control]).abs() < 1e-12);
            // A chord of x = t² over 0.1 lies above it by at most 0.1²/4.
            assert!((resampled.z[state] - fine.z[state]).abs() < 2.6e-3);
            assert!((resampled.lower[state] - fine.lower[state]).abs() < 1e-15);
            let (defect, path) = (layout.defect(step).start, layout.path(step).start);
            let expected = fine.constraints[defect].clamp(0.0, 0.9);
            assert!((resampled.constraints[defect] - expected).abs() < 1e-12);
            assert!((resampled.constraints[path] - fine.constraints[path]).abs() < 1e-15);
            let stage = layout.stage(step).start;
            assert!((resampled.constraints[stage] - fine.constraints[stage]).abs() < 1e-15);
        }
    }

    #[test]
    fn the_same_grid_changes_nothing() {
        let point = parabola(12);
        let same = point.resampled(&[0.0], 12);
        assert_eq!(same.z, point.z);
        assert_eq!(same.constraints, point.constraints);
        assert_eq!(same.upper, point.upper);
    }
}
