//! Counters that cost nothing when they are not asked for.

/// What a ray is shot for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RayKind {
    /// From the eye.
    Primary,
    /// Towards a light.
    Shadow,
    /// Mirrored or refracted.
    Secondary,
}

/// Is told of every piece of work on the way of a ray.
///
/// A type parameter everywhere: with `()` every call is empty and no instruction is left of it.
pub trait Probe {
    /// A ray was tested against so many shapes.
    fn primitive_tests(&mut self, _count: usize) {}
    /// A mailbox knew that a shape had been tested for this ray.
    fn mailbox_skip(&mut self) {}
    /// A list was skipped as a whole, as this ray had been tested against it.
    fn list_skip(&mut self) {}
    /// A node or a cell was looked at.
    fn step(&mut self) {}
    /// A leaf or a cell was entered; whether it lists no shape.
    fn leaf(&mut self, _empty: bool) {}
    /// A ray was shot; whether it hit something (a shadow ray: whether it was blocked).
    fn ray(&mut self, _kind: RayKind, _hit: bool) {}
}

/// Counts nothing.
impl Probe for () {}

/// How many rays of a kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rays {
    /// Rays shot.
    pub shot: u64,
    /// Of these, how many hit something.
    pub hit: u64,
}

/// Counts everything; 96 bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Tests of a ray against a shape.
    pub primitive_tests: u64,
    /// Tests that a mailbox made unnecessary.
    pub mailbox_skips: u64,
    /// Lists skipped as a whole.
    pub list_skips: u64,
    /// Nodes or cells looked at.
    pub steps: u64,
    /// Leaves or cells entered.
    pub leaves: u64,
    /// Of these, how many list no shape.
    pub empty_leaves: u64,
    /// Rays from the eye.
    pub primary: Rays,
    /// Rays towards lights; hit means blocked.
    pub shadow: Rays,
    /// Mirrored and refracted rays.
    pub secondary: Rays,
}

impl Probe for Counters {
    fn primitive_tests(&mut self, count: usize) {
        self.primitive_tests += count as u64;
    }
    fn mailbox_skip(&mut self) {
        self.mailbox_skips += 1;
    }
    fn list_skip(&mut self) {
        self.list_skips += 1;
    }
    fn step(&mut self) {
        self.steps += 1;
    }
    fn leaf(&mut self, empty: bool) {
        self.leaves += 1;
        self.empty_leaves += u64::from(empty);
    }
    fn ray(&mut self, kind: RayKind, hit: bool) {
        let rays = match kind {
            RayKind::Primary => &mut self.primary,
            RayKind::Shadow => &mut self.shadow,
            RayKind::Secondary => &mut self.secondary,
        };
        *rays += Rays { shot: 1, hit: hit.into() };
    }
}

impl core::ops::AddAssign for Rays {
    fn add_assign(&mut self, other: Self) {
        self.shot += other.shot;
        self.hit += other.hit;
    }
}

impl core::ops::AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        self.primitive_tests += other.primitive_tests;
        self.mailbox_skips += other.mailbox_skips;
        self.list_skips += other.list_skips;
        self.steps += other.steps;
        self.leaves += other.leaves;
        self.empty_leaves += other.empty_leaves;
        self.primary += other.primary;
        self.shadow += other.shadow;
        self.secondary += other.secondary;
    }
}
