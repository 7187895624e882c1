use righting_nlp::TripletStructure;

use crate::decision_layout::DecisionLayout;
use crate::matrix_output::MatrixOutput;
use crate::node_function::NodeFunction;
use crate::stage_functions::StageFunctions;

/// Where the values of one matrix output belong in the slice of a step or node.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scatter {
    /// Slot of each computed value.
    pub(crate) varying: Vec<usize>,
    /// Slot and value of each constant.
    pub(crate) constant: Vec<(usize, f64)>,
}

impl Scatter {
    fn new(output: &MatrixOutput, slot: impl Fn(usize, usize) -> usize) -> Self {
        let mut scatter = Self::default();
        for (&(row, column), constant) in output.entries.iter().zip(&output.constants) {
            let slot = slot(row, column);
            match constant {
                Some(value) => scatter.constant.push((slot, *value)),
                None => scatter.varying.push(slot),
            }
        }
        scatter
    }
}

/// The constraint Jacobian, step by step:
///
/// ```text
/// step k: [∂defect_k/∂x_k | ∂s_k/∂x_k | ∂defect_k/∂u_k | ∂s_k/∂u_k | ∂defect_k/∂x_{k+1} = I | ∂c(x_{k+1})/∂x_{k+1}]
/// end:    [∂e(x_N)/∂x_N]
/// ```
///
/// Of the columns of x_0 only the free ones are there. Slots count from the start of a whole step.
#[derive(Debug, Clone)]
pub(crate) struct JacobianStructure {
    /// Entries in columns of x_k.
    pub(crate) state_entries: usize,
    /// Entries of a whole step.
    pub(crate) step_entries: usize,
    pub(crate) step: Scatter,
    pub(crate) stage: Scatter,
    /// Slots of the identity.
    pub(crate) next_state: std::ops::Range<usize>,
    pub(crate) path: Scatter,
    pub(crate) terminal: Scatter,
    steps: usize,
    terminal_entries: usize,
    first: FirstSlots,
}

impl JacobianStructure {
    pub(crate) fn new(functions: &StageFunctions, steps: usize) -> Self {
        let n = functions.states;
        let (defect, stage) = (&functions.step.jacobian, &functions.stage.jacobian);
        let [defect_states, defect_controls] = by_variable(defect, n);
        let [stage_states, stage_controls] = by_variable(stage, n);
        let state_entries = defect_states.len() + stage_states.len();
        let stage_controls_start = state_entries + defect_controls.len();
        let identity = stage_controls_start + stage_controls.len();
        let path_start = identity + n;
        let slots = |output, parts: [(usize, &[(usize, usize)]); 2]| {
            let [states, controls] = parts.map(|(start, entries)| (start, find_in(entries)));
            Scatter::new(output, |row, column| {
                let (start, find) = if column < n { &states } else { &controls };
                start + find(row, column)
            })
        };
        let path = &functions.path.jacobian;
        let first = FirstSlots::new(
            defect_states.iter().chain(&stage_states).map(|&(_, j)| functions.free.contains(&j)),
        );
        let step_entries = path_start + path.entries.len();
        let terminal = &functions.terminal.jacobian;
        Self {
            state_entries,
            step_entries,
            step: slots(defect, [(0, &defect_states), (state_entries, &defect_controls)]),
            stage: slots(
                stage,
                [(defect_states.len(), &stage_states), (stage_controls_start, &stage_controls)],
            ),
            next_state: identity..path_start,
            path: Scatter::new(path, |row, column| {
                path_start + find_in(&path.entries)(row, column)
            }),
            terminal: Scatter::new(terminal, find_in(&terminal.entries)),
            steps,
            terminal_entries: terminal.entries.len(),
            first,
        }
    }

    /// The structure of the same functions over another number of steps.
    pub(crate) fn of_steps(self, steps: usize) -> Self {
        Self { steps, ..self }
    }

    /// Number of entries.
    pub(crate) fn entries(&self) -> usize {
        self.terminal_start() + self.terminal_entries
    }

