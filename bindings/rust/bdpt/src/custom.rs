// SPDX-License-Identifier: Apache-2.0
//! Measurements of your own, as functions.

use crate::context::Context;
use crate::error::Result;
use crate::host::{give_back, host, slice, slice_mut, Host};
use crate::id::InstanceId;
use crate::panics::make;
use crate::sensor::Sensor;
use bdpt_sys as sys;
use std::os::raw::c_void;

/// A family of measurements: measurement j, plane c, is the integral of W(x) R(x, w) L(x, w) over places x, in space or
/// on a surface, and directions w, by the projected solid angle with the normal at x, or the solid angle where there is
/// none; L is the light that arrives at x from w.
///
/// The functions are called from all threads that render, at the same time, with many at once. They must be pure: what
/// they give depends on nothing but their arguments, else techniques disagree. A function that gives what cannot be (not
/// finite, no unit vector) has it counted as rejected and left out. A panic stops the call that renders and goes on from
/// there.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Custom, Measurement, Start};
/// /// The light that falls on a square of side 2 from above, as power.
/// struct Square;
/// impl Measurement for Square {
///     fn start(&self, _: &[u64], numbers: &[[f32; 4]], starts: &mut [Start]) {
///         for (start, u) in starts.iter_mut().zip(numbers) {
///             let (r, phi) = (u[2].sqrt(), u[3] * std::f32::consts::TAU);
///             start.position = [2.0 * u[0] - 1.0, 0.0, 2.0 * u[1] - 1.0];
///             start.normal = [0.0, 1.0, 0.0];
///             start.direction = [r * phi.cos(), (1.0 - u[2]).sqrt(), r * phi.sin()];
///             start.weight = 4.0; // W = 1, over the density of positions
///             start.density_position = 0.25;
///             start.density_direction = std::f32::consts::FRAC_1_PI;
///         }
///     }
/// }
/// let context = bdpt::Context::new()?;
/// let sensor = Custom::new(1, Square).create(&context)?;
/// # let _ = sensor;
/// # Ok(()) }
/// ```
///
/// As all threads call it, what only one may use cannot be part of it:
///
/// ```compile_fail,E0277
/// # use bdpt::{Measurement, Start};
/// struct Counting(std::cell::Cell<u64>);
/// impl Measurement for Counting {
///     fn start(&self, measurements: &[u64], _: &[[f32; 4]], _: &mut [Start]) {
///         self.0.set(self.0.get() + measurements.len() as u64);
///     }
/// }
/// ```
pub trait Measurement: Send + Sync + 'static {
    /// Which of the functions below there are, beside [`start`](Self::start). What is left out leaves out the
    /// techniques that need it; the weights know.
    fn functions(&self) -> Functions {
        Functions::default()
    }
    /// Samples a place and a direction of each measurement, by four uniform numbers in [0, 1). All of a start is zero at
    /// first.
    fn start(&self, measurements: &[u64], numbers: &[[f32; 4]], starts: &mut [Start]);
    /// With what density `start` gives each direction at each place: per projected solid angle, or solid angle without
    /// normal. Without it techniques with t <= 1 are left out.
    fn density(&self, places: &[Place], densities: &mut [f32]) {
        let _ = (places, densities);
    }
    /// R of each place and direction, plane after plane of the first place, then of the next. Without it R is 1.
    fn respond(&self, places: &[Place], responses: &mut [f32]) {
        let _ = (places, responses);
    }
    /// What light that lands on a surface of the scene counts for; nothing at first. Without it light subpaths do not
    /// hit what is measured (t = 0).
    fn land(&self, landings: &[Landing], landed: &mut [Landed]) {
        let _ = (landings, landed);
    }
}

/// Which functions a [`Measurement`] has; none but `start` by default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Functions {
    density: bool,
    respond: bool,
    land: bool,
}

impl Functions {
    /// It has [`Measurement::density`].
    pub fn density(mut self) -> Self {
        self.density = true;
        self
    }
    /// It has [`Measurement::respond`].
    pub fn respond(mut self) -> Self {
        self.respond = true;
        self
    }
    /// It has [`Measurement::land`].
    pub fn land(mut self) -> Self {
        self.land = true;
        self
    }
}

