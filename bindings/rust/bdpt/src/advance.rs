// SPDX-License-Identifier: Apache-2.0
//! Passes: how many, and who hears of them.

use crate::cancel::{token_ptr, CancelToken};
use crate::error::{check, Error, ErrorCode, Result};
use crate::film::Film;
use crate::flow::Flow;
use crate::panics::{catch_here, frame, is_set_here, Panics};
use crate::progress::Progress;
use crate::render::{Render, Statistics};
use crate::sink::{self, Sending, Sink, Tile};
use crate::stats::{RenderStats, TechniqueStats};
use bdpt_sys as sys;
use std::fmt;
use std::ops::ControlFlow;
use std::os::raw::c_void;
use std::ptr::null;

/// How far a render goes, and who hears of it. The first limit that is reached counts.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// # use bdpt::*;
/// # let context = Context::new()?;
/// # let mut builder = Builder::new(&context)?;
/// # builder.add_light(&Light::environment([1.0; 3]))?;
/// # let sensor = Camera::perspective(8, 4).create(&context)?;
/// # let film = Film::new(&sensor, &FilmOptions::default())?;
/// # let mut render = Render::new(&builder.build()?, &sensor, film, &RenderOptions::new())?;
/// let token = CancelToken::new()?;
/// let mut tiles = 0;
/// let report = render.advance(
///     Advance::passes(64)
///         .seconds(10.0)
///         .cancel(&token)
///         .progress(|now| println!("{:.0} %", 100.0 * now.progress.fraction))
///         .tiles(16, |tile| tiles += tile.rows().count()),
/// )?;
/// assert_eq!((report.passes, tiles), (64, 4 * 4));
/// # Ok(()) }
/// ```
///
/// What callbacks borrow outlives the call:
/// ```compile_fail,E0597
/// # use bdpt::Advance;
/// let advance = {
///     let mut calls = 0;
///     Advance::passes(1).progress(|_| calls += 1)
/// };
/// # drop(advance);
/// ```
/// and the film that they see does not:
/// ```compile_fail,E0521
/// # use bdpt::{Advance, Film};
/// let mut kept: Option<&Film> = None;
/// let advance = Advance::passes(1).progress(|now| kept = Some(now.film));
/// # drop(advance);
/// ```
/// nor does it go to another thread:
/// ```compile_fail,E0277
/// # use bdpt::Advance;
/// let advance = Advance::passes(1).progress(|now| {
///     std::thread::scope(|scope| {
///         scope.spawn(|| println!("{:?}", now.film));
///     });
/// });
/// # drop(advance);
/// ```
#[derive(Default)]
pub struct Advance<'a> {
    passes: u64,
    seconds: f64,
    noise: f64,
    cancel: Option<CancelToken>,
    progress: Option<Told<'a>>,
    sink: Option<(u32, Box<dyn Sink + 'a>)>,
}

type Told<'a> = Box<dyn FnMut(&Running<'_>) -> ControlFlow<()> + 'a>;

impl<'a> Advance<'a> {
    /// So many passes; 0 = no such limit.
    pub fn passes(passes: u64) -> Self {
        Self { passes, ..Self::default() }
    }
    /// To the first whole pass after so many seconds.
    pub fn for_seconds(seconds: f64) -> Self {
        Self::default().seconds(seconds)
    }
    /// Until the film's relative error is at most this.
    pub fn to_noise(noise: f64) -> Self {
        Self::default().noise(noise)
    }
    /// At most to the first whole pass after so many seconds; 0 = no such limit.
    pub fn seconds(mut self, seconds: f64) -> Self {
        self.seconds = seconds;
        self
    }
    /// At most until the film's relative error is this; 0 = no such limit.
    pub fn noise(mut self, noise: f64) -> Self {
        self.noise = noise;
        self
    }
    /// Stops the call from anywhere; it returns with [`StopReason::Cancelled`]. What is finished is kept, and the next
    /// call completes the pass.
    pub fn cancel(mut self, token: &CancelToken) -> Self {
        self.cancel = Some(token.clone());
        self
    }
    /// Called about ten times a second on this thread, once at the beginning, and once at the end of a call that
    /// finishes. [`ControlFlow::Break`] stops the call, which returns with [`StopReason::Callback`]. A panic goes
    /// on where the call returns, and the render can be used after it.
    pub fn progress<R: Flow>(mut self, mut progress: impl FnMut(&Running<'_>) -> R + 'a) -> Self {
        self.progress = Some(Box::new(move |now| progress(now).flow()));
        self
    }
    /// Sends the image in tiles, after every so many passes and at the end of the call; 0 = only at the end. Returns
    /// and panics are as those of [`progress`](Self::progress).
    pub fn tiles<R: Flow>(self, every: u32, tile: impl FnMut(Tile<'_>) -> R + 'a) -> Self {
        self.sink(every, sink::each_tile(tile))
    }
    /// As [`tiles`](Self::tiles), to one that also wants to know where an image begins and ends.
    pub fn sink(mut self, every: u32, sink: impl Sink + 'a) -> Self {
        self.sink = Some((every, Box::new(sink)));
        self
    }
}

impl fmt::Debug for Advance<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Advance")
            .field("passes", &self.passes)
            .field("seconds", &self.seconds)
            .field("noise", &self.noise)
            .field("cancel", &self.cancel)
            .finish_non_exhaustive()
    }
}

