use crate::decision_layout::{DecisionLayout, ShootingDimensions};
use crate::error::OcpError;
use crate::grid::Grid;
use crate::shooting_workspace::ShootingWorkspace;
use crate::stage_functions::StageFunctions;

/// A control problem on a grid, as the sparse nonlinear program that Ipopt solves. See [`DecisionLayout`]
/// for the order of its variables and constraints.
pub struct MultipleShooting<'f> {
    pub(crate) functions: &'f StageFunctions,
    pub(crate) grid: Grid,
    pub(crate) layout: DecisionLayout,
    /// x_0, passive states left out; its free entries are those of the last point.
    pub(crate) initial: Vec<f64>,
    pub(crate) full_initial: Vec<f64>,
    pub(crate) workspace: ShootingWorkspace,
}

impl<'f> MultipleShooting<'f> {
    /// Transcribes the problem behind `functions` on `grid` from the state `initial` (all states of
    /// the problem, passive ones too).
    ///
    /// # Errors
    /// [`OcpError::Dimension`] or [`OcpError::NotFinite`] when `initial` does not fit.
    pub fn new(
        functions: &'f StageFunctions,
        grid: Grid,
        initial: &[f64],
    ) -> Result<Self, OcpError> {
        Self::in_workspace(functions, grid, initial, ShootingWorkspace::new(functions))
    }

    /// The same with the workspace of another program of these functions, on whatever grid.
    ///
    /// # Errors
    /// Those of [`new`](Self::new).
    pub fn in_workspace(
        functions: &'f StageFunctions,
        grid: Grid,
        initial: &[f64],
        workspace: ShootingWorkspace,
    ) -> Result<Self, OcpError> {
        if initial.len() != functions.all_states {
            return Err(OcpError::Dimension {
                what: "initial state",
                expected: functions.all_states,
                found: initial.len(),
            });
        }
        if let Some((index, &value)) = initial.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            return Err(OcpError::NotFinite { what: "initial state", index, value });
        }
        let dimensions = ShootingDimensions {
            states: functions.states,
            free: functions.free.len(),
            controls: functions.controls,
            path: functions.path_bounds.len(),
            stage: functions.stage_bounds.len(),
            terminal: functions.terminal_bounds.len(),
            steps: grid.steps(),
        };
        Ok(Self {
            functions,
            grid,
            layout: DecisionLayout::new(dimensions),
            initial: functions.active.iter().map(|&i| initial[i]).collect(),
            full_initial: initial.to_vec(),
            workspace: workspace.for_steps(grid.steps()),
        })
    }

    /// What another program of the same functions can go on with.
    pub fn into_workspace(self) -> ShootingWorkspace {
        self.workspace
    }

    /// Where everything lives in the vectors.
    pub fn layout(&self) -> DecisionLayout {
        self.layout
    }

    /// The grid it was transcribed on.
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The functions it evaluates.
    pub fn functions(&self) -> &'f StageFunctions {
        self.functions
    }

    /// x_0 without the passive states, with the free entries of a decision vector.
    pub fn initial_state(&self, z: &[f64]) -> Vec<f64> {
        let mut initial = self.initial.clone();
        copy_free(self.functions, z, &mut initial);
        initial
    }

    /// Takes the free entries of x_0 from a decision vector.
    pub(crate) fn start_from(&mut self, z: &[f64]) {
        copy_free(self.functions, z, &mut self.initial);
    }

    /// x_0 with every state of the problem.
    pub fn full_initial_state(&self) -> &[f64] {
        &self.full_initial
    }

    pub(crate) fn steps(&self) -> usize {
        self.grid.steps()
    }
}

fn copy_free(functions: &StageFunctions, z: &[f64], initial: &mut [f64]) {
    for (&place, &value) in functions.free.iter().zip(z) {
        initial[place] = value;
    }
}
