//! Where a ray crosses the surfaces of operands, on a stack of fixed size.
//!
//! S. D. Roth, "Ray casting for modeling solids", Computer Graphics and Image Processing 18 (1982):
//! along a ray every solid is a list of intervals, and operators merge lists.

use super::trees::Operator;
use crate::num::Real;
use heapless::Vec;

/// A place where a ray enters or leaves; 8 bytes in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<R> {
    /// Parameter along the ray.
    pub t: R,
    /// The part whose surface is crossed.
    pub part: u16,
}

/// Lists of crossings, one a pending operand, the last on top. In each the ray enters, leaves,
/// enters and so on, at parameters that do not descend.
#[derive(Debug, Default)]
pub(super) struct Lists<R, const N: usize> {
    crossings: Vec<Crossing<R>, N>,
    /// Where each list begins.
    begins: Vec<usize, N>,
}

impl<R: Real, const N: usize> Lists<R, N> {
    /// Puts a list of one interval on top, or an empty one.
    pub(super) fn push(&mut self, part: u16, span: Option<(R, R)>) {
        // There is room: [`Csg::new`](super::Csg::new) counted two crossings a part.
        let _ = self.begins.push(self.crossings.len());
        if let Some((enter, leave)) = span {
            let _ = self.crossings.push(Crossing { t: enter, part });
            let _ = self.crossings.push(Crossing { t: leave, part });
        }
    }

    /// Forgets all lists.
    pub(super) fn clear(&mut self) {
        self.crossings.clear();
        self.begins.clear();
    }

    /// How many lists there are.
    pub(super) fn depth(&self) -> usize {
        self.begins.len()
    }

    /// The list on top.
    pub(super) fn top(&self) -> &[Crossing<R>] {
        let begin = self.begins.last().copied().unwrap_or_default();
        self.crossings.get(begin..).unwrap_or_default()
    }

    /// Empties the list on top.
    pub(super) fn clear_top(&mut self) {
        self.crossings.truncate(self.begins.last().copied().unwrap_or_default());
    }

    /// In what part of a window a second operand can change the list on top, if in any. A union is not
    /// changed within one of its intervals; what is joined by another operator counts only where there
    /// is something to be cut.
    pub(super) fn matters(&self, operator: Operator, (min, max): (R, R)) -> Option<(R, R)> {
        let top = self.top();
        if operator == Operator::Union {
            let around = |span: &[Crossing<R>; 2]| span[0].t < min && max < span[1].t;
            return (!top.as_chunks().0.iter().any(around)).then_some((min, max));
        }
        let (min, max) = (top.first()?.t.max(min), top.last()?.t.min(max));
        (min <= max).then_some((min, max))
    }

    /// Puts the two lists on top together.
    pub(super) fn join(&mut self, operator: Operator) {
        let Some(middle) = self.begins.pop() else { return };
        let Some(begin) = self.begins.last().copied() else { return };
        let (Some(first), Some(second)) =
            (self.crossings.get(begin..middle), self.crossings.get(middle..))
        else {
            return;
        };
        // The second begins beyond the first, or one of them is empty; usually so.
        let apart = match (first.last(), second.first()) {
            (Some(last), Some(next)) => last.t < next.t,
            _ => true,
        };
        if !apart {
            let end = self.merge(operator, begin, middle);
            self.crossings.truncate(end);
            return;
        }
        match operator {
            Operator::Union => {}
            Operator::Intersection => self.crossings.truncate(begin),
            Operator::Difference => self.crossings.truncate(middle),
        }
    }

    /// Merges the lists from `begin` to `middle` and from there to the end in their place; where the
    /// result ends. Of two crossings at the same `t` both are passed at once, and the first
    /// operand's is kept: surfaces that coincide leave nothing between them.
    fn merge(&mut self, operator: Operator, begin: usize, middle: usize) -> usize {
        let mut copy = Vec::<Crossing<R>, N>::new();
        // The first list is read from a copy; what is written is never beyond what was read of the
        // second.
        let _ = copy.extend_from_slice(self.crossings.get(begin..middle).unwrap_or_default());
        let (mut first, mut second) = (0, middle);
        let (mut out, mut inside) = (begin, false);
        // Every turn takes at least one.
        for _ in begin..self.crossings.len() {
            let crossing = match (copy.get(first).copied(), self.crossings.get(second).copied()) {
                (None, None) => break,
                (Some(a), Some(b)) if a.t == b.t => {
                    (first, second) = (first + 1, second + 1);
                    a
                }
                (Some(a), Some(b)) if a.t < b.t => {
                    first += 1;
                    a
                }
                (Some(a), None) => {
                    first += 1;
                    a
                }
                (_, Some(b)) => {
                    second += 1;
                    b
                }
            };
            let now = operator.holds(first % 2 == 1, (second - middle) % 2 == 1);
            if now != inside {
                inside = now;
                if let Some(place) = self.crossings.get_mut(out) {
                    *place = crossing;
                    out += 1;
                }
            }
        }
        out
    }
}

/// Where a ray is inside of parts, in the order in which an object names them: two parameters each,
/// the first beyond the second where it is not, or where that is not known.
#[derive(Debug, Default)]
pub(super) struct Spans<R, const N: usize>(Vec<R, N>);

impl<R: Real, const N: usize> Spans<R, N> {
    const UNKNOWN: [R; 2] = [R::ONE, R::ZERO];
    const NOWHERE: [R; 2] = [R::MAX, R::ZERO];

    /// What is known of a part.
    pub(super) fn get(&self, place: usize) -> Option<Option<(R, R)>> {
        match self.0.get(2 * place..2 * place + 2)? {
            [enter, leave] if enter <= leave => Some(Some((*enter, *leave))),
            span => (*span != Self::UNKNOWN).then_some(None),
        }
    }

    /// Remembers what a test told.
    pub(super) fn set(&mut self, place: usize, span: Option<(R, R)>) {
        while self.0.len() < 2 * place + 2 {
            // There is room: see `Lists::push`.
            if self.0.extend_from_slice(&Self::UNKNOWN).is_err() {
                return;
            }
        }
        if let Some(at) = self.0.get_mut(2 * place..2 * place + 2) {
            at.copy_from_slice(&span.map_or(Self::NOWHERE, |(enter, leave)| [enter, leave]));
        }
    }
}