    /// Where a slot of a step is; `None` for the part that step 0 does not have.
    pub(crate) fn entry(&self, step: usize, slot: usize) -> Option<usize> {
        self.first.entry(step, self.step_entries, slot)
    }

    /// Index of the first entry of e(x_N).
    pub(crate) fn terminal_start(&self) -> usize {
        self.steps * self.step_entries - self.state_entries + self.first.kept
    }

    pub(crate) fn triplets(
        &self,
        functions: &StageFunctions,
        layout: &DecisionLayout,
    ) -> TripletStructure {
        let mut triplets = Triplets::with_capacity(self.entries());
        let n = functions.states;
        let [defect_states, defect_controls] = by_variable(&functions.step.jacobian, n);
        let [stage_states, stage_controls] = by_variable(&functions.stage.jacobian, n);
        for step in 0..self.steps {
            let (row, stage_row) = (layout.defect(step).start, layout.stage(step).start);
            for (row, entries) in [(row, &defect_states), (stage_row, &stage_states)] {
                for &(i, j) in entries {
                    if let Some(column) = functions.state_variable(layout, step, j) {
                        triplets.push(row + i, column);
                    }
                }
            }
            let column = layout.control(step).start;
            for (row, entries) in [(row, &defect_controls), (stage_row, &stage_controls)] {
                for &(i, j) in entries {
                    triplets.push(row + i, column + j - n);
                }
            }
            let column = layout.state(step + 1).start;
            for i in 0..n {
                triplets.push(row + i, column + i);
            }
            let row = layout.path(step + 1).start;
            for &(i, j) in &functions.path.jacobian.entries {
                triplets.push(row + i, column + j);
            }
        }
        let (row, column) = (layout.terminal().start, layout.state(self.steps).start);
        for &(i, j) in &functions.terminal.jacobian.entries {
            triplets.push(row + i, column + j);
        }
        triplets.0
    }
}

/// The lower triangle of the Lagrangian Hessian, node by node: `[xx | ux | uu]`. Node 0 has only
/// the last part and what free states have of the others, node N only the first. Slots count from the
/// start of a whole node.
#[derive(Debug, Clone)]
pub(crate) struct HessianStructure {
    ordered: Vec<(usize, usize)>,
    state_entries: usize,
    first_control_entry: usize,
    first: FirstSlots,
    steps: usize,
    pub(crate) step: Scatter,
    pub(crate) running: Scatter,
    pub(crate) path: Scatter,
    pub(crate) stage: Scatter,
    pub(crate) terminal_cost: Scatter,
    pub(crate) terminal: Scatter,
}

impl HessianStructure {
    pub(crate) fn new(functions: &StageFunctions, steps: usize) -> Self {
        let n = functions.states;
        let hessian = |function: &NodeFunction| function.hessian.entries.clone();
        let mut ordered: Vec<(usize, usize)> = [
            functions.step.hessian.entries.clone(),
            hessian(&functions.running),
            hessian(&functions.path),
            hessian(&functions.stage),
            hessian(&functions.terminal_cost),
            hessian(&functions.terminal),
        ]
        .concat();
        ordered.sort_by_key(|&(row, column)| (row >= n, column >= n, row, column));
        ordered.dedup();
        let scatter = |output: &MatrixOutput| Scatter::new(output, find_in(&ordered));
        let first_control_entry = ordered.partition_point(|&(_, column)| column < n);
        let is_variable = |index: usize| index >= n || functions.free.contains(&index);
        let with_states = ordered[..first_control_entry].iter();
        Self {
            state_entries: ordered.partition_point(|&(row, _)| row < n),
            first_control_entry,
            first: FirstSlots::new(
                with_states.map(|&(row, column)| is_variable(row) && is_variable(column)),
            ),
            steps,
            step: scatter(&functions.step.hessian),
            running: scatter(&functions.running.hessian),
            path: scatter(&functions.path.hessian),
            stage: scatter(&functions.stage.hessian),
            terminal_cost: scatter(&functions.terminal_cost.hessian),
            terminal: scatter(&functions.terminal.hessian),
            ordered,
        }
    }

