// SPDX-License-Identifier: Apache-2.0
//! Images on their way out, tile by tile.

use crate::flow::Flow;
use crate::host::slice;
use crate::panics::catch_here;
use crate::rect::Rect;
use bdpt_sys as sys;
use std::ops::ControlFlow;
use std::os::raw::c_void;

/// Receives the image of the whole passes so far, tile by tile. See [`Advance::sink`](crate::Advance::sink).
pub trait Sink {
    /// An image begins: its size, and the passes that it has.
    fn begin(&mut self, width: u32, height: u32, passes: u64) -> ControlFlow<()> {
        let _ = (width, height, passes);
        ControlFlow::Continue(())
    }
    /// One of its tiles.
    fn tile(&mut self, tile: Tile<'_>) -> ControlFlow<()>;
    /// It ends: complete, or because a callback stopped it or memory ran out. Called whenever `begin` was.
    fn end(&mut self, complete: bool) {
        let _ = complete;
    }
}

impl<S: Sink + ?Sized> Sink for &mut S {
    fn begin(&mut self, width: u32, height: u32, passes: u64) -> ControlFlow<()> {
        (**self).begin(width, height, passes)
    }
    fn tile(&mut self, tile: Tile<'_>) -> ControlFlow<()> {
        (**self).tile(tile)
    }
    fn end(&mut self, complete: bool) {
        (**self).end(complete);
    }
}

/// A tile of an image. It is valid during its callback:
///
/// ```compile_fail,E0521
/// # use bdpt::{Advance, Tile};
/// let mut kept: Vec<Tile<'static>> = Vec::new();
/// let advance = Advance::passes(1).tiles(1, |tile| kept.push(tile));
/// # drop(advance);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Tile<'a> {
    rect: Rect,
    passes: u64,
    pixels: &'a [[f32; 3]],
}

impl<'a> Tile<'a> {
    /// Where in the image it is.
    pub fn rect(&self) -> Rect {
        self.rect
    }
    /// The passes that the image has.
    pub fn passes(&self) -> u64 {
        self.passes
    }
    /// Its pixels, row by row.
    pub fn pixels(&self) -> &'a [[f32; 3]] {
        self.pixels
    }
    /// Its rows, from the top.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &'a [[f32; 3]]> {
        self.pixels.chunks_exact((self.rect.width() as usize).max(1))
    }
}

struct EachTile<F>(F);

impl<R: Flow, F: FnMut(Tile<'_>) -> R> Sink for EachTile<F> {
    fn tile(&mut self, tile: Tile<'_>) -> ControlFlow<()> {
        (self.0)(tile).flow()
    }
}

/// A closure as a sink.
pub(crate) fn each_tile<R: Flow>(tile: impl FnMut(Tile<'_>) -> R) -> impl Sink {
    EachTile(tile)
}

/// What the library's sink calls.
pub(crate) struct Sending<'a> {
    every: u32,
    sink: Box<dyn Sink + 'a>,
    passes: u64,
    broke: bool,
}

impl<'a> Sending<'a> {
    pub(crate) fn new(every: u32, sink: Box<dyn Sink + 'a>) -> Self {
        Self { every, sink, passes: 0, broke: false }
    }
    /// Whether a callback asked to stop.
    pub(crate) fn broke(&self) -> bool {
        self.broke
    }
    /// Valid as long as `self` stays where it is, and is used by the callbacks alone.
    pub(crate) fn raw(&mut self) -> sys::bdpt_output_sink {
        sys::bdpt_output_sink {
            every: self.every,
            begin: Some(begin),
            tile: Some(tile),
            end: Some(end),
            user: (self as *mut Self).cast(),
            ..Default::default()
        }
    }
    fn run(&mut self, call: impl FnOnce(&mut dyn Sink) -> ControlFlow<()>) -> i32 {
        let flow = catch_here(|| call(&mut *self.sink));
        self.broke |= flow == Some(ControlFlow::Break(()));
        i32::from(flow != Some(ControlFlow::Continue(())))
    }
}

/// # Safety
/// The call that was given `user` is running, and this is its thread.
unsafe fn sending<'a>(user: *mut c_void) -> &'a mut Sending<'a> {
    // SAFETY: callbacks come one at a time.
    unsafe { &mut *user.cast() }
}

unsafe extern "C" fn begin(user: *mut c_void, width: u32, height: u32, passes: u64) -> i32 {
    // SAFETY: called by the library during advance.
    let sending = unsafe { sending(user) };
    sending.passes = passes;
    sending.run(|sink| sink.begin(width, height, passes))
}

unsafe extern "C" fn tile(user: *mut c_void, x0: u32, y0: u32, x1: u32, y1: u32, pixels: *const f32) -> i32 {
    // SAFETY: called by the library during advance.
    let sending = unsafe { sending(user) };
    let rect = Rect::new(x0, y0, x1, y1);
    let count = rect.width() as usize * rect.height() as usize;
    // SAFETY: packed pixels of the rectangle, three floats each, valid during the call.
    let pixels = unsafe { slice(pixels.cast::<[f32; 3]>(), count) };
    let passes = sending.passes;
    sending.run(|sink| sink.tile(Tile { rect, passes, pixels }))
}

unsafe extern "C" fn end(user: *mut c_void, result: sys::bdpt_result) {
    // SAFETY: called by the library during advance.
    let sending = unsafe { sending(user) };
    catch_here(|| sending.sink.end(result == sys::BDPT_OK));
}
