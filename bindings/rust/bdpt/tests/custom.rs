// SPDX-License-Identifier: Apache-2.0

//! Measurements of one's own: right, dropped once, and with panics that go on where the call was made.

use bdpt::*;
use std::f32::consts::PI;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::Arc;

/// Counts drops.
#[derive(Clone, Default)]
struct Counter(Arc<AtomicUsize>);

impl Counter {
    fn drops(&self) -> usize {
        self.0.load(Ordering::SeqCst)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    Start,
    Density,
    Respond,
    Land,
    Drop,
    /// Numbers that are not finite, vectors that are not unit, measurements that there are none of.
    Nonsense,
    /// Leaves all outputs as they came.
    Idle,
    /// Light that lands counts for nothing.
    LandNowhere,
}

/// The light that falls on a square of side 2, whose front looks up: as power, and twice that.
struct Square {
    floor: InstanceId,
    fault: Fault,
    /// No fault before this is set.
    armed: Arc<AtomicBool>,
    drops: Counter,
    landings: Arc<AtomicUsize>,
}

impl Square {
    fn fail(&self, fault: Fault) {
        if self.fault == fault && self.armed.load(Ordering::SeqCst) {
            panic!("{fault:?}");
        }
    }
}

impl Drop for Square {
    fn drop(&mut self) {
        self.drops.0.fetch_add(1, Ordering::SeqCst);
        self.fail(Fault::Drop);
    }
}

impl Measurement for Square {
    fn functions(&self) -> Functions {
        Functions::default().density().respond().land()
    }
    fn start(&self, measurements: &[u64], numbers: &[[f32; 4]], starts: &mut [Start]) {
        self.fail(Fault::Start);
        assert!(measurements.len() == numbers.len() && numbers.len() == starts.len());
        for (start, u) in starts.iter_mut().zip(numbers).filter(|_| self.fault != Fault::Idle) {
            let (r, phi) = (u[2].sqrt(), 2.0 * PI * u[3]);
            start.position = [2.0 * u[0] - 1.0, 0.0, 2.0 * u[1] - 1.0];
            start.normal = [0.0, 1.0, 0.0];
            start.direction = [r * phi.cos(), (1.0 - u[2]).sqrt(), r * phi.sin()];
            start.weight = 4.0;
            start.density_position = 0.25;
            start.density_direction = 1.0 / PI;
            start.offset = 1e-5;
            if self.fault == Fault::Nonsense && u[0] < 0.5 {
                start.direction = [f32::NAN, 7.0, f32::INFINITY];
            }
        }
    }
    fn density(&self, places: &[Place], densities: &mut [f32]) {
        self.fail(Fault::Density);
        assert_eq!(places.len(), densities.len());
        match self.fault {
            Fault::Nonsense => densities.fill(-1.0),
            Fault::Idle => {}
            _ => densities.fill(1.0 / PI),
        }
    }
    fn respond(&self, places: &[Place], responses: &mut [f32]) {
        self.fail(Fault::Respond);
        assert_eq!(2 * places.len(), responses.len());
        assert!(responses.iter().all(|response| *response == 0.0));
        for response in responses.chunks_exact_mut(2).filter(|_| self.fault != Fault::Idle) {
            response.copy_from_slice(&[1.0, 2.0]);
        }
    }
    fn land(&self, landings: &[Landing], landed: &mut [Landed]) {
        self.fail(Fault::Land);
        for (landing, landed) in
            landings.iter().zip(landed).filter(|_| ![Fault::Idle, Fault::LandNowhere].contains(&self.fault))
        {
            if landing.instance() == self.floor && landing.normal[1] * landing.direction[1] > 0.0 {
                self.landings.fetch_add(1, Ordering::SeqCst);
                landed.count_for(if self.fault == Fault::Nonsense { 1 << 40 } else { 0 });
                landed.normal = [0.0, 1.0, 0.0];
                landed.weight = 1.0;
                landed.density_position = 0.25;
            }
        }
    }
}

struct Setting {
    context: Context,
    scene: Scene,
    floor: InstanceId,
    armed: Arc<AtomicBool>,
    drops: Counter,
    landings: Arc<AtomicUsize>,
}

impl Setting {
    /// The square as a floor, below a lamp.
    fn new() -> Self {
        let context = ContextOptions::default().threads(2).create().unwrap();
        let mut builder = Builder::new(&context).unwrap();
        let corners = vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
        let square = builder.add_mesh(Mesh::new(corners).indices(vec![[0_u16, 1, 2], [0, 2, 3]])).unwrap();
        let grey = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
        let lamp = builder.add_material(Material::diffuse([0.0; 3]).emission([1.0; 3])).unwrap();
        let floor = builder.add_instance(&Instance::new(square, grey)).unwrap();
        let above = Transform::from_rows([1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 2.0, 0.0, 0.0, -1.0, 0.0]);
        builder.add_instance(&Instance::new(square, lamp).transform(above)).unwrap();
        let scene = builder.build().unwrap();
        let (armed, landings) = (Arc::new(AtomicBool::new(true)), Arc::new(AtomicUsize::new(0)));
        Self { context, scene, floor, armed, drops: Counter::default(), landings }
    }
    fn square(&self, fault: Fault) -> Square {
        let (armed, landings) = (self.armed.clone(), self.landings.clone());
        Square { floor: self.floor, fault, armed, drops: self.drops.clone(), landings }
    }
    fn sensor(&self, fault: Fault) -> Sensor {
        Custom::new(1, self.square(fault)).planes(2).create(&self.context).unwrap()
    }
    fn render(&self, sensor: &Sensor) -> Render {
        let film = Film::new(sensor, &FilmOptions::default()).unwrap();
        Render::new(&self.scene, sensor, film, &RenderOptions::default()).unwrap()
    }
}

fn value(render: &Render, plane: u32) -> f32 {
    render.film().read(ReadOptions::new(Layer::Color).plane(plane)).unwrap().pixels()[0][0]
}

fn code<T>(result: Result<T>) -> ErrorCode {
    result.err().expect("an error").code()
}

#[test]
fn power_is_that_of_the_form_factor() {
    let setting = Setting::new();
    let mut render = setting.render(&setting.sensor(Fault::Nothing));
    render.advance(Advance::passes(4096)).unwrap();
    // Parallel squares of side a, their distance apart a as well: a form factor of 0.19982.
    let expected = 0.19982 * PI * 4.0;
    assert!((value(&render, 0) / expected - 1.0).abs() < 0.03, "{} {expected}", value(&render, 0));
    assert!((value(&render, 1) / value(&render, 0) - 2.0).abs() < 1e-4);
    assert!(setting.landings.load(Ordering::SeqCst) > 100);
    assert_eq!(render.film().info().unwrap().rejected, 0);
}

#[test]
fn only_start_is_enough() {
    /// Leaves out the rest.
    struct Start(Square);
    impl Measurement for Start {
        fn start(&self, measurements: &[u64], numbers: &[[f32; 4]], starts: &mut [bdpt::Start]) {
            self.0.start(measurements, numbers, starts);
        }
    }
    let setting = Setting::new();
    let sensor = Custom::new(1, Start(setting.square(Fault::Nothing))).create(&setting.context).unwrap();
    let mut render = setting.render(&sensor);
    render.advance(Advance::passes(4096)).unwrap();
    assert!((value(&render, 0) / (0.19982 * PI * 4.0) - 1.0).abs() < 0.1, "{}", value(&render, 0));
}

#[test]
fn a_panic_in_each_function_goes_on_where_the_call_was_made() {
    for fault in [Fault::Start, Fault::Density, Fault::Respond, Fault::Land] {
        let setting = Setting::new();
        let sensor = setting.sensor(fault);
        let mut render = setting.render(&sensor);
        for _ in 0..2 {
            let panic = catch_unwind(AssertUnwindSafe(|| render.advance(Advance::passes(256)))).err();
            let panic = panic.unwrap_or_else(|| panic!("no panic in {fault:?}"));
            assert_eq!(*panic.downcast::<String>().unwrap(), format!("{fault:?}"));
            assert_eq!(setting.drops.drops(), 0);
        }
        // The panic stopped the call, long before its end.
        assert!(render.film().info().unwrap().passes < 64);
        // The render goes on when the fault is gone, and nothing of the panic is left.
        setting.armed.store(false, Ordering::SeqCst);
        let report = render.advance(Advance::passes(4)).unwrap();
        assert_eq!(report.passes, 4);
        drop((render, sensor));
        assert_eq!(setting.drops.drops(), 1, "{fault:?}");
    }
}

#[test]
fn a_measurement_is_dropped_once_with_the_last_that_needs_it() {
    let setting = Setting::new();
    let sensor = setting.sensor(Fault::Nothing);
    let clone = sensor.clone();
    let render = setting.render(&sensor);
    drop(sensor);
    drop(clone);
    assert_eq!(setting.drops.drops(), 0);
    let film = render.into_film();
    assert_eq!(setting.drops.drops(), 1);
    drop(film);
    assert_eq!(setting.drops.drops(), 1);
}

#[test]
fn a_measurement_is_dropped_once_when_it_is_refused() {
    let setting = Setting::new();
    let create = |custom: Custom<Square>| code(custom.create(&setting.context));
    assert_eq!(create(Custom::new(0, setting.square(Fault::Nothing))), ErrorCode::InvalidArgument);
    assert_eq!(setting.drops.drops(), 1);
    assert_eq!(create(Custom::new(1 << 32, setting.square(Fault::Nothing))), ErrorCode::InvalidArgument);
    assert_eq!(create(Custom::new(1, setting.square(Fault::Nothing)).planes(1025)), ErrorCode::InvalidArgument);
    assert_eq!(
        create(Custom::new(u64::MAX, setting.square(Fault::Nothing)).planes(u32::MAX)),
        ErrorCode::InvalidArgument
    );
    assert_eq!(setting.drops.drops(), 4);
}

#[test]
fn landing_needs_density() {
    struct Lands;
    impl Measurement for Lands {
        fn functions(&self) -> Functions {
            Functions::default().land()
        }
        fn start(&self, _: &[u64], _: &[[f32; 4]], _: &mut [Start]) {}
    }
    let error = Custom::new(1, Lands).create(&Context::new().unwrap()).err().unwrap();
    assert!(error.code() == ErrorCode::InvalidArgument && error.text().contains("density"), "{error}");
}

#[test]
fn a_panic_while_it_is_dropped_goes_on_there() {
    let setting = Setting::new();
    let sensor = setting.sensor(Fault::Drop);
    let clone = sensor.clone();
    drop(sensor);
    let panic = catch_unwind(AssertUnwindSafe(|| drop(clone))).expect_err("a panic");
    assert_eq!(*panic.downcast::<String>().unwrap(), "Drop");
    assert_eq!(setting.drops.drops(), 1);
    // And when it is refused.
    let refused = || Custom::new(0, setting.square(Fault::Drop)).create(&setting.context).err();
    assert!(catch_unwind(AssertUnwindSafe(refused)).is_err());
    assert_eq!(setting.drops.drops(), 2);
}

#[test]
fn nonsense_is_left_out_and_counted() {
    let setting = Setting::new();
    let mut render = setting.render(&setting.sensor(Fault::Nonsense));
    render.advance(Advance::passes(256)).unwrap();
    assert!(render.film().info().unwrap().rejected > 0);
    assert!(value(&render, 0).is_finite());
    assert!(setting.landings.load(Ordering::SeqCst) > 0);
}

#[test]
fn functions_that_do_nothing_measure_nothing() {
    let setting = Setting::new();
    let mut render = setting.render(&setting.sensor(Fault::Idle));
    render.advance(Advance::passes(16)).unwrap();
    assert_eq!(value(&render, 0), 0.0);
    assert_eq!(setting.landings.load(Ordering::SeqCst), 0);
}

#[test]
fn light_that_lands_counts_for_nothing_unless_it_is_told() {
    let setting = Setting::new();
    let measured = |fault| {
        let sensor = setting.sensor(fault);
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let options = RenderOptions::default().techniques(Techniques::only(2, 0));
        let mut render = Render::new(&setting.scene, &sensor, film, &options).unwrap();
        render.advance(Advance::passes(64)).unwrap();
        value(&render, 0)
    };
    assert!(measured(Fault::Nothing) > 0.0);
    assert_eq!(measured(Fault::LandNowhere), 0.0);
}

#[test]
fn films_of_other_hashes_do_not_merge() {
    let setting = Setting::new();
    let film = |hash, first_pass| {
        let custom = Custom::new(1, setting.square(Fault::Nothing)).planes(2).hash(hash);
        let sensor = custom.create(&setting.context).unwrap();
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let options = RenderOptions::default().first_pass(first_pass);
        let mut render = Render::new(&setting.scene, &sensor, film, &options).unwrap();
        render.advance(Advance::passes(2)).unwrap();
        render.into_film()
    };
    let mut first = film(7, 0);
    assert_eq!(code(first.merge(&film(8, 2))), ErrorCode::Mismatch);
    first.merge(&film(7, 2)).unwrap();
    assert_eq!(first.info().unwrap().passes, 4);
}
