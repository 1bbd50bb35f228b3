//! A counting allocator: how many bytes a contestant keeps and how many it needs while building.
//! Counts requested bytes, without the allocator's own overhead. Single thread only, so plain
//! loads and stores are enough and cost nothing measurable.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

pub struct Counting;

fn add(n: usize) {
    let now = NOW.load(Relaxed).wrapping_add(n);
    NOW.store(now, Relaxed);
    if now > PEAK.load(Relaxed) {
        PEAK.store(now, Relaxed);
    }
}

fn remove(n: usize) {
    NOW.store(NOW.load(Relaxed).wrapping_sub(n), Relaxed);
}

// SAFETY: every call goes to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, l: Layout) -> *mut u8 {
        add(l.size());
        unsafe { System.alloc(l) }
    }
    unsafe fn alloc_zeroed(&self, l: Layout) -> *mut u8 {
        add(l.size());
        unsafe { System.alloc_zeroed(l) }
    }
    unsafe fn dealloc(&self, p: *mut u8, l: Layout) {
        remove(l.size());
        unsafe { System.dealloc(p, l) }
    }
    unsafe fn realloc(&self, p: *mut u8, l: Layout, n: usize) -> *mut u8 {
        add(n);
        remove(l.size());
        unsafe { System.realloc(p, l, n) }
    }
}

/// Marks a point; `kept` and `peak` count from there.
pub struct Mark(usize);

impl Mark {
    pub fn set() -> Self {
        let now = NOW.load(Relaxed);
        PEAK.store(now, Relaxed);
        Mark(now)
    }
    pub fn kept(&self) -> usize {
        NOW.load(Relaxed).saturating_sub(self.0)
    }
    pub fn peak(&self) -> usize {
        PEAK.load(Relaxed).saturating_sub(self.0)
    }
}
