// SPDX-License-Identifier: Apache-2.0
//! A panic in a callback stops the call, goes on in the caller with its payload, and leaves the objects usable.

mod common;
use bdpt::*;
use common::*;
use std::ops::ControlFlow;
use std::panic::panic_any;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::Arc;

/// A closure of this returns nothing.
fn boom(number: i32) {
    panic_any(number)
}

/// The render goes on where it was, and its picture is that of a render that was not disturbed.
fn finishes(render: &mut Render, passes: u64) {
    let done = render.film().info().unwrap().passes;
    render.advance(Advance::passes(passes - done)).unwrap();
    assert!(bits(render.film()) == reference(passes), "the picture is another");
}

#[test]
fn in_the_progress_of_a_build() {
    quiet();
    let mut builder = Builder::new(&threads(1)).unwrap();
    let floor = builder.add_material(Material::diffuse([0.7; 3])).unwrap();
    fill(&mut builder, floor).unwrap();
    assert_eq!(panic_of(|| builder.build_with(BuildOptions::new().progress(|_| boom(1)))), 1);
    finishes(&mut render_of(&builder.build().unwrap()).unwrap(), 2);
}

#[test]
fn in_a_displacement() {
    quiet();
    let mut builder = Builder::new(&threads(1)).unwrap();
    let surface = || Subdivision::new(CORNERS, vec![0, 1, 2, 3]).level(2);
    let mut places = 0;
    let panics = |place: &SurfacePlace| {
        places += 1;
        if places == 3 {
            panic_any(2)
        }
        place.position
    };
    assert_eq!(panic_of(|| builder.add_subdivision(surface().displace(panics))), 2);
    assert_eq!(places, 3, "it is asked no more after the panic");
    builder.add_subdivision(surface().displace(|place| place.position)).unwrap();
}

#[test]
fn in_progress() {
    quiet();
    for threads_ in [1, 2] {
        let mut render = render(&threads(threads_)).unwrap();
        render.advance(Advance::passes(1)).unwrap();
        assert_eq!(panic_of(|| render.advance(Advance::passes(3).progress(|_| boom(3)))), 3);
        finishes(&mut render, 4);
    }
}

/// Panics where it is told to.
#[derive(Default)]
struct Panics {
    begin: bool,
    tile: bool,
    end: bool,
}
impl Sink for Panics {
    fn begin(&mut self, _: u32, _: u32, _: u64) -> ControlFlow<()> {
        if self.begin {
            panic_any(10)
        }
        ControlFlow::Continue(())
    }
    fn tile(&mut self, _: Tile<'_>) -> ControlFlow<()> {
        if self.tile {
            panic_any(11)
        }
        ControlFlow::Continue(())
    }
    fn end(&mut self, complete: bool) {
        assert_eq!(complete, !self.begin && !self.tile);
        if self.end {
            panic_any(12)
        }
    }
}

#[test]
fn in_a_sink() {
    quiet();
    let mut render = render(&threads(1)).unwrap();
    let sinks = [
        (Panics { begin: true, ..Default::default() }, 10),
        (Panics { tile: true, ..Default::default() }, 11),
        (Panics { end: true, ..Default::default() }, 12),
        // Both end after it and the panic before it: the first is what goes on.
        (Panics { tile: true, end: true, ..Default::default() }, 11),
    ];
    for (sink, number) in sinks {
        assert_eq!(panic_of(|| render.advance(Advance::passes(1).sink(1, sink))), number);
    }
    assert_eq!(panic_of(|| render.advance(Advance::passes(1).tiles(1, |_| boom(13)))), 13);
    finishes(&mut render, 8);
}

/// Bodies on threads of its own, all at once; panics before, in the middle of, or after them.
struct Scoped {
    panic: AtomicU32,
}
impl Scoped {
    fn new() -> Arc<Self> {
        Arc::new(Self { panic: AtomicU32::new(0) })
    }
}
struct Shared(Arc<Scoped>);
impl Executor for Shared {
    fn worker_count(&self) -> u32 {
        2
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        let panic = self.0.panic.load(Ordering::SeqCst);
        if panic == 20 {
            panic_any(20)
        }
        let next = AtomicU32::new(0);
        std::thread::scope(|scope| {
            for _ in 0..2 {
                scope.spawn(|| {
                    while let Some(i) = Some(next.fetch_add(1, Ordering::SeqCst)).filter(|i| *i < n) {
                        body(i);
                    }
                });
            }
            if panic == 21 {
                panic_any(21)
            }
        });
        if panic == 22 {
            panic_any(22)
        }
    }
}

