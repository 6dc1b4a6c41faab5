// SPDX-License-Identifier: Apache-2.0
//! Sampling a scene into a film.

use crate::error::{Error, Result};
use crate::film::Film;
use crate::handle::Handle;
use crate::panics::{call, make};
use crate::render_options::RenderOptions;
use crate::scene::Scene;
use crate::sensor::Sensor;
use crate::stats::{RenderStats, TechniqueStats};
use bdpt_sys as sys;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// Joins a scene, a sensor and a film, and samples them, pass by pass. It may be sent to another thread, but not shared
/// with one.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::*;
/// let context = Context::new()?;
/// let mut builder = Builder::new(&context)?;
/// builder.add_light(&Light::environment([0.5, 1.0, 2.0]))?;
/// let sensor = Camera::perspective(8, 4).create(&context)?;
/// let film = Film::new(&sensor, &FilmOptions::default())?;
/// let mut render = Render::new(&builder.build()?, &sensor, film, &RenderOptions::new())?;
/// let report = render.advance(Advance::passes(4))?;
/// assert_eq!((report.passes, report.reason), (4, StopReason::Passes));
/// assert_eq!(render.film().read(Layer::Color)?.pixel(3, 2), Some([0.5, 1.0, 2.0]));
/// # Ok(()) }
/// ```
/// ```compile_fail,E0277
/// # fn f(render: bdpt::Render) {
/// std::thread::scope(|scope| {
///     scope.spawn(|| println!("{:?}", render.stats()));
/// });
/// # }
/// ```
///
/// Whoever holds its film waits with the next pass:
/// ```compile_fail,E0502
/// # fn f(mut render: bdpt::Render) -> bdpt::Result<()> {
/// let film = render.film();
/// render.advance(bdpt::Advance::passes(1))?;
/// println!("{:?}", film.info());
/// # Ok(()) }
/// ```
pub struct Render {
    // Destroyed before the film, which it holds, is released.
    raw: Handle<sys::bdpt_render>,
    film: Film,
    scene: Scene,
    sensor: Sensor,
}

impl Render {
    /// A render of a film that is empty or was filled with the same scene, sensor, options and seed: it then goes on,
    /// and passes that the film holds are not rendered again.
    ///
    /// # Errors
    /// The error has the film: see [`RenderError::into_film`]. `?` makes an [`Error`] of it where one is asked for, and
    /// drops the film.
    pub fn new(
        scene: &Scene,
        sensor: &Sensor,
        film: Film,
        options: &RenderOptions,
    ) -> std::result::Result<Self, RenderError> {
        let made = options.with_desc(|desc| {
            make(
                &scene.panics().and(sensor.panics()),
                // SAFETY: all are alive, and the film is this thread's alone.
                |raw| unsafe { sys::bdpt_render_create(scene.as_ptr(), sensor.as_ptr(), film.as_ptr(), desc, raw) },
                // SAFETY: the call gave the render to us.
                |raw| unsafe { Handle::new(raw) },
            )
        });
        match made {
            Ok(raw) => Ok(Self { raw, film, scene: scene.clone(), sensor: sensor.clone() }),
            Err(error) => Err(RenderError { error, film: Mutex::new(film) }),
        }
    }
    /// The film so far.
    pub fn film(&self) -> &Film {
        &self.film
    }
    /// Ends the render and gives the film, with its whole passes.
    pub fn into_film(self) -> Film {
        let Self { raw, film, .. } = self;
        drop(raw);
        film
    }
    /// What is sampled.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// What is measured.
    pub fn sensor(&self) -> &Sensor {
        &self.sensor
    }
    /// What the render has done so far.
    pub fn stats(&self) -> Result<RenderStats> {
        self.parts().1.stats()
    }
    /// What technique (s,t) has done so far; 31 stands for 31 and more.
    pub fn technique_stats(&self, s: u32, t: u32) -> Result<TechniqueStats> {
        self.parts().1.technique_stats(s, t)
    }
    /// The film, and the rest for statistics.
    pub(crate) fn parts(&self) -> (&Film, Statistics<'_>) {
        (&self.film, Statistics { render: &self.raw, scene: &self.scene })
    }
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_render {
        self.raw.as_ptr()
    }
}

/// A render seen by whom may ask it for its statistics, also inside of callbacks.
#[derive(Clone, Copy)]
pub(crate) struct Statistics<'a> {
    render: &'a Handle<sys::bdpt_render>,
    scene: &'a Scene,
}

impl Statistics<'_> {
    pub(crate) fn stats(&self) -> Result<RenderStats> {
        let mut stats = sys::bdpt_render_stats::default();
        let panics = self.scene.context().panics();
        // SAFETY: the render is alive, this thread's alone, and the struct has its size set.
        call(panics, || unsafe { sys::bdpt_render_get_stats(self.render.as_ptr(), &mut stats) })?;
        Ok(RenderStats::new(&stats))
    }
    pub(crate) fn technique_stats(&self, s: u32, t: u32) -> Result<TechniqueStats> {
        let mut stats = sys::bdpt_technique_stats::default();
        let panics = self.scene.context().panics();
        // SAFETY: as above.
        call(panics, || unsafe { sys::bdpt_render_get_technique_stats(self.render.as_ptr(), s, t, &mut stats) })?;
        Ok(TechniqueStats::new(&stats))
    }
}

impl fmt::Debug for Render {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Render").field("film", &self.film).finish_non_exhaustive()
    }
}

/// Why there is no render, and the film that it was to fill.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// # use bdpt::*;
/// # let context = Context::new()?;
/// # let mut builder = Builder::new(&context)?;
/// # builder.add_light(&Light::environment([1.0; 3]))?;
/// # let scene = builder.build()?;
/// # let sensor = Camera::perspective(8, 4).create(&context)?;
/// let film = Film::new(&sensor, &FilmOptions::default())?;
/// let refused = Render::new(&scene, &sensor, film, &RenderOptions::new().plan("none")).err().unwrap();
/// assert_eq!(refused.error().code(), ErrorCode::InvalidArgument);
/// Render::new(&scene, &sensor, refused.into_film(), &RenderOptions::new())?;
/// # Ok(()) }
/// ```
pub struct RenderError {
    error: Error,
    // Behind a lock, so that errors may be shared between threads although films may not.
    film: Mutex<Film>,
}

impl RenderError {
    /// Why.
    pub fn error(&self) -> &Error {
        &self.error
    }
    /// The film, as it was.
    pub fn into_film(self) -> Film {
        self.film.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl From<RenderError> for Error {
    fn from(error: RenderError) -> Self {
        error.error
    }
}

impl fmt::Debug for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("RenderError").field("error", &self.error).finish_non_exhaustive()
    }
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for RenderError {}
