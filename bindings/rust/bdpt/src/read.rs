// SPDX-License-Identifier: Apache-2.0
//! What is read from a film, and how.

use crate::rect::Rect;
use bdpt_sys as sys;

/// A layer of a [`Film`](crate::Film).
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Layer {
    /// The image: eye image plus light image.
    Color,
    /// The eye image: t >= 2.
    Eye,
    /// The light image: t <= 1.
    Light,
    /// The variance of [`Color`](Self::Color) (of the mean, not of one sample), from the film's groups.
    Variance,
    /// The weighted contribution of a technique of the pyramid.
    Technique {
        /// Vertices of the light subpath.
        s: u32,
        /// Vertices of the eye subpath.
        t: u32,
    },
    /// How many contributions to the pixel were left out, not being finite or being too large.
    Rejected,
    /// The eye samples of the pixel. Of cameras with outputs.
    Samples,
}

impl From<Layer> for ReadOptions {
    fn from(layer: Layer) -> Self {
        Self::new(layer)
    }
}

/// What is read from a [`Film`](crate::Film), and how: [`Film::read`](crate::Film::read) takes this, or a [`Layer`].
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Camera, Context, Film, FilmOptions, Layer, ReadOptions, Rect};
/// let sensor = Camera::perspective(64, 48).create(&Context::new()?)?;
/// let film = Film::new(&sensor, &FilmOptions::default())?;
/// let corner = film.read(ReadOptions::new(Layer::Color).rect(Rect::new(0, 0, 8, 4)).flip(true))?;
/// assert_eq!((corner.width(), corner.height()), (8, 4));
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct ReadOptions {
    pub(crate) raw: sys::bdpt_read_desc,
    pub(crate) row_stride: usize,
}

impl ReadOptions {
    /// All of a layer's whole passes.
    pub fn new(layer: Layer) -> Self {
        let mut raw = sys::bdpt_read_desc::default();
        raw.layer = match layer {
            Layer::Color => sys::BDPT_LAYER_COLOR,
            Layer::Eye => sys::BDPT_LAYER_EYE,
            Layer::Light => sys::BDPT_LAYER_LIGHT,
            Layer::Variance => sys::BDPT_LAYER_VARIANCE,
            Layer::Technique { s, t } => {
                (raw.s, raw.t) = (s, t);
                sys::BDPT_LAYER_TECHNIQUE
            }
            Layer::Rejected => sys::BDPT_LAYER_REJECTED,
            Layer::Samples => sys::BDPT_LAYER_SAMPLES,
        };
        Self { raw, row_stride: 0 }
    }
    /// A part of the film; without width and height, all.
    pub fn rect(mut self, rect: Rect) -> Self {
        self.raw.rect = rect.raw();
        self
    }
    /// Floats from row to row where they are read into a slice; 0 = packed.
    pub fn row_stride(mut self, floats: usize) -> Self {
        self.row_stride = floats;
        self
    }
    setters! {
        /// The bottom row first.
        flip: bool => flip;
        /// With the blocks of a pass that a cancel interrupted, each weighed as if the pass were whole.
        include_partial: bool => include_partial;
        /// Of the sensor's outputs, one after another; of a camera 0 is the picture.
        plane: u32 => plane;
    }
}

/// Which ids are read from a film with coverage outputs.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Camera, Context, CoverageOptions, Film, FilmOptions, Output, OutputKind};
/// let camera = Camera::perspective(8, 4).output(Output::new(OutputKind::InstanceCoverage));
/// let film = Film::new(&camera.create(&Context::new()?)?, &FilmOptions::default())?;
/// let coverage = film.read_coverage(&CoverageOptions::new().ranks(2))?;
/// assert!(coverage.pixel(0, 0).iter().all(|entry| entry.part == 0.0));
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct CoverageOptions {
    pub(crate) raw: sys::bdpt_coverage_desc,
}

impl CoverageOptions {
    /// The id with the largest part of each pixel, of the first output of coverage.
    pub fn new() -> Self {
        Self { raw: sys::bdpt_coverage_desc { ranks: 1, ..Default::default() } }
    }
    /// A part of the film; without width and height, all.
    pub fn rect(mut self, rect: Rect) -> Self {
        self.raw.rect = rect.raw();
        self
    }
    setters! {
        /// Of the camera's outputs of coverage, in their order: 0 or 1.
        coverage: u32 => coverage;
        /// Ids of each pixel, 1 to 8.
        ranks: u32 => ranks;
        /// With the blocks of a pass that a cancel interrupted.
        include_partial: bool => include_partial;
    }
}

impl Default for CoverageOptions {
    fn default() -> Self {
        Self::new()
    }
}

/// Whose surfaces the samples of a pixel met.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageEntry {
    /// The [`number`](crate::InstanceId::number) of an instance's or material's id; 0 where `part` is 0.
    pub id: u64,
    /// Of the pixel's samples, in \[0,1\].
    pub part: f32,
}

/// Ids of each pixel, those with the largest parts first.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) ranks: u32,
    pub(crate) entries: Vec<CoverageEntry>,
    pub(crate) lost: f64,
}

impl Coverage {
    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }
    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }
    /// The part of all samples whose ids were left out.
    pub fn lost(&self) -> f64 {
        self.lost
    }
    /// All entries, row by row, as many to a pixel as ranks were asked for.
    pub fn entries(&self) -> &[CoverageEntry] {
        &self.entries
    }
    /// The entries of a pixel; empty outside of the picture.
    pub fn pixel(&self, x: u32, y: u32) -> &[CoverageEntry] {
        if x >= self.width || y >= self.height {
            return &[];
        }
        let first = (y as usize * self.width as usize + x as usize) * self.ranks as usize;
        self.entries.get(first..first + self.ranks as usize).unwrap_or_default()
    }
}
