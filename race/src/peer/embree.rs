//! Embree 3.13.5 as Debian's libembree-dev ships it, loaded at run time (EMBREE3_LIB names another
//! file), one build thread. Bytes are those its memory monitor reports while committing the scene.
//! Embree picks its instruction set by itself at run time, whatever this program is compiled for.

use super::{ANY, Built, MISS, Peer, fastest};
use crate::mesh::Mesh;
use crate::rays::Ray;
use cpu_time::ProcessTime;
use std::ffi::{c_char, c_void};
use std::sync::atomic::{AtomicIsize, Ordering::Relaxed};

type P = *mut c_void;

const NO_FLAGS: u32 = 0;
const COMPACT: u32 = 2;
const ROBUST: u32 = 4;
const GEOMETRY_TRIANGLE: u32 = 0;
const BUFFER_INDEX: u32 = 0;
const BUFFER_VERTEX: u32 = 1;
const FORMAT_UINT3: u32 = 0x5003;
const FORMAT_FLOAT3: u32 = 0x9003;

#[repr(C, align(16))]
struct RtcRay {
    org: [f32; 3],
    tnear: f32,
    dir: [f32; 3],
    time: f32,
    tfar: f32,
    mask: u32,
    id: u32,
    flags: u32,
}

#[repr(C, align(16))]
struct RtcRayHit {
    ray: RtcRay,
    ng: [f32; 3],
    u: f32,
    v: f32,
    prim_id: u32,
    geom_id: u32,
    inst_id: [u32; 1],
}

#[repr(C)]
struct Context {
    flags: u32,
    filter: *const c_void,
    inst_id: [u32; 1],
    // Room for builds of the library with more instance levels.
    spare: [u32; 16],
}

static BYTES: AtomicIsize = AtomicIsize::new(0);
static PEAK: AtomicIsize = AtomicIsize::new(0);

extern "C" fn monitor(_: P, bytes: isize, _: bool) -> bool {
    let now = BYTES.fetch_add(bytes, Relaxed) + bytes;
    PEAK.fetch_max(now, Relaxed);
    true
}

struct Lib {
    _lib: libloading::Library,
    new_scene: extern "C" fn(P) -> P,
    scene_flags: extern "C" fn(P, u32),
    new_geometry: extern "C" fn(P, u32) -> P,
    new_buffer: extern "C" fn(P, u32, u32, u32, usize, usize) -> P,
    commit_geometry: extern "C" fn(P),
    attach: extern "C" fn(P, P) -> u32,
    release_geometry: extern "C" fn(P),
    commit_scene: extern "C" fn(P),
    release_scene: extern "C" fn(P),
    release_device: extern "C" fn(P),
    intersect1: extern "C" fn(P, *mut Context, *mut RtcRayHit),
    occluded1: extern "C" fn(P, *mut Context, *mut RtcRay),
    device: P,
}

impl Lib {
    fn open() -> Result<Lib, String> {
        let names = match std::env::var("EMBREE3_LIB") {
            Ok(n) => vec![n],
            Err(_) => vec!["libembree3.so.3".into(), "libembree3.so".into()],
        };
        let mut why = String::new();
        for n in &names {
            // SAFETY: a shared library of the declared interface; its initialisers are its own affair.
            match unsafe { libloading::Library::new(n) } {
                Ok(l) => return Self::with(l),
                Err(e) => why = e.to_string(),
            }
        }
        Err(why)
    }

    fn with(l: libloading::Library) -> Result<Lib, String> {
        // SAFETY: signatures as in rtcore_*.h of Embree 3; the library outlives the pointers.
        unsafe {
            macro_rules! f {
                ($n:literal, $t:ty) => {
                    *l.get::<$t>($n).map_err(|e| e.to_string())?
                };
            }
            let device =
                f!(b"rtcNewDevice", extern "C" fn(*const c_char) -> P)(c"threads=1".as_ptr());
            if device.is_null() {
                return Err("no device".into());
            }
            type Monitor = extern "C" fn(P, isize, bool) -> bool;
            f!(b"rtcSetDeviceMemoryMonitorFunction", extern "C" fn(P, Monitor, P))(
                device,
                monitor,
                std::ptr::null_mut(),
            );
            Ok(Lib {
                new_scene: f!(b"rtcNewScene", extern "C" fn(P) -> P),
                scene_flags: f!(b"rtcSetSceneFlags", extern "C" fn(P, u32)),
                new_geometry: f!(b"rtcNewGeometry", extern "C" fn(P, u32) -> P),
                new_buffer: f!(
                    b"rtcSetNewGeometryBuffer",
                    extern "C" fn(P, u32, u32, u32, usize, usize) -> P
                ),
                commit_geometry: f!(b"rtcCommitGeometry", extern "C" fn(P)),
                attach: f!(b"rtcAttachGeometry", extern "C" fn(P, P) -> u32),
                release_geometry: f!(b"rtcReleaseGeometry", extern "C" fn(P)),
                commit_scene: f!(b"rtcCommitScene", extern "C" fn(P)),
                release_scene: f!(b"rtcReleaseScene", extern "C" fn(P)),
                release_device: f!(b"rtcReleaseDevice", extern "C" fn(P)),
                intersect1: f!(b"rtcIntersect1", extern "C" fn(P, *mut Context, *mut RtcRayHit)),
                occluded1: f!(b"rtcOccluded1", extern "C" fn(P, *mut Context, *mut RtcRay)),
                device,
                _lib: l,
            })
        }
    }

