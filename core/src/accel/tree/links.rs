//! How nodes hang together: first child and next sibling, and from the last sibling back up.
//!
//! Node numbers below the capacity are the leaves of the shapes with these ids; the others follow in
//! the order in which they are made. The way back makes a stack unnecessary (A. J. Perlis and C.
//! Thornton, "Symbol manipulation by threaded lists", CACM 3(4), 1960).

use crate::accel::Id;

/// What follows a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// The next child of the same node.
    Sibling(usize),
    /// It is the last child of this one.
    Parent(usize),
}

/// The links of all nodes.
#[derive(Debug)]
pub(super) struct Links<'m, I> {
    /// Where its children begin (of a leaf: 0 if it is not in the tree, 1 if it is, 2 if its bound
    /// does not pay), and what follows: twice its number, and 1 more for a parent.
    nodes: &'m mut [[I; 2]],
    capacity: usize,
    shapes: usize,
    interiors: usize,
    root: usize,
}

impl<'m, I: Id> Links<'m, I> {
    /// Numbers of nodes take one bit more to be stored.
    pub(super) const MOST_SHAPES: usize = I::MAX / 4 + 1;

    /// No node is in the tree.
    pub(super) fn new(nodes: &'m mut [[I; 2]], capacity: usize) -> Self {
        nodes.fill([I::new(0); 2]);
        Self { nodes, capacity, shapes: 0, interiors: 0, root: 0 }
    }

    /// Shapes in the tree.
    pub(super) fn shapes(&self) -> usize {
        self.shapes
    }

    /// Leaves there may be.
    pub(super) fn capacity(&self) -> usize {
        self.capacity
    }

    /// Nodes in use that are not leaves.
    pub(super) fn interiors(&self) -> usize {
        self.interiors
    }

    /// Numbers of all nodes that may be in use are below this one.
    pub(super) fn end(&self) -> usize {
        self.capacity + self.interiors
    }

    /// Where the tree begins, if it does.
    pub(super) fn root(&self) -> Option<usize> {
        (self.shapes > 0).then_some(self.root)
    }

    pub(super) fn set_root(&mut self, node: usize) {
        self.root = node;
    }

    /// Whether a node is the leaf of the shape with its number.
    pub(super) fn is_leaf(&self, node: usize) -> bool {
        node < self.capacity
    }

    /// Whether a shape is in the tree.
    pub(super) fn contains(&self, leaf: usize) -> bool {
        self.is_leaf(leaf) && self.first(leaf) != 0
    }

    /// Puts a leaf into use, with a bound or bare.
    pub(super) fn mark_leaf(&mut self, leaf: usize, bare: bool) {
        self.set_first(leaf, 1 + usize::from(bare));
    }

    /// Whether a node is a leaf whose bound is not worth a test.
    pub(super) fn is_bare(&self, node: usize) -> bool {
        self.is_leaf(node) && self.first(node) == 2
    }

    /// The next child of the same node.
    pub(super) fn sibling(&self, node: usize) -> Option<usize> {
        match self.next(node) {
            Next::Sibling(next) => Some(next),
            Next::Parent(_) => None,
        }
    }

    /// Counts a leaf that has found its place.
    pub(super) fn count_leaf(&mut self) {
        self.shapes += 1;
    }

    /// Puts a node into use that is no leaf. There is always one left: it gets two children at
    /// least.
    pub(super) fn add_interior(&mut self) -> usize {
        let node = self.end();
        self.interiors += 1;
        node
    }

    /// The first child.
    pub(super) fn first(&self, node: usize) -> usize {
        self.nodes.get(node).map_or(0, |[first, _]| first.get())
    }

    pub(super) fn set_first(&mut self, node: usize, child: usize) {
        if let Some([first, _]) = self.nodes.get_mut(node) {
            *first = I::new(child);
        }
    }

    /// What follows a node that is not the root.
    pub(super) fn next(&self, node: usize) -> Next {
        let next = self.nodes.get(node).map_or(0, |[_, next]| next.get());
        if next & 1 == 0 { Next::Sibling(next >> 1) } else { Next::Parent(next >> 1) }
    }

