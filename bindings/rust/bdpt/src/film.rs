// SPDX-License-Identifier: Apache-2.0
//! The measurements.

use crate::context::Context;
use crate::error::{Error, Result, Text};
use crate::film_options::{FilmOptions, Filter, MemoryEstimate, Normalization};
use crate::handle::Handle;
use crate::image::Image;
use crate::panics::{call, make};
use crate::read::{Coverage, CoverageEntry, CoverageOptions, ReadOptions};
use crate::rect::Rect;
use crate::sensor::Sensor;
use bdpt_sys as sys;
use std::fmt;
use std::path::Path;

/// The measurements of a sensor: what a [`Render`](crate::Render) fills. It may be sent to another thread, but not
/// shared with one.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Camera, Context, Film, FilmOptions, Layer};
/// let sensor = Camera::perspective(64, 48).create(&Context::new()?)?;
/// let film = Film::new(&sensor, &FilmOptions::default())?;
/// assert_eq!(film.read(Layer::Color)?.pixel(0, 0), Some([0.0; 3]));
/// # Ok(()) }
/// ```
/// ```compile_fail,E0277
/// # fn f(film: bdpt::Film) {
/// std::thread::scope(|scope| {
///     scope.spawn(|| println!("{:?}", film.info()));
/// });
/// # }
/// ```
pub struct Film {
    raw: Handle<sys::bdpt_film>,
    context: Context,
    // Kept, for to ask the library for it costs an estimate of the noise.
    width: u32,
    height: u32,
}

impl Film {
    /// An empty film for a sensor.
    pub fn new(sensor: &Sensor, options: &FilmOptions) -> Result<Self> {
        make(
            sensor.panics(),
            // SAFETY: the sensor is alive, and the description lives until the call returns.
            |raw| unsafe { sys::bdpt_film_create(sensor.as_ptr(), &options.raw, raw) },
            // SAFETY: the call gave one reference.
            |raw| Self { raw: unsafe { Handle::new(raw) }, context: sensor.context().clone(), width: 0, height: 0 },
        )?
        .with_size()
    }
    /// What a film and its render will take, before there is one.
    pub fn estimate(sensor: &Sensor, options: &FilmOptions) -> Result<MemoryEstimate> {
        let mut estimate = sys::bdpt_memory_estimate::default();
        // SAFETY: the sensor is alive, and the structs have their sizes set.
        call(sensor.panics(), || unsafe { sys::bdpt_film_estimate(sensor.as_ptr(), &options.raw, &mut estimate) })?;
        Ok(MemoryEstimate::new(&estimate))
    }
    /// Reads a film that [`save`](Self::save) wrote.
    pub fn load(context: &Context, path: impl AsRef<Path>) -> Result<Self> {
        let path = Text::path(path.as_ref())?;
        make(
            context.panics(),
            // SAFETY: context and path live until the call returns.
            |raw| unsafe { sys::bdpt_film_load(context.as_ptr(), path.as_ptr(), raw) },
            // SAFETY: the call gave one reference.
            |raw| Self { raw: unsafe { Handle::new(raw) }, context: context.clone(), width: 0, height: 0 },
        )?
        .with_size()
    }
    fn with_size(self) -> Result<Self> {
        let FilmInfo { width, height, .. } = self.info()?;
        Ok(Self { width, height, ..self })
    }
    /// What it was made in.
    pub fn context(&self) -> &Context {
        &self.context
    }

    fn call(&self, make_it: impl FnOnce(*mut sys::bdpt_film) -> sys::bdpt_result) -> Result<()> {
        call(self.context.panics(), || make_it(self.raw.as_ptr()))
    }

    /// What the film holds.
    pub fn info(&self) -> Result<FilmInfo> {
        let mut info = sys::bdpt_film_info::default();
        // SAFETY: the film is alive, and the struct has its size set.
        self.call(|film| unsafe { sys::bdpt_film_get_info(film, &mut info) })?;
        Ok(FilmInfo {
            width: info.width,
            height: info.height,
            groups: info.groups,
            pyramid_edges: info.pyramid_edges,
            filter: Filter::new(info.filter),
            filter_radius: info.filter_radius,
            normalization: Normalization::new(info.normalization),
            passes: info.passes,
            first_pass: info.first_pass,
            next_pass: info.next_pass,
            seed: info.seed,
            scene_hash: info.scene_hash,
            options_hash: info.options_hash,
            rejected: info.rejected,
            relative_error: (info.relative_error >= 0.0).then_some(info.relative_error),
            measured: info.measured,
            planes: info.planes,
            coverages: info.coverages,
        })
    }

