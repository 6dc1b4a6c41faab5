// SPDX-License-Identifier: Apache-2.0
//! Seams between the charts of lightmaps.

use crate::count::{array, bytes, count};
use crate::error::{check, Result};
use crate::uv::{RawInstances, UvInstance};
use bdpt_sys as sys;

/// Makes the two sides of every seam agree, within and between meshes, instances and atlases. Only texels that bilinear
/// lookups along seams read change.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{AtlasImage, FixSeams, UvInstance};
/// // Two triangles that share an edge in the world, and lie apart in the atlas.
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let uv = [[0.05, 0.1], [0.4, 0.1], [0.05, 0.9], [0.95, 0.1], [0.95, 0.9], [0.6, 0.9]];
/// let mut texels: Vec<f32> = (0..32 * 32).map(|i| if i % 32 < 16 { 1.0 } else { 2.0 }).collect();
/// let atlas = AtlasImage::new(32, 32, &mut texels);
/// let report = FixSeams::new(1).run(&[UvInstance::new(&positions, &uv)], &mut [atlas])?;
/// assert_eq!(report.seams, 1);
/// assert!(report.error_before > 0.99 && report.error_after < 0.05);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FixSeams {
    channels: u32,
    position_tolerance: f32,
    angle: f32,
    lambda: f32,
    max_iterations: u32,
}

/// An atlas' pixels. Two atlases cannot share them:
///
/// ```compile_fail,E0499
/// let mut texels = vec![0.0; 64];
/// let images = [bdpt::AtlasImage::new(8, 8, &mut texels), bdpt::AtlasImage::new(8, 8, &mut texels)];
/// ```
#[derive(Debug)]
pub struct AtlasImage<'a> {
    width: u32,
    height: u32,
    pixels: &'a mut [f32],
    mask: Option<&'a [u8]>,
}

impl<'a> AtlasImage<'a> {
    /// Texels in rows, 1 to 65536 along each side, and at most 2^28 together.
    pub fn new(width: u32, height: u32, pixels: &'a mut [f32]) -> Self {
        Self { width, height, pixels, mask: None }
    }
    /// A byte to a texel: 0 = it has no value. All have one by default.
    pub fn mask(mut self, mask: &'a [u8]) -> Self {
        self.mask = Some(mask);
        self
    }
}

/// What [`FixSeams`] did.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamsReport {
    /// The most that a channel took.
    pub iterations: u32,
    /// Edges that are one in the world and two in the atlas.
    pub seams: u64,
    /// Points along them where both sides were compared.
    pub samples: u64,
    /// Points left out: outside the atlas, or beside a texel without a value: [dilate](crate::Dilate) first.
    pub samples_skipped: u64,
    /// Texels near seams that have a value by the mask, but not a finite one.
    pub not_finite: u64,
    /// Texels that were free to change.
    pub texels: u64,
    /// Root of the mean square difference of the two sides before.
    pub error_before: f64,
    /// The same after.
    pub error_after: f64,
    /// Whether all channels were done before the most iterations were reached; what they had is kept.
    pub converged: bool,
}

impl FixSeams {
    /// Of atlases with so many floats to a texel, 1 to 4096.
    pub fn new(channels: u32) -> Self {
        Self { channels, position_tolerance: 0.0, angle: 0.0, lambda: 0.0, max_iterations: 0 }
    }
    /// World units along each axis within which two corners are one; by default 1/100000 of the diagonal of all.
    pub fn position_tolerance(mut self, distance: f32) -> Self {
        self.position_tolerance = distance;
        self
    }
    /// Normals of both sides that differ by more leave the edge as it is, in degrees; 15 by default.
    pub fn angle(mut self, degrees: f32) -> Self {
        self.angle = degrees;
        self
    }
    /// How much texels resist: the less, the closer the two sides get, above 0 to 1e6; 0.01 by default.
    pub fn lambda(mut self, lambda: f32) -> Self {
        self.lambda = lambda;
        self
    }
    /// The most conjugate gradients for each channel; 1000 by default.
    pub fn max_iterations(mut self, iterations: u32) -> Self {
        self.max_iterations = iterations;
        self
    }
    /// Changes the images, which instances name by their atlas, in place.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) also for a buffer that is too small.
    pub fn run(&self, instances: &[UvInstance<'_>], images: &mut [AtlasImage<'_>]) -> Result<SeamsReport> {
        let instances = RawInstances::new(instances);
        let images = images.iter_mut().map(|image| sys::bdpt_lightmap_image {
            capacity: bytes(image.pixels),
            pixels: image.pixels.as_mut_ptr(),
            mask: image.mask.map_or(std::ptr::null(), |mask| mask.as_ptr()),
            mask_capacity: image.mask.map_or(0, bytes),
            width: image.width,
            height: image.height,
        });
        let images: Vec<_> = images.collect();
        let desc = sys::bdpt_lightmap_seams_desc {
            instance_count: count(instances.len(), "instances")?,
            instances: instances.as_ptr(),
            image_count: count(images.len(), "images")?,
            images: array(&images),
            channels: self.channels,
            position_tolerance: self.position_tolerance,
            angle: self.angle,
            lambda: self.lambda,
            max_iterations: self.max_iterations,
            ..Default::default()
        };
        let mut raw = sys::bdpt_lightmap_seams_report::default();
        // SAFETY: what the descriptions point to lives until the call returns; each capacity is that of its buffer, and
        // no two images share one, for each is borrowed to be written.
        check(unsafe { sys::bdpt_lightmap_fix_seams(&desc, &mut raw) })?;
        Ok(SeamsReport {
            iterations: raw.iterations,
            seams: raw.seams,
            samples: raw.samples,
            samples_skipped: raw.samples_skipped,
            not_finite: raw.not_finite,
            texels: raw.texels,
            error_before: raw.error_before,
            error_after: raw.error_after,
            converged: raw.converged != 0,
        })
    }
}
