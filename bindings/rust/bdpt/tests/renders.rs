// SPDX-License-Identifier: Apache-2.0
//! Renders: the same bits whatever the threads, progress, tiles, statistics.

mod common;
use bdpt::*;
use common::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::Mutex;

struct Threads(u32);
impl Executor for Threads {
    fn worker_count(&self) -> u32 {
        self.0
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        let next = AtomicU32::new(0);
        std::thread::scope(|scope| {
            for _ in 0..self.0 {
                scope.spawn(|| loop {
                    let i = next.fetch_add(1, Ordering::SeqCst);
                    if i >= n {
                        break;
                    }
                    body(i);
                });
            }
        });
    }
}

#[test]
fn one_thread_and_an_executor_give_the_same_bits() {
    let executor = |threads| ContextOptions::default().executor(Threads(threads)).create().unwrap();
    for plan in ["one-to-one", "two-way", "pooled", "matrix"] {
        let picture = |context: Context| {
            let scene = scene(&context).unwrap();
            let sensor = camera().create(&context).unwrap();
            let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
            let options = RenderOptions::new().seed(9).plan(plan).block_size(16);
            let mut render = Render::new(&scene, &sensor, film, &options).unwrap();
            render.advance(Advance::passes(8)).unwrap();
            bits(&render.into_film())
        };
        let one = picture(threads(1));
        assert!(one.iter().any(|bits| *bits != 0));
        for other in [threads(2), executor(1), executor(2), executor(5)] {
            assert!(picture(other) == one, "{plan}");
        }
    }
}

#[test]
fn another_seed_gives_other_bits() {
    let scene = scene(&threads(1)).unwrap();
    let sensor = camera().create(scene.context()).unwrap();
    let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
    let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new().seed(6)).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    assert!(bits(render.film()) != reference(2));
}

#[test]
fn progress_rises_from_nothing_to_all() {
    let mut render = render(&threads(2)).unwrap();
    let mut told: Vec<Progress> = Vec::new();
    let report = render.advance(Advance::passes(5).progress(|now| told.push(now.progress))).unwrap();
    assert_eq!((report.reason, report.passes, report.next_pass), (StopReason::Passes, 5, 5));
    assert!(report.seconds > 0.0 && report.relative_error.is_none());
    assert!(render.film().info().unwrap().relative_error.unwrap() > 0.0);
    assert_eq!((told[0].fraction, told[0].passes), (0.0, 0));
    let last = told.last().unwrap();
    assert_eq!((last.fraction, last.passes, last.samples), (1.0, 5, 5 * 120));
    assert!(told.windows(2).all(|pair| pair[0].fraction <= pair[1].fraction && pair[0].seconds <= pair[1].seconds));
}

#[test]
fn a_break_stops_the_call_and_is_no_error() {
    let mut render = render(&threads(1)).unwrap();
    let report = render.advance(Advance::passes(9).progress(|_| ControlFlow::Break(()))).unwrap();
    assert_eq!((report.reason, report.passes), (StopReason::Callback, 0));
    let report = render.advance(Advance::passes(9).tiles(2, |_| ControlFlow::Break(()))).unwrap();
    assert_eq!((report.reason, report.passes), (StopReason::Callback, 2));
    let report = render.advance(Advance::passes(1).progress(|_| ControlFlow::Continue(()))).unwrap();
    assert_eq!((report.reason, report.passes), (StopReason::Passes, 1));
    assert!(bits(render.film()) == reference(3));
}

