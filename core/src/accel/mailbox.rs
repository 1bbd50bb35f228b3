//! Mailboxes: a shape that lies in several cells is tested once a ray.
//!
//! B. Arnaldi, T. Priol, K. Bouatouch, "A new space subdivision method for ray tracing CSG modelled
//! scenes", The Visual Computer 3(2) (1987); J. Amanatides, A. Woo, "A fast voxel traversal
//! algorithm for ray tracing", Eurographics 1987. The bounded variant is the hashed mailbox of
//! I. Wald's thesis (2004).

use super::Id;
use crate::memory::{Arena, Footprint, OutOfArena};

/// Remembers which shapes the present ray has been tested against.
pub trait Mailbox {
    /// A new ray begins: nothing has been tested.
    fn next_ray(&mut self);
    /// Whether a shape still has to be tested, which it then counts as. May say yes again for one
    /// that was tested, never no for one that was not.
    fn admit(&mut self, id: usize) -> bool;
    /// The same for a whole list of shapes, by a number other than 0: asked by structures whose cells
    /// may share lists.
    fn admit_list(&mut self, _list: usize) -> bool {
        true
    }
}

/// Remembers some of the lists that the present ray has been tested against, and has another mailbox
/// for their shapes. For octrees and grids whose cells share lists
/// ([`octree::Lists::shared`](super::octree::Lists::shared),
/// [`grid::Settings::shared`](super::grid::Settings::shared)); 36 bytes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Lists<M> {
    shapes: M,
    on: bool,
    recent: [u32; RECENT],
}

/// As many lists are remembered.
const RECENT: usize = 8;

impl<M: Mailbox> Lists<M> {
    /// Over a mailbox of shapes; unless it is on, it remembers nothing.
    pub fn new(shapes: M, on: bool) -> Self {
        Self { shapes, on, recent: [0; RECENT] }
    }
}

impl<M: Mailbox> Mailbox for Lists<M> {
    fn next_ray(&mut self) {
        if self.on {
            self.recent = [0; RECENT];
        }
        self.shapes.next_ray();
    }

    fn admit(&mut self, id: usize) -> bool {
        self.shapes.admit(id)
    }

    fn admit_list(&mut self, list: usize) -> bool {
        match self.recent.get_mut(list % RECENT) {
            Some(recent) if self.on => {
                let is_new = *recent != list as u32;
                *recent = list as u32;
                is_new
            }
            _ => true,
        }
    }
}

/// Remembers nothing, costs nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Off;

impl Mailbox for Off {
    fn next_ray(&mut self) {}
    fn admit(&mut self, _id: usize) -> bool {
        true
    }
}

/// One stamp a shape: 2 bytes each, or one ([`Stamps::short`]); no shape is tested twice.
///
/// Rays are numbered with as many bits; every 65,535 rays, or 255, all stamps are cleared.
#[derive(Debug)]
pub struct Stamps<'m, W = u16> {
    stamps: &'m mut [W],
    ray: W,
}

impl<'m> Stamps<'m> {
    /// Bytes for so many shapes.
    pub fn footprint(shapes: usize) -> Footprint {
        Footprint::of::<u16>(shapes)
    }

    /// Stamps for so many shapes.
    ///
    /// # Errors
    /// [`OutOfArena`].
    pub fn new(shapes: usize, arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        Self::cleared(shapes, arena)
    }
}

impl<'m> Stamps<'m, u8> {
    /// Stamps of a byte for so many shapes: for some thousands of them at most, as they are cleared
    /// often.
    ///
    /// # Errors
    /// [`OutOfArena`].
    pub fn short(shapes: usize, arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        Self::cleared(shapes, arena)
    }

    /// The bytes that [`Stamps::short`] takes.
    pub fn short_footprint(shapes: usize) -> Footprint {
        Footprint::of::<u8>(shapes)
    }
}

impl<'m, W: Id> Stamps<'m, W> {
    fn cleared(shapes: usize, arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        let stamps = arena.keep("mailbox", shapes)?;
        stamps.fill(W::new(0));
        Ok(Self { stamps, ray: W::new(1) })
    }
}

impl<W: Id> Mailbox for Stamps<'_, W> {
    fn next_ray(&mut self) {
        if self.ray.get() == W::MAX {
            self.stamps.fill(W::new(0));
            self.ray = W::new(0);
        }
        self.ray = W::new(self.ray.get() + 1);
    }

    fn admit(&mut self, id: usize) -> bool {
        match self.stamps.get_mut(id) {
            Some(stamp) if stamp.get() == self.ray.get() => false,
            Some(stamp) => {
                *stamp = self.ray;
                true
            }
            None => true,
        }
    }
}

/// A table of constant size: [`Cache::SLOTS`] slots of 8 bytes, whatever the scene. A shape whose
/// slot another one took since is tested again.
#[derive(Debug)]
pub struct Cache<'m> {
    /// Ray number, then shape.
    slots: &'m mut [[u32; 2]],
    ray: u32,
}