    /// Reads a layer into a picture of its own.
    pub fn read(&self, options: impl Into<ReadOptions>) -> Result<Image> {
        let options = ReadOptions { row_stride: 0, ..options.into() };
        let (width, height) = self.size_of(options.raw.rect);
        let mut image = Image::new(width, height)?;
        self.read_into(&options, image.as_floats_mut())?;
        Ok(image)
    }
    /// Reads a layer into an array of rows, columns and 3 colours.
    #[cfg(feature = "ndarray")]
    #[cfg_attr(docsrs, doc(cfg(feature = "ndarray")))]
    pub fn read_ndarray(&self, options: impl Into<ReadOptions>) -> Result<ndarray::Array3<f32>> {
        self.read(options)?.into_ndarray()
    }
    /// Reads a layer into a slice, 3 floats to a pixel.
    ///
    /// # Errors
    /// Also when the slice is too small.
    pub fn read_into(&self, options: &ReadOptions, pixels: &mut [f32]) -> Result<()> {
        let row_stride = (options.row_stride as u64).checked_mul(4);
        let row_stride = row_stride.ok_or_else(|| Error::refused("row_stride is beyond all memory"))?;
        let desc = sys::bdpt_read_desc { row_stride, ..options.raw };
        let capacity = std::mem::size_of_val(pixels) as u64;
        // SAFETY: the film is alive, and the library writes no more than the capacity.
        self.call(|film| unsafe { sys::bdpt_film_read(film, &desc, pixels.as_mut_ptr(), capacity) })
    }
    /// Reads whose surfaces the samples of each pixel met.
    pub fn read_coverage(&self, options: &CoverageOptions) -> Result<Coverage> {
        let (width, height) = self.size_of(options.raw.rect);
        let ranks = options.raw.ranks.min(8);
        // At most 65536 x 65536 x 8.
        let entries = u64::from(width) * u64::from(height) * u64::from(ranks);
        let mut raw: Vec<sys::bdpt_coverage> = Vec::new();
        match usize::try_from(entries).ok().map(|entries| (entries, raw.try_reserve_exact(entries))) {
            Some((entries, Ok(()))) => raw.resize(entries, Default::default()),
            _ => return Err(Error::out_of_memory(format!("{entries} entries of coverage"))),
        }
        let mut lost = 0.0;
        // SAFETY: the film is alive, and the library writes no more entries than there are.
        self.call(|film| unsafe {
            sys::bdpt_film_read_coverage(film, &options.raw, raw.as_mut_ptr(), raw.len() as u64, &mut lost)
        })?;
        let entries = raw.into_iter().map(|entry| CoverageEntry { id: entry.id, part: entry.part }).collect();
        Ok(Coverage { width, height, ranks, entries, lost })
    }
    /// Of a rectangle within the film, of the film where it is empty, and nothing where it is neither: the library
    /// refuses such.
    fn size_of(&self, [x0, y0, x1, y1]: [u32; 4]) -> (u32, u32) {
        let rect = Rect::new(x0, y0, x1, y1);
        if rect == Rect::default() {
            (self.width, self.height)
        } else if rect.x1 <= self.width && rect.y1 <= self.height {
            (rect.width(), rect.height())
        } else {
            (0, 0)
        }
    }

    /// Empties the film, so that another scene or other options may fill it.
    pub fn clear(&mut self) -> Result<()> {
        // SAFETY: the film is alive.
        self.call(|film| unsafe { sys::bdpt_film_clear(film) })
    }
    /// Adds the passes of another film, exactly: the merge of passes 0..k and k..n is the render of 0..n. An empty film
    /// takes all; else both are of one scene, seed and options, and have no pass in common.
    pub fn merge(&mut self, source: &Film) -> Result<()> {
        // SAFETY: both films are alive, and this thread is the only one to use them.
        self.call(|film| unsafe { sys::bdpt_film_merge(film, source.raw.as_ptr()) })
    }
    /// Writes the film's whole state to a file, so that the path holds the old file or the new one.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = Text::path(path.as_ref())?;
        // SAFETY: film and path live until the call returns.
        self.call(|film| unsafe { sys::bdpt_film_save(film, path.as_ptr()) })
    }

    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_film {
        self.raw.as_ptr()
    }
}

impl fmt::Debug for Film {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Film").field("info", &self.info()).finish_non_exhaustive()
    }
}

/// What a [`Film`] holds.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmInfo {
    /// Of the region measured: that of the crop window.
    pub width: u32,
    /// Of the region measured.
    pub height: u32,
    /// Independent groups of passes.
    pub groups: u32,
    /// Longest paths of which there is an image for each technique.
    pub pyramid_edges: u32,
    /// How samples are spread over pixels.
    pub filter: Filter,
    /// In pixels.
    pub filter_radius: f32,
    /// By what sums are divided.
    pub normalization: Normalization,
    /// Whole passes in the film.
    pub passes: u64,
    /// The lowest of them.
    pub first_pass: u64,
    /// One past the highest of them: where a render would go on.
    pub next_pass: u64,
    /// Of the render that filled it; 0 while empty.
    pub seed: u64,
    /// 0 while empty.
    pub scene_hash: u64,
    /// Of sensor, film and render options; 0 while empty.
    pub options_hash: u64,
    /// Contributions that were not finite or too large, and were left out.
    pub rejected: u64,
    /// Square root of the relative variance, averaged over the measurements of plane 0; `None` while fewer than two
    /// groups hold passes.
    pub relative_error: Option<f64>,
    /// Measurements: pixels, or texels that cover some surface.
    pub measured: u64,
    /// Of three colours; 1 for a camera without outputs.
    pub planes: u32,
    /// Outputs of coverage.
    pub coverages: u32,
}