    /// A scene with its geometry attached, not yet built.
    fn scene(&self, mesh: &Mesh, flags: u32) -> P {
        let scene = (self.new_scene)(self.device);
        (self.scene_flags)(scene, flags);
        let g = (self.new_geometry)(self.device, GEOMETRY_TRIANGLE);
        let v = (self.new_buffer)(g, BUFFER_VERTEX, 0, FORMAT_FLOAT3, 12, mesh.vertices.len())
            as *mut [f32; 3];
        let i =
            (self.new_buffer)(g, BUFFER_INDEX, 0, FORMAT_UINT3, 12, mesh.len()) as *mut [u32; 3];
        // SAFETY: Embree allocated these many elements of 12 bytes each.
        unsafe {
            std::ptr::copy_nonoverlapping(mesh.vertices.as_ptr(), v, mesh.vertices.len());
            std::ptr::copy_nonoverlapping(mesh.indices.as_ptr(), i, mesh.len());
        }
        (self.commit_geometry)(g);
        (self.attach)(scene, g);
        (self.release_geometry)(g);
        scene
    }
}

struct Embree {
    lib: Lib,
    scene: P,
}

impl Drop for Embree {
    fn drop(&mut self) {
        (self.lib.release_scene)(self.scene);
        (self.lib.release_device)(self.lib.device);
    }
}

fn context() -> Context {
    Context { flags: 0, filter: std::ptr::null(), inst_id: [!0], spare: [!0; 16] }
}

fn ray(r: &Ray) -> RtcRay {
    RtcRay { org: r.o, tnear: r.tmin, dir: r.d, time: 0.0, tfar: r.tmax, mask: !0, id: 0, flags: 0 }
}

impl Peer for Embree {
    fn closest(&mut self, r: &Ray) -> (f32, u32) {
        let mut h = RtcRayHit {
            ray: ray(r),
            ng: [0.0; 3],
            u: 0.0,
            v: 0.0,
            prim_id: !0,
            geom_id: !0,
            inst_id: [!0],
        };
        (self.lib.intersect1)(self.scene, &mut context(), &mut h);
        if h.geom_id == !0 { MISS } else { (h.ray.tfar, h.prim_id) }
    }
    fn any(&mut self, r: &Ray) -> (f32, u32) {
        let mut q = ray(r);
        (self.lib.occluded1)(self.scene, &mut context(), &mut q);
        if q.tfar < 0.0 { ANY } else { MISS }
    }
}

fn build(mesh: &Mesh, flags: u32) -> Result<Built, String> {
    let lib = Lib::open()?;
    let mut best = f64::INFINITY;
    let mut kept = 0;
    let mut peak = 0;
    let mut scene: P = std::ptr::null_mut();
    // `fastest` times whole closures; here only the commit counts.
    fastest(|| {
        if !scene.is_null() {
            (lib.release_scene)(scene);
        }
        scene = lib.scene(mesh, flags);
        let before = BYTES.load(Relaxed);
        PEAK.store(before, Relaxed);
        let start = ProcessTime::now();
        (lib.commit_scene)(scene);
        best = best.min(start.elapsed().as_secs_f64());
        kept = BYTES.load(Relaxed) - before;
        peak = PEAK.load(Relaxed) - before;
    });
    Ok(Built {
        batch: Box::new(Embree { lib, scene }),
        build: best,
        bytes_kept: kept.max(0) as usize,
        bytes_peak: peak.max(0) as usize,
        bytes_geometry: mesh.vertices.len() * 12 + mesh.len() * 12,
    })
}

pub fn build_default(mesh: &Mesh) -> Result<Built, String> {
    build(mesh, NO_FLAGS)
}

pub fn build_compact_robust(mesh: &Mesh) -> Result<Built, String> {
    build(mesh, COMPACT | ROBUST)
}