/// Writes down what it is told.
#[derive(Default)]
struct Told {
    begins: Vec<(u32, u32, u64)>,
    ends: Vec<bool>,
    tiles: Vec<Rect>,
    picture: Vec<u32>,
    stop: bool,
}
impl Sink for Told {
    fn begin(&mut self, width: u32, height: u32, passes: u64) -> ControlFlow<()> {
        self.begins.push((width, height, passes));
        self.picture = vec![u32::MAX; width as usize * height as usize * 3];
        self.tiles.clear();
        ControlFlow::Continue(())
    }
    fn tile(&mut self, tile: Tile<'_>) -> ControlFlow<()> {
        let rect = tile.rect();
        assert_eq!(tile.passes(), self.begins.last().unwrap().2);
        assert_eq!(tile.rows().len() as u32, rect.height());
        assert_eq!(tile.pixels().len() as u32, rect.width() * rect.height());
        let width = self.begins.last().unwrap().0 as usize;
        for (y, row) in (rect.y0 as usize..).zip(tile.rows()) {
            for (x, pixel) in (rect.x0 as usize..).zip(row) {
                for (c, value) in pixel.iter().enumerate() {
                    self.picture[(y * width + x) * 3 + c] = value.to_bits();
                }
            }
        }
        self.tiles.push(rect);
        if self.stop {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
    fn end(&mut self, complete: bool) {
        self.ends.push(complete);
    }
}

#[test]
fn tiles_make_the_picture() {
    let context = threads(2);
    let scene = scene(&context).unwrap();
    let sensor =
        Camera::perspective(100, 70).transform(Transform::translate([0.0, 1.0, 4.0])).create(&context).unwrap();
    let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
    let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new()).unwrap();
    let mut told = Told::default();
    render.advance(Advance::passes(5).sink(2, &mut told)).unwrap();
    assert_eq!(told.begins, [(100, 70, 2), (100, 70, 4), (100, 70, 5)]);
    assert_eq!(told.ends, [true; 3]);
    assert_eq!(told.tiles.len(), 4);
    assert_eq!(told.tiles.iter().map(|rect| rect.width() * rect.height()).sum::<u32>(), 7000);
    assert!(told.picture == bits(render.film()));
    let mut told = Told { stop: true, ..Default::default() };
    let report = render.advance(Advance::passes(5).sink(1, &mut told)).unwrap();
    assert_eq!((report.reason, report.passes), (StopReason::Callback, 1));
    assert_eq!((told.ends.as_slice(), told.tiles.len()), ([false].as_slice(), 1));
}

#[test]
fn time_and_noise_are_limits() {
    let mut render = render(&threads(1)).unwrap();
    assert_eq!(render.advance(Advance::for_seconds(0.01)).unwrap().reason, StopReason::Time);
    let report = render.advance(Advance::to_noise(1e3)).unwrap();
    assert_eq!(report.reason, StopReason::Noise);
}

#[test]
fn statistics_count_what_was_done() {
    let mut render = render(&threads(1)).unwrap();
    render.advance(Advance::passes(3)).unwrap();
    let stats = render.stats().unwrap();
    assert_eq!((stats.passes, stats.samples), (3, 360));
    assert!(stats.eye_rays > 0 && stats.light_rays > 0 && stats.shadow_rays >= stats.shadow_rays_blocked);
    let direct = render.technique_stats(1, 2).unwrap();
    assert!(direct.contributions > 0 && direct.energy > 0.0 && direct.energy <= 1.0);
}

#[test]
fn techniques_and_plans_are_chosen() {
    let context = threads(1);
    let scene = scene(&context).unwrap();
    let sensor = camera().create(&context).unwrap();
    let mut means = Vec::new();
    for plan in plans() {
        if plan.name == "mmlt" || plan.name == "combinatorial" {
            continue;
        }
        let film = Film::new(&sensor, &FilmOptions::default().filter(Filter::Box)).unwrap();
        let options = RenderOptions::new().plan(plan.name).max_edges(3);
        let mut render = Render::new(&scene, &sensor, film, &options).unwrap();
        render.advance(Advance::passes(128)).unwrap();
        let image = render.film().read(Layer::Color).unwrap();
        means.push((plan.name, image.as_floats().iter().sum::<f32>()));
    }
    let film = Film::new(&sensor, &FilmOptions::default().filter(Filter::Box)).unwrap();
    let options = RenderOptions::new().max_edges(3).techniques(Techniques::PATH_TRACING);
    let mut render = Render::new(&scene, &sensor, film, &options).unwrap();
    render.advance(Advance::passes(128)).unwrap();
    assert_eq!(render.stats().unwrap().light_rays, 0);
    means.push(("path tracing", render.film().read(Layer::Color).unwrap().as_floats().iter().sum::<f32>()));
    assert!(means.len() >= 5);
    for (name, mean) in &means {
        assert!((mean / means[0].1 - 1.0).abs() < 0.03, "{name}: {means:?}");
    }
}

#[test]
fn the_log_tells_and_the_memory_limit_holds() {
    static LINES: Mutex<Vec<(LogLevel, String)>> = Mutex::new(Vec::new());
    let log = |level: LogLevel, text: &str| LINES.lock().unwrap().push((level, text.to_string()));
    let context = ContextOptions::default().threads(1).log(log).memory_limit(100_000).create().unwrap();
    let mut builder = Builder::new(&context).unwrap();
    let shape = builder.add_mesh(square()).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    builder.add_instance(&Instance::new(shape, clay)).unwrap();
    builder.build().unwrap();
    let lines = LINES.lock().unwrap();
    assert!(lines.iter().any(|(_, text)| text.contains("light")), "{lines:?}");
    let large = Camera::perspective(1000, 1000).create(&context).unwrap();
    let error = Film::new(&large, &FilmOptions::default()).unwrap_err();
    assert_eq!(error.code(), ErrorCode::MemoryLimit);
    assert!(context.info().unwrap().memory_peak > 0);
}

#[test]
fn host_functions_measure_what_the_library_does() {
    let context = threads(2);
    let picture = |floor: &dyn Fn(&mut Builder) -> Result<MaterialId>| {
        let mut render = render_of(&scene_with(&context, floor).unwrap()).unwrap();
        render.advance(Advance::passes(400)).unwrap();
        assert_eq!(render.film().info().unwrap().rejected, 0);
        render.film().read(Layer::Color).unwrap()
    };
    let sum = |image: &Image| image.as_floats().iter().map(|value| f64::from(*value)).sum::<f64>();
    let own = picture(&|builder| builder.add_material(Material::diffuse([0.7; 3])));
    let texture = picture(&|builder| {
        let grey = builder.add_host_texture(Grey(0.7, None))?;
        builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(grey))
    });
    assert!(own == texture, "a texture of one colour is that colour");
    let material = picture(&|builder| builder.add_material(Material::host(Chalk(None), [0.7; 3])));
    assert!((sum(&material) / sum(&own) - 1.0).abs() < 0.02, "{} {}", sum(&material), sum(&own));
}

#[test]
fn what_breaks_its_promise_is_counted() {
    let context = threads(1);
    let scene = scene_with(&context, |builder| {
        let wild = builder.add_host_texture(Grey(f32::NAN, None))?;
        builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(wild))
    });
    let mut render = render_of(&scene.unwrap()).unwrap();
    render.advance(Advance::passes(4)).unwrap();
    assert!(render.film().info().unwrap().rejected > 0);
    let layer = render.film().read(Layer::Rejected).unwrap();
    assert!(layer.as_floats().iter().any(|value| *value > 0.0));
}