    /// The structure of the same functions over another number of steps.
    pub(crate) fn of_steps(self, steps: usize) -> Self {
        Self { steps, ..self }
    }

    /// Number of entries.
    pub(crate) fn entries(&self) -> usize {
        self.steps * self.ordered.len() - self.first_control_entry
            + self.first.kept
            + self.state_entries
    }

    /// Where a slot of a node is; `None` for the parts that node 0 does not have. Node N has the
    /// slots that couple states alone.
    pub(crate) fn entry(&self, node: usize, slot: usize) -> Option<usize> {
        self.first.entry(node, self.ordered.len(), slot)
    }

    pub(crate) fn triplets(
        &self,
        functions: &StageFunctions,
        layout: &DecisionLayout,
    ) -> TripletStructure {
        let n = functions.states;
        let mut triplets = Triplets::with_capacity(self.entries());
        for node in 0..=self.steps {
            let variable = |index: usize| match index < n {
                true => functions.state_variable(layout, node, index),
                false => Some(layout.control(node).start + index - n),
            };
            let part = match node == self.steps {
                true => &self.ordered[..self.state_entries],
                false => &self.ordered[..],
            };
            for &(row, column) in part {
                if let (Some(row), Some(column)) = (variable(row), variable(column)) {
                    triplets.push(row, column);
                }
            }
        }
        triplets.0
    }
}

/// The leading slots of a step or node, those with states, of which step 0 keeps only what is free.
#[derive(Debug, Clone)]
struct FirstSlots {
    /// Of each slot with states, where step 0 has it.
    places: Vec<Option<usize>>,
    /// How many step 0 has.
    kept: usize,
}

impl FirstSlots {
    fn new(is_kept: impl Iterator<Item = bool>) -> Self {
        let mut kept = 0;
        let places = is_kept
            .map(|is_kept| {
                is_kept.then(|| {
                    kept += 1;
                    kept - 1
                })
            })
            .collect();
        Self { places, kept }
    }

    /// Where a slot of a step is, of steps with so many entries each; `None` where step 0 lacks it.
    fn entry(&self, step: usize, step_entries: usize, slot: usize) -> Option<usize> {
        match (step, self.places.get(slot)) {
            (0, Some(place)) => *place,
            _ => Some(step * step_entries + slot + self.kept - self.places.len()),
        }
    }
}

impl StageFunctions {
    /// Where an active state of a node is in the decision vector; none for a given one of node 0.
    pub(crate) fn state_variable(
        &self,
        layout: &DecisionLayout,
        node: usize,
        index: usize,
    ) -> Option<usize> {
        match node {
            0 => self.free.iter().position(|&free| free == index),
            _ => Some(layout.state(node).start + index),
        }
    }
}

struct Triplets(TripletStructure);

impl Triplets {
    fn with_capacity(entries: usize) -> Self {
        Self(TripletStructure {
            rows: Vec::with_capacity(entries),
            columns: Vec::with_capacity(entries),
        })
    }

    fn push(&mut self, row: usize, column: usize) {
        self.0.rows.push(row as i32);
        self.0.columns.push(column as i32);
    }
}

/// The entries in columns of the states, and those in columns of the controls.
fn by_variable(output: &MatrixOutput, states: usize) -> [Vec<(usize, usize)>; 2] {
    let (of_states, of_controls) = output.entries.iter().partition(|&&(_, column)| column < states);
    [of_states, of_controls]
}

fn find_in(entries: &[(usize, usize)]) -> impl Fn(usize, usize) -> usize {
    let positions: std::collections::HashMap<(usize, usize), usize> =
        entries.iter().enumerate().map(|(slot, &entry)| (entry, slot)).collect();
    move |row, column| positions[&(row, column)]
}