/// Where a measurement begins.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Start {
    /// In the world.
    pub position: [f32; 3],
    /// A unit vector; zero for a point in space.
    pub normal: [f32; 3],
    /// A unit vector, on the normal's side: where light comes from.
    pub direction: [f32; 3],
    /// W(position) / density_position; of any sign.
    pub weight: f32,
    /// Per area; 1 for a fixed point.
    pub density_position: f32,
    /// Per projected solid angle, or solid angle without normal: what `density` tells of it.
    pub density_direction: f32,
    /// Rays start so far off, along the normal; on a surface, more than rounding.
    pub offset: f32,
    reserved: u32,
}

/// A point of a measurement and a direction there.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Which measurement.
    pub measurement: u64,
    /// In the world.
    pub position: [f32; 3],
    /// As `start` gave it.
    pub normal: [f32; 3],
    /// A unit vector, on the normal's side: where light comes from.
    pub direction: [f32; 3],
    reserved: u32,
}

/// Light that lands on a surface of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Landing {
    instance: sys::bdpt_instance_id,
    /// Triangle of the mesh, without those that have no area; segment of curves; 0 for a sphere.
    pub triangle: u32,
    /// Barycentric coordinate of its second vertex.
    pub u: f32,
    /// Barycentric coordinate of its third vertex.
    pub v: f32,
    /// In the world.
    pub position: [f32; 3],
    /// Geometric, of the front.
    pub normal: [f32; 3],
    /// A unit vector: where the light comes from.
    pub direction: [f32; 3],
}

impl Landing {
    /// Whose surface it is, by the builder that built the scene.
    pub fn instance(&self) -> InstanceId {
        InstanceId(self.instance)
    }
}

/// What light that has landed counts for.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Landed {
    measurement: u64,
    /// That `start` would have given there.
    pub normal: [f32; 3],
    /// W(position).
    pub weight: f32,
    /// That `start` would have had for it.
    pub density_position: f32,
    reserved: u32,
}

impl Landed {
    /// It counts for this measurement.
    pub fn count_for(&mut self, measurement: u64) {
        self.measurement = measurement;
    }
}

// What the library reads and writes as its own.
const _: () = {
    use std::mem::{align_of, size_of};
    assert!(size_of::<Start>() == size_of::<sys::bdpt_measurement_start>());
    assert!(size_of::<Place>() == size_of::<sys::bdpt_measurement_place>());
    assert!(size_of::<Landing>() == size_of::<sys::bdpt_measurement_landing>());
    assert!(size_of::<Landed>() == size_of::<sys::bdpt_measurement_landed>());
    assert!(align_of::<Start>() == align_of::<sys::bdpt_measurement_start>());
    assert!(align_of::<Place>() == align_of::<sys::bdpt_measurement_place>());
    assert!(align_of::<Landing>() == align_of::<sys::bdpt_measurement_landing>());
    assert!(align_of::<Landed>() == align_of::<sys::bdpt_measurement_landed>());
};

/// A sensor of your own functions, to be created. A packed read of its film begins with the measurements, one after
/// another.
#[derive(Debug)]
pub struct Custom<M> {
    measurement: M,
    measurements: u64,
    planes: u32,
    hash: u64,
}

/// The functions as the library holds them.
struct Held<M> {
    measurement: M,
    planes: usize,
}