impl<'m> Cache<'m> {
    /// Number of slots.
    pub const SLOTS: usize = 64;

    /// Its bytes.
    pub fn footprint() -> Footprint {
        Footprint::of::<[u32; 2]>(Self::SLOTS)
    }

    /// An empty table.
    ///
    /// # Errors
    /// [`OutOfArena`].
    pub fn new(arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        let slots = arena.keep("mailbox", Self::SLOTS)?;
        slots.fill([0, 0]);
        Ok(Self { slots, ray: 1 })
    }
}

impl Mailbox for Cache<'_> {
    fn next_ray(&mut self) {
        self.ray = self.ray.wrapping_add(1);
        if self.ray == 0 {
            self.slots.fill([0, 0]);
            self.ray = 1;
        }
    }

    fn admit(&mut self, id: usize) -> bool {
        let entry = [self.ray, id as u32];
        match self.slots.get_mut(id % Self::SLOTS) {
            Some(slot) if *slot == entry => false,
            Some(slot) => {
                *slot = entry;
                true
            }
            None => true,
        }
    }
}

/// The kinds of mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// [`Off`].
    Off,
    /// [`Stamps`].
    Stamps,
    /// [`Cache`].
    Cache,
}

impl Kind {
    /// Bytes for so many shapes.
    pub fn footprint(self, shapes: usize) -> Footprint {
        match self {
            Self::Off => Footprint::default(),
            Self::Stamps => Stamps::footprint(shapes),
            Self::Cache => Cache::footprint(),
        }
    }
}

/// A mailbox of a kind that is chosen while the program runs.
#[derive(Debug)]
pub enum AnyMailbox<'m> {
    /// None.
    Off,
    /// One stamp a shape.
    Stamps(Stamps<'m>),
    /// Constant size.
    Cache(Cache<'m>),
}

impl<'m> AnyMailbox<'m> {
    /// A mailbox for so many shapes.
    ///
    /// # Errors
    /// [`OutOfArena`].
    pub fn new(kind: Kind, shapes: usize, arena: &mut Arena<'m>) -> Result<Self, OutOfArena> {
        Ok(match kind {
            Kind::Off => Self::Off,
            Kind::Stamps => Self::Stamps(Stamps::new(shapes, arena)?),
            Kind::Cache => Self::Cache(Cache::new(arena)?),
        })
    }
}

impl Mailbox for AnyMailbox<'_> {
    fn next_ray(&mut self) {
        match self {
            Self::Off => {}
            Self::Stamps(stamps) => stamps.next_ray(),
            Self::Cache(cache) => cache.next_ray(),
        }
    }

    fn admit(&mut self, id: usize) -> bool {
        match self {
            Self::Off => true,
            Self::Stamps(stamps) => stamps.admit(id),
            Self::Cache(cache) => cache.admit(id),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(align(8))]
    struct Block([u8; 1024]);

    #[test]
    fn stamps_survive_the_wrap_of_ray_numbers() {
        let mut block = Block([0xff; 1024]);
        let mut mailbox = Stamps::new(3, &mut Arena::new(&mut block.0)).unwrap();
        // Shape 1 is tested for the first ray only; shape 2 for every ray.
        mailbox.next_ray();
        assert!(mailbox.admit(1));
        assert!(!mailbox.admit(1));
        for ray in 0..200_000 {
            mailbox.next_ray();
            assert!(mailbox.admit(2), "{ray}");
            assert!(!mailbox.admit(2), "{ray}");
            // After 65,535 further rays the number of the first comes again.
            if ray == 65_534 {
                assert!(mailbox.admit(1));
            }
        }
    }

    #[test]
    fn short_stamps_survive_it_too() {
        let mut block = Block([0xff; 1024]);
        let mut arena = Arena::new(&mut block.0);
        let mut mailbox = Stamps::short(3, &mut arena).unwrap();
        assert_eq!(arena.used(), Stamps::short_footprint(3).kept);
        mailbox.next_ray();
        assert!(mailbox.admit(1));
        for ray in 0..1000 {
            mailbox.next_ray();
            assert!(mailbox.admit(2), "{ray}");
            assert!(!mailbox.admit(2), "{ray}");
            // After 255 further rays the number of the first comes again.
            if ray == 254 {
                assert!(mailbox.admit(1));
            }
        }
    }

    #[test]
    fn the_cache_forgets_but_never_invents() {
        let mut block = Block([0xff; 1024]);
        let mut arena = Arena::new(&mut block.0);
        let mut mailbox = Cache::new(&mut arena).unwrap();
        assert_eq!(arena.used(), Cache::footprint().kept);
        mailbox.next_ray();
        assert!(mailbox.admit(0));
        assert!(!mailbox.admit(0));
        assert!(mailbox.admit(64), "shares a slot with 0");
        assert!(mailbox.admit(0));
        mailbox.next_ray();
        assert!(mailbox.admit(0));
        mailbox.ray = u32::MAX;
        mailbox.next_ray();
        assert!(mailbox.admit(0));
    }
}
