//! How many nodes a hierarchy has, and how many bytes, known from the number of shapes alone.

use super::node::{Node, WIDTH};
use crate::accel::Id;
use crate::memory::Footprint;

/// Shapes in a leaf at most: where eight leaves end is told in a byte.
const MOST_SHAPES: usize = 31;

/// Shapes a node where memory does not matter: 1.4 a leaf. Fewer cost memory and gain no time.
const ENOUGH: usize = 10;

/// Bytes of a hierarchy over so many shapes with `nodes` nodes, or the nearest number of them that
/// is possible. Building takes no more.
pub fn footprint<I: Id>(shapes: usize, nodes: usize) -> Footprint {
    let nodes = possible_nodes(shapes, nodes);
    let links = Footprint::of::<[I; 2]>(nodes);
    Footprint::of::<Node>(nodes).then(links).then(Footprint::of::<I>(shapes))
}

/// How many nodes make the best of so many bytes: one for every 10 shapes, or as many as fit; the
/// least possible number where not even those do.
pub fn nodes_within<I: Id>(shapes: usize, bytes: usize) -> usize {
    let mut low = possible_nodes(shapes, 0);
    let mut high = possible_nodes(shapes, shapes.div_ceil(ENOUGH));
    while low < high {
        let middle = low + (high - low).div_ceil(2);
        if footprint::<I>(shapes, middle).peak <= bytes { low = middle } else { high = middle - 1 }
    }
    low
}

/// The possible number of nodes that is nearest to the one asked for. With the greatest, every leaf
/// is a single shape.
pub(super) fn possible_nodes(shapes: usize, nodes: usize) -> usize {
    match shapes {
        0 => 0,
        _ => nodes.min(most_below(shapes)).max(least_below(shapes)).max(1),
    }
}

/// How many nodes a child of so many shapes can use, itself included: none when it is a leaf.
pub(super) fn most_below(shapes: usize) -> usize {
    shapes.saturating_sub(1).div_ceil(WIDTH - 1)
}

/// How many nodes it takes for no leaf to be too large, when shapes are dealt out equally.
pub(super) fn least_below(mut shapes: usize) -> usize {
    let (mut nodes, mut level) = (0, 1);
    while shapes > MOST_SHAPES {
        nodes += level;
        level *= WIDTH;
        shapes = shapes.div_ceil(WIDTH);
    }
    nodes
}

/// Levels of nodes that it takes at most, when shapes are dealt out equally.
pub(super) fn levels_below(mut shapes: usize) -> usize {
    let mut levels = 0;
    while shapes > 1 {
        levels += 1;
        shapes = shapes.div_ceil(WIDTH);
    }
    levels
}
