//! How many nodes a tree has at most, and how many bytes.

use super::{Builder, Insertion};
use crate::accel::Id;
use crate::bound::Stored;
use crate::memory::Footprint;
use crate::num::Real;

/// Leaves, and one node fewer above them; a list has only one.
pub(super) fn most_nodes(shapes: usize, builder: Builder) -> usize {
    let above = shapes.saturating_sub(1);
    shapes.saturating_add(if builder == Builder::List { above.min(1) } else { above })
}

/// Bytes of a tree over so many shapes. Some builders take scratch besides: a list of the shapes.
pub fn footprint<R: Real, B: Stored<R>, I: Id>(shapes: usize, builder: Builder) -> Footprint {
    let nodes = most_nodes(shapes, builder);
    let kept = Footprint::of::<B::Plain>(nodes).then(Footprint::of::<[I; 2]>(nodes));
    let scratch = match builder {
        Builder::GoldsmithSalmon(Insertion::Curve)
        | Builder::RTree(Insertion::Curve)
        | Builder::Sah => Footprint::of::<I>(shapes).peak,
        Builder::GoldsmithSalmon(_) | Builder::RTree(_) | Builder::List => 0,
    };
    kept.then(Footprint { kept: 0, peak: scratch })
}
