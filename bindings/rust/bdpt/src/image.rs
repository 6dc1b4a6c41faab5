// SPDX-License-Identifier: Apache-2.0
//! Pictures in memory.

use crate::error::{Error, Result};
use crate::rect::Rect;
use std::fmt;

/// A picture of three floats to a pixel, packed, the top row first: what a film is read into.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let mut image = bdpt::Image::new(4, 2)?;
/// image.pixels_mut()[3] = [1.0, 0.5, 0.25];
/// assert_eq!(image.pixel(3, 0), Some([1.0, 0.5, 0.25]));
/// assert_eq!(image.rows().count(), 2);
/// assert_eq!(image.tiles(3, 3).map(|tile| tile.rect().width()).collect::<Vec<_>>(), [3, 1]);
/// # Ok(()) }
/// ```
#[derive(Clone, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Image {
    /// A black picture.
    ///
    /// # Errors
    /// When there is no memory for it.
    pub fn new(width: u32, height: u32) -> Result<Self> {
        let count = usize::try_from(u64::from(width) * u64::from(height)).ok();
        let mut pixels = Vec::new();
        match count.map(|count| (count, pixels.try_reserve_exact(count))) {
            Some((count, Ok(()))) => pixels.resize(count, [0.0; 3]),
            _ => return Err(Error::out_of_memory(format!("a picture of {width} x {height} pixels"))),
        }
        Ok(Self { width, height, pixels })
    }
    /// A picture of pixels in rows.
    ///
    /// # Errors
    /// When there are not `width` times `height` of them.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Self> {
        if pixels.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(Error::refused(format!("{} pixels are no picture of {width} x {height}", pixels.len())));
        }
        Ok(Self { width, height, pixels })
    }
    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }
    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }
    /// All pixels, row by row.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }
    /// All pixels, row by row, to be changed.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }
    /// All pixels, row by row.
    pub fn into_pixels(self) -> Vec<[f32; 3]> {
        self.pixels
    }
    /// All pixels as numbers.
    pub fn as_floats(&self) -> &[f32] {
        floats(&self.pixels)
    }
    /// All pixels as numbers, to be changed.
    pub fn as_floats_mut(&mut self) -> &mut [f32] {
        floats_mut(&mut self.pixels)
    }
    /// The pixel in column `x` and row `y`; `None` outside of the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 3]> {
        if x >= self.width {
            return None;
        }
        self.pixels.get(y as usize * self.width as usize + x as usize).copied()
    }
    /// The picture as an array of rows, columns and 3 colours. Nothing is copied.
    ///
    /// ```
    /// # fn main() -> bdpt::Result<()> {
    /// let array = bdpt::Image::new(4, 2)?.into_ndarray()?;
    /// assert_eq!(array.shape(), [2, 4, 3]);
    /// # Ok(()) }
    /// ```
    #[cfg(feature = "ndarray")]
    #[cfg_attr(docsrs, doc(cfg(feature = "ndarray")))]
    pub fn into_ndarray(self) -> Result<ndarray::Array3<f32>> {
        let shape = (self.height as usize, self.width as usize, 3);
        let mut pixels = std::mem::ManuallyDrop::new(self.pixels);
        let (data, len, capacity) = (pixels.as_mut_ptr(), pixels.len(), pixels.capacity());
        // SAFETY: the vector's memory, which it gives up; three floats have the layout of an array of three.
        let floats = unsafe { Vec::from_raw_parts(data.cast::<f32>(), len * 3, capacity * 3) };
        ndarray::Array3::from_shape_vec(shape, floats).map_err(|error| Error::refused(error.to_string()))
    }
    /// The rows, from the top.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = &[[f32; 3]]> + ExactSizeIterator {
        self.pixels.chunks_exact((self.width as usize).max(1))
    }
    /// The picture in tiles of at most `width` x `height` pixels, row by row; those at the edges are smaller.
    pub fn tiles(&self, width: u32, height: u32) -> impl Iterator<Item = TileView<'_>> {
        let (width, height) = (width.max(1), height.max(1));
        let (columns, rows) = (steps(self.width, width), steps(self.height, height));
        rows.flat_map(move |y0| columns.clone().map(move |x0| (x0, y0))).map(move |(x0, y0)| TileView {
            image: self,
            rect: Rect::new(
                x0,
                y0,
                x0.saturating_add(width).min(self.width),
                y0.saturating_add(height).min(self.height),
            ),
        })
    }
}

fn steps(end: u32, step: u32) -> impl Iterator<Item = u32> + Clone {
    (0..end).step_by(step as usize)
}

impl fmt::Debug for Image {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Image").field("width", &self.width).field("height", &self.height).finish_non_exhaustive()
    }
}

/// A rectangle of an [`Image`].
#[derive(Clone, Copy, Debug)]
pub struct TileView<'a> {
    image: &'a Image,
    rect: Rect,
}

impl<'a> TileView<'a> {
    /// Where in the picture it is.
    pub fn rect(&self) -> Rect {
        self.rect
    }
    /// Its rows, from the top.
    pub fn rows(&self) -> impl Iterator<Item = &'a [[f32; 3]]> {
        let Rect { x0, y0, x1, y1 } = self.rect;
        let rows = self.image.rows().skip(y0 as usize).take((y1 - y0) as usize);
        rows.filter_map(move |row| row.get(x0 as usize..x1 as usize))
    }
}

/// Pixels as numbers.
pub(crate) fn floats(pixels: &[[f32; 3]]) -> &[f32] {
    // SAFETY: an array of floats has their layout, without padding, and the length cannot overflow: it is in memory.
    unsafe { std::slice::from_raw_parts(pixels.as_ptr().cast(), pixels.len() * 3) }
}

/// Pixels as numbers, to be changed.
pub(crate) fn floats_mut(pixels: &mut [[f32; 3]]) -> &mut [f32] {
    // SAFETY: as above; every float is a value.
    unsafe { std::slice::from_raw_parts_mut(pixels.as_mut_ptr().cast(), pixels.len() * 3) }
}
