//! The expression graph: a thread-local arena of hash-consed nodes.

use std::cell::RefCell;
use std::marker::PhantomData;
use std::sync::atomic::{AtomicU32, Ordering};

use hashbrown::HashTable;

use crate::op::{Binary, Unary};

/// Position of a node in its arena; operands always precede their users.
pub(crate) type NodeId = u32;

/// One operation on earlier nodes.
#[derive(Copy, Clone, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    /// The bits of a number; zero is never negative here.
    Constant(u64),
    /// Index into [`Arena::symbol_name`].
    Symbol(u32),
    Unary(Unary, NodeId),
    Binary(Binary, NodeId, NodeId),
    /// Condition, choice where it is positive, choice elsewhere.
    Select(NodeId, NodeId, NodeId),
}

impl Node {
    /// The operands, in order.
    pub(crate) fn operands(self) -> impl Iterator<Item = NodeId> {
        let (count, ids) = match self {
            Node::Constant(_) | Node::Symbol(_) => (0, [0; 3]),
            Node::Unary(_, a) => (1, [a, 0, 0]),
            Node::Binary(_, a, b) => (2, [a, b, 0]),
            Node::Select(a, b, c) => (3, [a, b, c]),
        };
        ids.into_iter().take(count)
    }

    /// The same operation on other operands.
    pub(crate) fn map_operands(self, mut map: impl FnMut(NodeId) -> NodeId) -> Node {
        match self {
            Node::Constant(_) | Node::Symbol(_) => self,
            Node::Unary(op, a) => Node::Unary(op, map(a)),
            Node::Binary(op, a, b) => Node::Binary(op, map(a), map(b)),
            Node::Select(a, b, c) => Node::Select(map(a), map(b), map(c)),
        }
    }

    fn hash(self) -> u64 {
        let (kind, ids) = match self {
            Node::Constant(bits) => (0, [bits as u32, (bits >> 32) as u32, 0]),
            Node::Symbol(index) => (1, [index, 0, 0]),
            Node::Unary(op, a) => (2 + op as u32, [a, 0, 0]),
            Node::Binary(op, a, b) => (32 + op as u32, [a, b, 0]),
            Node::Select(a, b, c) => (64, [a, b, c]),
        };
        let low = (u64::from(ids[0]) << 32 | u64::from(ids[1])) ^ 0x9E37_79B9_7F4A_7C15;
        let high = (u64::from(ids[2]) << 32 | u64::from(kind)) ^ 0xD1B5_4A32_D192_ED03;
        let product = u128::from(low).wrapping_mul(u128::from(high | 1));
        let folded = (product as u64) ^ (product >> 64) as u64;
        folded.wrapping_mul(0x9FB2_1C65_1E98_DF25)
    }
}

/// The nodes of one scope.
#[derive(Debug)]
pub(crate) struct Arena {
    id: u32,
    nodes: Vec<Node>,
    table: HashTable<NodeId>,
    symbol_names: Vec<String>,
}

/// Room for a model's derivatives before the first reallocation.
const EXPECTED_NODES: usize = 1 << 13;

/// Source of arena ids: a handle of one scope must never fit another, on any thread.
static NEXT_ARENA: AtomicU32 = AtomicU32::new(1);

thread_local! {
    static SCOPES: RefCell<Vec<Arena>> = const { RefCell::new(Vec::new()) };
}

impl Arena {
    fn new() -> Self {
        Arena {
            id: NEXT_ARENA.fetch_add(1, Ordering::Relaxed),
            nodes: Vec::with_capacity(EXPECTED_NODES),
            table: HashTable::with_capacity(EXPECTED_NODES),
            symbol_names: Vec::new(),
        }
    }

    /// Runs `work` on the innermost scope's arena.
    ///
    /// # Panics
    /// If no scope is open on this thread.
    pub(crate) fn with<R>(work: impl FnOnce(&mut Arena) -> R) -> R {
        SCOPES.with_borrow_mut(|scopes| match scopes.last_mut() {
            Some(arena) => work(arena),
            None => panic!(
                "no expression graph on this thread: open one with Graph::scope() or trace(), \
                 and keep it open while its expressions are in use"
            ),
        })
    }

    pub(crate) fn id(&self) -> u32 {
        self.id
    }

    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(crate) fn node(&self, id: NodeId) -> Node {
        self.nodes[id as usize]
    }

    pub(crate) fn constant_value(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    pub(crate) fn symbol_name(&self, symbol: u32) -> &str {
        &self.symbol_names[symbol as usize]
    }

    pub(crate) fn new_symbol(&mut self, name: String) -> NodeId {
        let index = u32::try_from(self.symbol_names.len()).expect("fewer than 2^32 symbols");
        self.symbol_names.push(name);
        self.intern(Node::Symbol(index))
    }

    /// The node's existing id, if it is in the arena.
    pub(crate) fn find(&self, node: Node) -> Option<NodeId> {
        self.table.find(node.hash(), |&id| self.nodes[id as usize] == node).copied()
    }

    /// The node's id, added if it is new. No simplification: see the methods in `simplify`.
    pub(crate) fn intern(&mut self, node: Node) -> NodeId {
        let nodes = &mut self.nodes;
        let entry = self.table.entry(
            node.hash(),
            |&id| nodes[id as usize] == node,
            |&id| nodes[id as usize].hash(),
        );
        match entry {
            hashbrown::hash_table::Entry::Occupied(known) => *known.get(),
            hashbrown::hash_table::Entry::Vacant(slot) => {
                let id = u32::try_from(nodes.len()).expect("fewer than 2^32 nodes");
                slot.insert(id);
                nodes.push(node);
                id
            }
        }
    }
}

/// The graph that expressions on this thread belong to.
#[derive(Debug)]
pub struct Graph;

impl Graph {
    /// Opens an empty graph that lasts until the guard is dropped. Scopes nest: the inner one hides
    /// the outer one, whose expressions become usable again when the inner one closes.
    #[must_use = "the graph is freed when this guard is dropped"]
    pub fn scope() -> GraphScope {
        let arena = Arena::new();
        let id = arena.id;
        SCOPES.with_borrow_mut(|scopes| scopes.push(arena));
        GraphScope { id, not_send: PhantomData }
    }

    /// Number of nodes in the innermost open graph; zero with none open.
    pub fn node_count() -> usize {
        SCOPES.with_borrow(|scopes| scopes.last().map_or(0, Arena::len))
    }
}

/// Keeps a graph alive; see [`Graph::scope`].
#[derive(Debug)]
pub struct GraphScope {
    id: u32,
    not_send: PhantomData<*const ()>,
}

impl Drop for GraphScope {
    fn drop(&mut self) {
        SCOPES.with_borrow_mut(|scopes| scopes.retain(|arena| arena.id != self.id));
    }
}

/// Runs `work` in a graph of its own and frees the graph afterwards.
///
/// ```
/// use righting_symbolic::{Expr, Function, trace};
///
/// let square = trace(|| {
///     let x = Expr::symbol("x");
///     Function::builder("square").input("x", &[x]).output("y", &[x * x]).build()
/// })?;
/// let mut workspace = square.workspace();
/// let mut y = [0.0];
/// square.evaluate(&mut workspace, &[&[3.0]], &mut [&mut y]);
/// assert_eq!(y, [9.0]);
/// # Ok::<(), righting_symbolic::FunctionError>(())
/// ```
pub fn trace<R>(work: impl FnOnce() -> R) -> R {
    let _scope = Graph::scope();
    work()
}