#[test]
fn in_an_executor() {
    quiet();
    let executor = Scoped::new();
    let context = ContextOptions::default().executor(Shared(executor.clone())).create().unwrap();
    let mut render = render(&context).unwrap();
    for number in [20, 21, 22] {
        executor.panic.store(number, Ordering::SeqCst);
        assert_eq!(panic_of(|| render.advance(Advance::passes(2))), number as i32);
        executor.panic.store(0, Ordering::SeqCst);
    }
    finishes(&mut render, 12);
}

/// A texture that panics while the flag is set.
struct Fuse(Arc<AtomicBool>);
impl HostTexture for Fuse {
    fn look_up(&self, _: &[TexturePlace], colors: &mut [[f32; 4]]) {
        if self.0.load(Ordering::SeqCst) {
            panic_any(30)
        }
        colors.fill([0.7, 0.7, 0.7, 1.0]);
    }
    fn hash(&self) -> u64 {
        30
    }
}

fn contexts() -> Vec<Context> {
    let host = ContextOptions::default().executor(Shared(Scoped::new()));
    vec![threads(1), threads(2), host.create().unwrap()]
}

#[test]
fn in_a_host_texture() {
    quiet();
    for context in contexts() {
        let fuse = Arc::new(AtomicBool::new(false));
        let scene = scene_with(&context, |builder| {
            let texture = builder.add_host_texture(Fuse(fuse.clone()))?;
            builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(texture))
        })
        .unwrap();
        let mut render = render_of(&scene).unwrap();
        render.advance(Advance::passes(1)).unwrap();
        fuse.store(true, Ordering::SeqCst);
        assert_eq!(panic_of(|| render.advance(Advance::passes(1))), 30);
        // Pilots ask it, too.
        let sensor = camera().create(&context).unwrap();
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let options = RenderOptions::new().plan("pooled").light_start(LightStart::Importance);
        assert_eq!(panic_of(|| Render::new(&scene, &sensor, film, &options)), 30);
        fuse.store(false, Ordering::SeqCst);
        // 1 x 0.7 in floats is 0.7.
        render.advance(Advance::passes(1)).unwrap();
        assert_eq!(render.film().info().unwrap().passes, 2);
        assert!(bits(render.film()) == reference(2));
    }
}

/// Panics on all threads but one.
struct NotHere(std::thread::ThreadId);
impl HostTexture for NotHere {
    fn look_up(&self, _: &[TexturePlace], colors: &mut [[f32; 4]]) {
        if std::thread::current().id() != self.0 {
            panic_any(31)
        }
        colors.fill([0.7, 0.7, 0.7, 1.0]);
    }
    fn hash(&self) -> u64 {
        31
    }
}

#[test]
fn on_a_thread_of_the_librarys() {
    quiet();
    let context = threads(2);
    if context.info().unwrap().threads < 2 {
        return; // a machine of one core
    }
    let scene = scene_with(&context, |builder| {
        let texture = builder.add_host_texture(NotHere(std::thread::current().id()))?;
        builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(texture))
    });
    let mut render = render_of(&scene.unwrap()).unwrap();
    assert_eq!(panic_of(|| render.advance(Advance::passes(1_000_000))), 31);
    // The payload went with it.
    render.film().info().unwrap();
    render.stats().unwrap();
}