    pub(super) fn set_next(&mut self, node: usize, to: Next) {
        if let Some([_, next]) = self.nodes.get_mut(node) {
            *next = I::new(match to {
                Next::Sibling(node) => node << 1,
                Next::Parent(node) => node << 1 | 1,
            });
        }
    }

    /// The children of a node.
    pub(super) fn children(&self, node: usize) -> impl Iterator<Item = usize> {
        let first = (!self.is_leaf(node)).then(|| self.first(node));
        core::iter::successors(first, |child| self.sibling(*child)).take(self.end())
    }

    /// The leaves below a node, itself included.
    pub(super) fn leaves(&self, node: usize) -> impl Iterator<Item = usize> + Clone {
        let after = move |at: &usize| self.after(*at, node, false);
        let all = core::iter::successors(Some(node), after).take(self.end());
        all.filter(|at| self.is_leaf(*at))
    }

    /// The parent of a node; nothing for the root. Time in proportion to the number of siblings.
    pub(super) fn parent(&self, node: usize) -> Option<usize> {
        let mut node = node;
        for _ in 0..self.end() {
            if node == self.root {
                return None;
            }
            match self.next(node) {
                Next::Sibling(next) => node = next,
                Next::Parent(parent) => return Some(parent),
            }
        }
        None
    }

    /// Makes a node the first child of another.
    pub(super) fn prepend(&mut self, parent: usize, child: usize) {
        let first = self.first(parent);
        self.set_next(child, Next::Sibling(first));
        self.set_first(parent, child);
    }

    /// Puts `node` into the place of `old` among its siblings.
    pub(super) fn replace(&mut self, old: usize, node: usize) {
        if old == self.root {
            self.root = node;
            return;
        }
        let follows = self.next(old);
        self.set_next(node, follows);
        let Some(parent) = self.parent(old) else { return };
        let before = self.children(parent).find(|c| self.next(*c) == Next::Sibling(old));
        match before {
            Some(before) => self.set_next(before, Next::Sibling(node)),
            None => self.set_first(parent, node),
        }
    }

    /// The node after this one where children come after their parent, `from` and what is below it
    /// in turn; `skip`: without those below this one.
    pub(super) fn after(&self, node: usize, from: usize, skip: bool) -> Option<usize> {
        if !skip && !self.is_leaf(node) {
            return Some(self.first(node));
        }
        let mut node = node;
        for _ in 0..self.end() {
            if node == from {
                return None;
            }
            match self.next(node) {
                Next::Sibling(next) => return Some(next),
                Next::Parent(parent) => node = parent,
            }
        }
        None
    }

    /// The same where children come before their parent: the first one.
    pub(super) fn first_up(&self) -> Option<usize> {
        self.root().map(|root| self.deepest(root))
    }

    /// And the one after another.
    pub(super) fn after_up(&self, node: usize) -> Option<usize> {
        if node == self.root {
            return None;
        }
        Some(match self.next(node) {
            Next::Sibling(next) => self.deepest(next),
            Next::Parent(parent) => parent,
        })
    }

    /// From a node to its first child, and so on.
    fn deepest(&self, node: usize) -> usize {
        let mut node = node;
        for _ in 0..self.end() {
            if self.is_leaf(node) {
                break;
            }
            node = self.first(node);
        }
        node
    }

    pub(super) fn levels(&self) -> usize {
        let Some(root) = self.root() else { return 0 };
        let (mut most, mut level, mut node) = (1, 1, root);
        for _ in 0..2 * self.end() {
            if self.is_leaf(node) {
                // Up to where there is another sibling.
                loop {
                    if node == root {
                        return most;
                    }
                    match self.next(node) {
                        Next::Sibling(next) => {
                            node = next;
                            break;
                        }
                        Next::Parent(parent) => {
                            node = parent;
                            level -= 1;
                        }
                    }
                }
            } else {
                node = self.first(node);
                level += 1;
                most = most.max(level);
            }
        }
        most
    }
}