/// A render in the middle of [`Render::advance`].
#[non_exhaustive]
pub struct Running<'a> {
    /// How far the call is.
    pub progress: Progress,
    /// The film so far, to be read or saved.
    pub film: &'a Film,
    statistics: Statistics<'a>,
}

impl Running<'_> {
    /// What the render has done so far.
    pub fn stats(&self) -> Result<RenderStats> {
        self.statistics.stats()
    }
    /// What technique (s,t) has done so far; blocks that are not done are left out.
    pub fn technique_stats(&self, s: u32, t: u32) -> Result<TechniqueStats> {
        self.statistics.technique_stats(s, t)
    }
}

impl fmt::Debug for Running<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Running").field("progress", &self.progress).finish_non_exhaustive()
    }
}

enumeration!(
    /// Why a call returned.
    StopReason: bdpt_stop_reason {
        /// All passes are done.
        Passes = BDPT_STOP_PASSES,
        /// The time is over.
        Time = BDPT_STOP_TIME,
        /// The film's noise is low enough.
        Noise = BDPT_STOP_NOISE,
        /// A [`CancelToken`] asked for it.
        Cancelled = BDPT_STOP_CANCELLED,
        /// A callback asked for it.
        Callback = BDPT_STOP_CALLBACK,
    }
);

/// What [`Render::advance`] did.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdvanceReport {
    /// Why it returned.
    pub reason: StopReason,
    /// Whole passes finished by this call.
    pub passes: u64,
    /// The first pass that is not finished.
    pub next_pass: u64,
    /// How long it took.
    pub seconds: f64,
    /// Of the film now, where the call has a limit of noise; `None` else, and while fewer than two of the film's groups
    /// hold passes: [`FilmInfo`](crate::FilmInfo) has it.
    pub relative_error: Option<f64>,
}

impl AdvanceReport {
    fn new(raw: &sys::bdpt_advance_report) -> Self {
        Self {
            reason: StopReason::new(raw.reason),
            passes: raw.passes,
            next_pass: raw.next_pass,
            seconds: raw.seconds,
            relative_error: (raw.relative_error >= 0.0).then_some(raw.relative_error),
        }
    }
}

/// What the progress callback needs.
struct Telling<'a, 'b> {
    told: Option<Told<'a>>,
    film: &'b Film,
    statistics: Statistics<'b>,
    panics: &'b Panics,
    broke: bool,
}

impl Render {
    /// Samples passes until a limit is reached, with this thread at work, too.
    ///
    /// A panic in a callback, or in a texture, material or measurement of the host's, stops the call and goes on from
    /// here. The render can be used after it.
    ///
    /// # Errors
    /// A cancel, and a callback that breaks, are none: see [`AdvanceReport::reason`].
    pub fn advance(&mut self, advance: Advance<'_>) -> Result<AdvanceReport> {
        let panics = self.scene().panics().and(self.sensor().panics());
        let (film, statistics) = self.parts();
        let mut telling = Telling { told: advance.progress, film, statistics, panics: &panics, broke: false };
        let mut sending = advance.sink.map(|(every, sink)| Sending::new(every, sink));
        let raw_sink = sending.as_mut().map(Sending::raw);
        let desc = sys::bdpt_advance_desc {
            passes: advance.passes,
            seconds: advance.seconds,
            noise: advance.noise,
            cancel: token_ptr(&advance.cancel),
            progress: Some(report),
            progress_user: (&mut telling as *mut Telling<'_, '_>).cast(),
            sink: raw_sink.as_ref().map_or(null(), |sink| sink),
            ..Default::default()
        };
        let mut done = sys::bdpt_advance_report::default();
        // SAFETY: the render is this call's alone, but for what callbacks may ask of it; all that desc points to lives
        // until the call returns, and is used by its callbacks alone.
        let (result, payload) = frame(|| check(unsafe { sys::bdpt_render_advance(self.as_ptr(), &desc, &mut done) }));
        let broke = telling.broke || sending.map_or(false, |sending| sending.broke());
        panics.resume(payload);
        match result.as_ref().map_err(Error::code) {
            Ok(()) | Err(ErrorCode::Cancelled) => Ok(AdvanceReport::new(&done)),
            Err(ErrorCode::CallbackFailed) if broke => Ok(AdvanceReport::new(&done)),
            Err(_) => result.map(|()| AdvanceReport::new(&done)),
        }
    }
}

unsafe extern "C" fn report(user: *mut c_void, progress: *const sys::bdpt_progress) -> i32 {
    // SAFETY: advance is running, and calls back on its own thread, one call at a time; progress is valid meanwhile.
    let (telling, progress) = unsafe { (&mut *user.cast::<Telling<'_, '_>>(), Progress::new(&*progress)) };
    // Somewhere else the host's code panicked: what is left of the call is not wanted.
    if is_set_here() || telling.panics.is_set() {
        return 1;
    }
    let Telling { told, film, statistics, broke, .. } = telling;
    let flow = match told {
        Some(told) => catch_here(|| told(&Running { progress, film, statistics: *statistics })),
        None => Some(ControlFlow::Continue(())),
    };
    *broke |= flow == Some(ControlFlow::Break(()));
    i32::from(flow != Some(ControlFlow::Continue(())))
}
