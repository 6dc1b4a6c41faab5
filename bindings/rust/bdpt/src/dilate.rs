// SPDX-License-Identifier: Apache-2.0
//! Gutters of atlases.

use crate::count::bytes;
use crate::error::{check, Result};
use bdpt_sys as sys;
use std::ptr::null_mut;

/// Fills the gutters of an atlas: in each step every texel without a value that has neighbours with one, among the eight
/// round it, takes their mean in every channel.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// // Four texels in a row, of which one has a value.
/// let (mut texels, mut mask) = ([0.0, 0.0, 0.0, 7.0], [0, 0, 0, 1]);
/// let report = bdpt::Dilate::new(4, 1, 1).steps(2).run(&mut texels, &mut mask)?;
/// assert_eq!((texels, mask), ([0.0, 7.0, 7.0, 7.0], [0, 1, 1, 1]));
/// assert_eq!((report.filled, report.left), (2, 1));
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Dilate {
    width: u32,
    height: u32,
    channels: u32,
    steps: u32,
}

/// What [`Dilate`] did.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DilateReport {
    /// Texels that got a value.
    pub filled: u64,
    /// Texels that had a value by the mask, but not a finite one.
    pub not_finite: u64,
    /// Texels that are still without a value.
    pub left: u64,
}

impl Dilate {
    /// Of an atlas of so many texels, 1 to 65536 along each side, with so many floats to a texel, 1 to 4096.
    pub fn new(width: u32, height: u32, channels: u32) -> Self {
        Self { width, height, channels, steps: 0 }
    }
    /// Rings of texels to fill; 4 by default. Bilinear lookups need 1, bicubic ones 2, m mipmaps 2^m, blocks of 4 x 4
    /// need 4.
    pub fn steps(mut self, steps: u32) -> Self {
        self.steps = steps;
        self
    }
    /// Fills, in place. `mask` has a byte to a texel, 0 = no value; it becomes 1 where one is filled in, and 0 where the
    /// value that was there is not finite and is not replaced.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) also for a buffer that is too small.
    pub fn run(&self, pixels: &mut [f32], mask: &mut [u8]) -> Result<DilateReport> {
        self.run_by(pixels, mask, None)
    }
    /// The same with the chart of each texel: values spread within their chart only. A texel without value that is of
    /// chart 0 takes the chart of most of its neighbours.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    pub fn run_in_charts(&self, pixels: &mut [f32], mask: &mut [u8], charts: &mut [u32]) -> Result<DilateReport> {
        self.run_by(pixels, mask, Some(charts))
    }

    fn run_by(&self, pixels: &mut [f32], mask: &mut [u8], charts: Option<&mut [u32]>) -> Result<DilateReport> {
        let (charts, charts_capacity) = match charts {
            Some(charts) => (charts.as_mut_ptr(), bytes(charts)),
            None => (null_mut(), 0),
        };
        let desc = sys::bdpt_lightmap_dilate_desc {
            width: self.width,
            height: self.height,
            channels: self.channels,
            steps: self.steps,
            pixels_capacity: bytes(pixels),
            pixels: pixels.as_mut_ptr(),
            mask_capacity: bytes(mask),
            mask: mask.as_mut_ptr(),
            charts,
            charts_capacity,
            ..Default::default()
        };
        let mut report = sys::bdpt_lightmap_dilate_report::default();
        // SAFETY: each capacity is that of its buffer, and the library refuses one that is too small.
        check(unsafe { sys::bdpt_lightmap_dilate(&desc, &mut report) })?;
        let sys::bdpt_lightmap_dilate_report { filled, not_finite, left, .. } = report;
        Ok(DilateReport { filled, not_finite, left })
    }
}