impl<M: Measurement> Custom<M> {
    /// So many measurements, at least 1 and below 2^32.
    pub fn new(measurements: u64, measurement: M) -> Self {
        Self { measurement, measurements, planes: 1, hash: 0 }
    }
    /// Planes of each, 1 to 1024; 1 by default.
    pub fn planes(mut self, planes: u32) -> Self {
        self.planes = planes;
        self
    }
    /// Of all that your functions decide: films of other hashes do not merge.
    pub fn hash(mut self, hash: u64) -> Self {
        self.hash = hash;
        self
    }
    /// The sensor. The measurement is dropped when the last clone of it, and the last render with it, is gone, and when
    /// this fails.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for what is out of range.
    pub fn create(self, context: &Context) -> Result<Sensor> {
        let functions = self.measurement.functions();
        let panics = context.panics().of_child();
        let planes = self.planes.max(1) as usize; // 0 stands for 1
        let lent = Host::lend(Held { measurement: self.measurement, planes }, &panics);
        let desc = sys::bdpt_custom_desc {
            planes: self.planes,
            measurements: self.measurements,
            hash: self.hash,
            start: Some(start::<M>),
            density: functions.density.then_some(density::<M> as _),
            respond: functions.respond.then_some(respond::<M> as _),
            land: functions.land.then_some(land::<M> as _),
            user: lent.user(),
            drop: Some(give_back::<Held<M>>),
            ..Default::default()
        };
        let made = make(
            &panics,
            // SAFETY: the functions take what `user` is, which the library gives back once.
            |raw| unsafe { sys::bdpt_custom_create(context.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Sensor::new(raw, panics.clone(), context.clone()) },
        );
        if made.is_err() {
            // SAFETY: the call has failed; this is the pointer that it was given.
            unsafe { lent.call_failed(desc.user) };
        }
        made
    }
}

/// What stops the call that renders.
const STOP: i32 = 1;

/// Runs a function of the measurement's; a panic is kept, and stops the call that renders.
///
/// # Safety
/// `user` is that of a sensor that lives.
unsafe fn run<M: Measurement>(user: *mut c_void, function: impl FnOnce(&Held<M>)) -> i32 {
    // SAFETY: as the caller says.
    let held = unsafe { host::<Held<M>>(user) };
    match held.panics.catch(|| function(&held.value)) {
        Some(()) => sys::BDPT_OK,
        None => STOP,
    }
}

unsafe extern "C" fn start<M: Measurement>(
    user: *mut c_void,
    n: u32,
    measurements: *const u64,
    numbers: *const [f32; 4],
    starts: *mut sys::bdpt_measurement_start,
) -> i32 {
    let n = n as usize;
    // SAFETY: the library's arrays of n each; a Start is a bdpt_measurement_start.
    unsafe {
        let (measurements, numbers) = (slice(measurements, n), slice(numbers, n));
        let starts = slice_mut(starts as *mut Start, n);
        run::<M>(user, |held| held.measurement.start(measurements, numbers, starts))
    }
}

unsafe extern "C" fn density<M: Measurement>(
    user: *mut c_void,
    n: u32,
    places: *const sys::bdpt_measurement_place,
    densities: *mut f32,
) -> i32 {
    let n = n as usize;
    // SAFETY: the library's arrays of n each; a Place is a bdpt_measurement_place. What a function may read is set before.
    unsafe {
        densities.write_bytes(0, n);
        let (places, densities) = (slice(places as *const Place, n), slice_mut(densities, n));
        run::<M>(user, |held| held.measurement.density(places, densities))
    }
}

unsafe extern "C" fn respond<M: Measurement>(
    user: *mut c_void,
    n: u32,
    places: *const sys::bdpt_measurement_place,
    responses: *mut f32,
) -> i32 {
    let n = n as usize;
    // SAFETY: the library's arrays, of n and of n times planes; a Place is a bdpt_measurement_place. As above.
    unsafe {
        let places = slice(places as *const Place, n);
        run::<M>(user, |held| {
            responses.write_bytes(0, n * held.planes);
            held.measurement.respond(places, slice_mut(responses, n * held.planes))
        })
    }
}

unsafe extern "C" fn land<M: Measurement>(
    user: *mut c_void,
    n: u32,
    landings: *const sys::bdpt_measurement_landing,
    landed: *mut sys::bdpt_measurement_landed,
) -> i32 {
    let n = n as usize;
    // SAFETY: the library's arrays of n each, of structs that are the same here.
    unsafe {
        let (landings, landed) = (slice(landings as *const Landing, n), slice_mut(landed as *mut Landed, n));
        landed.iter_mut().for_each(|one| one.measurement = sys::BDPT_NO_MEASUREMENT);
        run::<M>(user, |held| held.measurement.land(landings, landed))
    }
}