/// Panics when two threads are in it, or after a while.
struct Together(Arc<AtomicBool>, AtomicU32);
impl HostTexture for Together {
    fn look_up(&self, _: &[TexturePlace], colors: &mut [[f32; 4]]) {
        if self.0.load(Ordering::SeqCst) {
            self.1.fetch_add(1, Ordering::SeqCst);
            for _ in 0..2000 {
                if self.1.load(Ordering::SeqCst) >= 2 {
                    break;
                }
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
            panic_any(32)
        }
        colors.fill([0.7, 0.7, 0.7, 1.0]);
    }
    fn hash(&self) -> u64 {
        32
    }
}

#[test]
fn on_two_threads_at_once() {
    quiet();
    let context = threads(2);
    let fuse = Arc::new(AtomicBool::new(true));
    let scene = scene_with(&context, |builder| {
        let texture = builder.add_host_texture(Together(fuse.clone(), AtomicU32::new(0)))?;
        builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(texture))
    });
    let mut render = render_of(&scene.unwrap()).unwrap();
    assert_eq!(panic_of(|| render.advance(Advance::passes(1))), 32);
    // The other one is not left for the next call.
    fuse.store(false, Ordering::SeqCst);
    finishes(&mut render, 2);
}

/// A material that panics while the flag is set: in one function or the other.
struct FuseMaterial(Arc<AtomicU32>, Chalk);
impl HostMaterial for FuseMaterial {
    fn evaluate(&self, place: &ScatteringPlace, next: [f32; 3]) -> Scattering {
        if self.0.load(Ordering::SeqCst) == 40 {
            panic_any(40)
        }
        self.1.evaluate(place, next)
    }
    fn sample(&self, place: &ScatteringPlace, u: [f32; 3]) -> Option<[f32; 3]> {
        if self.0.load(Ordering::SeqCst) == 41 {
            panic_any(41)
        }
        self.1.sample(place, u)
    }
    fn hash(&self) -> u64 {
        1
    }
}

#[test]
fn in_a_host_material() {
    quiet();
    for context in contexts() {
        let fuse = Arc::new(AtomicU32::new(0));
        let scene = scene_with(&context, |builder| {
            builder.add_material(Material::host(FuseMaterial(fuse.clone(), Chalk(None)), [0.7; 3]))
        })
        .unwrap();
        let mut render = render_of(&scene).unwrap();
        for number in [40, 41] {
            fuse.store(number, Ordering::SeqCst);
            let begin = std::time::Instant::now();
            assert_eq!(panic_of(|| render.advance(Advance::passes(10_000_000))), number as i32);
            assert!(begin.elapsed().as_secs() < 60, "the call is stopped");
            fuse.store(0, Ordering::SeqCst);
            render.advance(Advance::passes(1)).unwrap();
        }
    }
}

#[test]
fn in_a_log() {
    quiet();
    let fuse = Arc::new(AtomicBool::new(true));
    let flag = fuse.clone();
    let log = move |_: LogLevel, _: &str| {
        if flag.load(Ordering::SeqCst) {
            panic_any(50)
        }
    };
    let context = ContextOptions::default().threads(1).log(log).create().unwrap();
    let mut builder = Builder::new(&context).unwrap();
    // The log tells of triangles without area, and of scenes without light.
    let flat = || Mesh::new(CORNERS).indices(vec![[0_u32, 1, 2], [0, 0, 1]]);
    assert_eq!(panic_of(|| builder.add_mesh(flat())), 50);
    fuse.store(false, Ordering::SeqCst);
    let shape = builder.add_mesh(flat()).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    builder.add_instance(&Instance::new(shape, clay)).unwrap();
    let drops = Drops::new();
    let grey = builder.add_host_texture(Grey(0.5, Some(drops.one()))).unwrap();
    let clay = builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(grey)).unwrap();
    builder.add_instance(&Instance::new(shape, clay)).unwrap();
    fuse.store(true, Ordering::SeqCst);
    assert_eq!(panic_of(|| builder.build()), 50);
    fuse.store(false, Ordering::SeqCst);
    assert_eq!(builder.build().unwrap().info().unwrap().triangles, 2);
    // The scene that was built when the log panicked is gone, too.
    drop(builder);
    assert_eq!(drops.count(), 1);
}

/// Panics when it is dropped.
struct Bomb(i32);
impl Drop for Bomb {
    fn drop(&mut self) {
        panic_any(self.0)
    }
}
impl HostTexture for Bomb {
    fn look_up(&self, _: &[TexturePlace], _: &mut [[f32; 4]]) {}
    fn hash(&self) -> u64 {
        0
    }
    fn maximum(&self) -> f32 {
        if self.0 < 0 {
            f32::NAN
        } else {
            1.0
        }
    }
}
impl Executor for Bomb {
    fn worker_count(&self) -> u32 {
        1
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        (0..n).for_each(body);
    }
}
impl AsRef<[[f32; 3]]> for Bomb {
    fn as_ref(&self) -> &[[f32; 3]] {
        &CORNERS
    }
}

