//! Sizes of the stage problem and the one place that knows where each unknown sits.

/// Sizes at one node of the horizon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct NodeDims {
    /// States that are decision variables here (none at node 0 when the initial state is eliminated).
    pub states: usize,
    /// Controls held from this node to the next.
    pub controls: usize,
    /// Equality constraints on this node's states and controls alone, besides the defects.
    pub equalities: usize,
    /// Inequality constraints on this node's states and controls; each has a slack in Ipopt.
    pub inequalities: usize,
}

/// Sizes of a multiple-shooting problem, node by node.
///
/// The decision vector is `[x_0, u_0, x_1, u_1, …, x_N, u_N]`, where any part may be empty; the
/// constraints are `[path_0, defect_0, path_1, defect_1, …, path_N]`, where `defect_k` has one row
/// for each state of node `k + 1` and `path_k` holds the equalities and inequalities of node `k`
/// in any order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StageDims {
    nodes: Vec<NodeDims>,
}

impl StageDims {
    /// Sizes given for each node, the first to the last. An empty list is the empty problem.
    pub fn new(nodes: Vec<NodeDims>) -> Self {
        Self { nodes }
    }

    /// `steps + 1` nodes: no states at node 0, no controls at the last node, and `path`
    /// inequalities at every node but node 0.
    pub fn uniform(states: usize, controls: usize, path: usize, steps: usize) -> Self {
        let node = NodeDims { states, controls, equalities: 0, inequalities: path };
        let mut nodes = vec![node; steps + 1];
        nodes[0] = NodeDims { states: 0, inequalities: 0, ..node };
        nodes[steps].controls = 0;
        Self { nodes }
    }

    /// The nodes in order.
    pub fn nodes(&self) -> &[NodeDims] {
        &self.nodes
    }
}

/// What one unknown of the augmented system is; indices count within the node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// Decision variable: the states first, then the controls.
    Variable(u32),
    /// Slack of an inequality.
    Slack(u32),
    /// Multiplier of the defect that leads from this node to the next.
    Defect(u32),
    /// Multiplier of an equality.
    Equality(u32),
    /// Multiplier of an inequality.
    Inequality(u32),
}

/// Offsets of one node's unknowns in the augmented vector `[z, s, y_c, y_d]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeOffsets {
    pub dims: NodeDims,
    /// Rows of the defect that leads to the next node: the states there.
    pub defects: usize,
    pub variable: usize,
    pub slack: usize,
    pub equality: usize,
    pub defect: usize,
    pub inequality: usize,
}

impl NodeOffsets {
    /// First control in the augmented vector.
    pub fn control(&self) -> usize {
        self.variable + self.dims.states
    }
}

/// Where every unknown of the augmented system sits.
#[derive(Debug, Clone)]
pub(super) struct SystemLayout {
    pub nodes: Vec<NodeOffsets>,
    pub order: usize,
}

impl SystemLayout {
    pub fn new(dims: &StageDims) -> Self {
        let count = |size: fn(&NodeDims) -> usize| dims.nodes.iter().map(size).sum::<usize>();
        let defects = count(|node| node.states) - dims.nodes.first().map_or(0, |node| node.states);
        let mut variable = 0;
        let mut slack = count(|node| node.states + node.controls);
        let mut equality = slack + count(|node| node.inequalities);
        let mut inequality = equality + count(|node| node.equalities) + defects;
        let mut nodes = Vec::with_capacity(dims.nodes.len());
        for (k, node) in dims.nodes.iter().enumerate() {
            let next_states = dims.nodes.get(k + 1).map_or(0, |next| next.states);
            nodes.push(NodeOffsets {
                dims: *node,
                defects: next_states,
                variable,
                slack,
                equality,
                defect: equality + node.equalities,
                inequality,
            });
            variable += node.states + node.controls;
            slack += node.inequalities;
            equality += node.equalities + next_states;
            inequality += node.inequalities;
        }
        Self { nodes, order: inequality }
    }

    /// Whether these are the sizes that it was made of.
    pub fn has_dims(&self, dims: &StageDims) -> bool {
        self.nodes.iter().map(|node| &node.dims).eq(&dims.nodes)
    }

    /// Constraints of the problem.
    pub fn constraints(&self) -> usize {
        let rows =
            |node: &NodeOffsets| node.defects + node.dims.equalities + node.dims.inequalities;
        self.nodes.iter().map(rows).sum()
    }

    /// Node and role of every unknown, in order.
    pub fn roles(&self) -> Vec<(u32, Role)> {
        let mut roles = vec![(0, Role::Variable(0)); self.order];
        for (node, k) in self.nodes.iter().zip(0..) {
            let mut fill = |start: usize, count: usize, role: fn(u32) -> Role| {
                for (unknown, i) in roles[start..start + count].iter_mut().zip(0..) {
                    *unknown = (k, role(i));
                }
            };
            fill(node.variable, node.dims.states + node.dims.controls, Role::Variable);
            fill(node.slack, node.dims.inequalities, Role::Slack);
            fill(node.equality, node.dims.equalities, Role::Equality);
            fill(node.defect, node.defects, Role::Defect);
            fill(node.inequality, node.dims.inequalities, Role::Inequality);
        }
        roles
    }
}
