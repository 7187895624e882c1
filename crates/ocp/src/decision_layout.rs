use std::ops::Range;

/// How many of what a transcribed problem has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ShootingDimensions {
    /// States per node, passive ones left out.
    pub states: usize,
    /// Those of them whose initial values are free.
    pub free: usize,
    /// Controls per step.
    pub controls: usize,
    /// Path constraints per node after the first.
    pub path: usize,
    /// Stage constraints per step.
    pub stage: usize,
    /// Constraints at the last node.
    pub terminal: usize,
    /// Steps N; nodes run from 0 to N.
    pub steps: usize,
}

/// Where everything lives in the decision vector and in the constraint vector. Nothing else does
/// index arithmetic on them.
///
/// ```text
/// z = [free entries of x_0, u_0, x_1, u_1, x_2, …, u_{N−1}, x_N]      (the rest of x_0 is data)
/// g = [s_0, defect_0, c(x_1), s_1, defect_1, c(x_2), …, c(x_N), e(x_N)]
/// ```
///
/// where s_k = s(x_k, u_k, Δt) are the stage constraints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DecisionLayout {
    dimensions: ShootingDimensions,
}

impl DecisionLayout {
    /// The layout of a problem of these dimensions.
    pub fn new(dimensions: ShootingDimensions) -> Self {
        Self { dimensions }
    }

    /// The dimensions it was made for.
    pub fn dimensions(&self) -> ShootingDimensions {
        self.dimensions
    }

    /// Length of the decision vector.
    pub fn variables(&self) -> usize {
        self.dimensions.free + self.dimensions.steps * self.node_stride()
    }

    /// Where the free entries of x_0 are.
    pub fn free(&self) -> Range<usize> {
        0..self.dimensions.free
    }

    /// Length of the constraint vector.
    pub fn constraints(&self) -> usize {
        self.dimensions.steps * self.row_stride() + self.dimensions.terminal
    }

    /// Where u_k is, k = 0…N−1.
    pub fn control(&self, step: usize) -> Range<usize> {
        let start = self.dimensions.free + step * self.node_stride();
        start..start + self.dimensions.controls
    }

    /// Where x_k is, k = 1…N.
    pub fn state(&self, node: usize) -> Range<usize> {
        let end = self.dimensions.free + node * self.node_stride();
        end - self.dimensions.states..end
    }

    /// Where s(x_k, u_k, Δt) is, k = 0…N−1.
    pub fn stage(&self, step: usize) -> Range<usize> {
        let start = step * self.row_stride();
        start..start + self.dimensions.stage
    }

    /// Where x_{k+1} − F(x_k, u_k) is, k = 0…N−1.
    pub fn defect(&self, step: usize) -> Range<usize> {
        let start = step * self.row_stride() + self.dimensions.stage;
        start..start + self.dimensions.states
    }

    /// Where c(x_k) is, k = 1…N.
    pub fn path(&self, node: usize) -> Range<usize> {
        let end = node * self.row_stride();
        end - self.dimensions.path..end
    }

    /// Where e(x_N) is.
    pub fn terminal(&self) -> Range<usize> {
        let start = self.dimensions.steps * self.row_stride();
        start..start + self.dimensions.terminal
    }

    fn node_stride(&self) -> usize {
        self.dimensions.states + self.dimensions.controls
    }

    fn row_stride(&self) -> usize {
        self.dimensions.stage + self.dimensions.states + self.dimensions.path
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_parts_tile_both_vectors() {
        let dimensions = ShootingDimensions {
            states: 5,
            free: 2,
            controls: 2,
            path: 3,
            stage: 2,
            terminal: 4,
            steps: 7,
        };
        let layout = DecisionLayout::new(dimensions);
        let mut variables = vec![0; layout.variables()];
        let mut rows = vec![0; layout.constraints()];
        layout.free().for_each(|i| variables[i] += 1);
        for k in 0..dimensions.steps {
            layout.control(k).chain(layout.state(k + 1)).for_each(|i| variables[i] += 1);
            let parts = layout.stage(k).chain(layout.defect(k)).chain(layout.path(k + 1));
            parts.for_each(|i| rows[i] += 1);
        }
        layout.terminal().for_each(|i| rows[i] += 1);
        assert!(variables.iter().chain(&rows).all(|&count| count == 1));
    }
}