#[test]
fn in_the_drop_of_what_was_captured() {
    quiet();
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    // Removed, refused, and with the builder.
    let texture = builder.add_host_texture(Bomb(60)).unwrap();
    assert_eq!(panic_of(|| builder.remove_texture(texture)), 60);
    assert_eq!(panic_of(|| builder.add_host_texture(Bomb(-1))), -1);
    builder.add_host_texture(Bomb(61)).unwrap();
    assert_eq!(panic_of(move || drop(builder)), 61);
    // Of a mesh.
    let mut builder = Builder::new(&context).unwrap();
    let bomb = |number| Mesh::new(Data::from_owner(Bomb(number)));
    assert_eq!(panic_of(|| builder.add_mesh(bomb(62).indices(vec![[0_u32, 1, 9]]))), 62);
    let shape = builder.add_mesh(bomb(63).indices(TRIANGLES.to_vec())).unwrap();
    assert_eq!(panic_of(|| builder.remove_shape(shape)), 63);
    // Of several, the first.
    builder.add_host_texture(Bomb(64)).unwrap();
    builder.add_host_texture(Bomb(64)).unwrap();
    assert_eq!(panic_of(move || drop(builder)), 64);
    // Of an executor and a log.
    let context = ContextOptions::default().executor(Bomb(65)).create().unwrap();
    assert_eq!(panic_of(move || drop(context)), 65);
    let bomb = Bomb(66);
    let log = move |_: LogLevel, _: &str| assert!(std::ptr::eq(&bomb, &bomb));
    assert_eq!(panic_of(|| ContextOptions::default().log(log).threads(1 << 30).create()), 66);
}

/// Panics, and catches that, while it is dropped.
struct Catches;
impl Drop for Catches {
    fn drop(&mut self) {
        assert_eq!(panic_of(|| panic_any(1)), 1);
    }
}

#[test]
#[ignore = "what the next test asks the compiler"]
fn a_panic_may_be_caught_during_another() {
    quiet();
    let both = || {
        let _catches = Catches;
        panic_any(2)
    };
    assert_eq!(panic_of(both), 2);
}

#[test]
fn in_the_drop_of_what_was_captured_during_another_panic() {
    // Old compilers end the process when a second panic begins, wherever it would be caught.
    let ask = ["--ignored", "--exact", "a_panic_may_be_caught_during_another"];
    let asked = std::process::Command::new(std::env::current_exe().unwrap()).args(ask).output().unwrap();
    if !asked.status.success() {
        return;
    }
    quiet();
    let context = ContextOptions::default().executor(Bomb(67)).create().unwrap();
    let both = move || {
        let _context = context;
        panic_any(68)
    };
    assert_eq!(panic_of(both), 68);
}

#[test]
fn a_payload_may_panic_when_it_is_dropped() {
    quiet();
    struct End;
    impl Sink for End {
        fn tile(&mut self, _: Tile<'_>) -> ControlFlow<()> {
            panic_any(70)
        }
        fn end(&mut self, _: bool) {
            // Nobody will catch this one: it is dropped.
            panic_any(Bomb(71))
        }
    }
    let mut render = render(&threads(1)).unwrap();
    assert_eq!(panic_of(|| render.advance(Advance::passes(1).sink(1, End))), 70);
    finishes(&mut render, 2);
}

#[test]
fn inside_of_a_call_inside_of_a_callback() {
    quiet();
    let mut outer = render(&threads(1)).unwrap();
    let mut inner = render(&threads(1)).unwrap();
    let mut caught = 0;
    let report = outer.advance(Advance::passes(2).progress(|_| {
        caught = panic_of(|| inner.advance(Advance::passes(1).progress(|_| boom(80))));
    }));
    assert_eq!((report.unwrap().passes, caught), (2, 80));
    let through = Advance::passes(1).progress(|_| {
        let _ = inner.advance(Advance::passes(1).progress(|_| boom(81)));
    });
    assert_eq!(panic_of(|| outer.advance(through)), 81);
    finishes(&mut outer, 3);
    finishes(&mut inner, 3);
}
