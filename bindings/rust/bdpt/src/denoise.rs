// SPDX-License-Identifier: Apache-2.0
//! Removing noise, by Open Image Denoise where it is there.

use crate::error::{check, Error, Result};
use crate::image::Image;
use bdpt_sys as sys;
use std::ptr::null;

/// Whether Open Image Denoise is there at run time; the first call looks for it.
pub fn has_denoiser() -> bool {
    // SAFETY: no conditions.
    unsafe { sys::bdpt_has_denoiser() != 0 }
}

/// Removes the noise of a picture, on the processor. What it makes is a guess: biased, and pleasing.
///
/// It takes neighbouring pixels' noise for independent, which a filter wider than a pixel makes untrue: feed it outputs
/// that are [`unfiltered`](crate::Output::unfiltered), or those of a film with the box filter of half a pixel.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let picture = bdpt::Image::from_pixels(16, 16, vec![[0.5; 3]; 256])?;
/// let albedo = bdpt::Image::from_pixels(16, 16, vec![[0.8; 3]; 256])?;
/// match bdpt::Denoise::new(&picture).albedo(&albedo).run() {
///     Ok(clean) => assert!((clean.pixels()[0][0] - 0.5).abs() < 0.1),
///     Err(error) => assert_eq!(error.code(), bdpt::ErrorCode::Unsupported), // not installed
/// }
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Denoise<'a> {
    color: &'a Image,
    albedo: Option<&'a Image>,
    normal: Option<&'a Image>,
    clean: bool,
    threads: u32,
}

impl<'a> Denoise<'a> {
    /// Of a picture of linear radiance, of any range; as [`OutputKind::Radiance`](crate::OutputKind::Radiance).
    pub fn new(color: &'a Image) -> Self {
        Self { color, albedo: None, normal: None, clean: false, threads: 0 }
    }
    /// With the albedo of what is seen; as [`OutputKind::Albedo`](crate::OutputKind::Albedo).
    pub fn albedo(mut self, albedo: &'a Image) -> Self {
        self.albedo = Some(albedo);
        self
    }
    /// With normals, which need albedo, too; as [`OutputKind::Normal`](crate::OutputKind::Normal).
    pub fn normal(mut self, normal: &'a Image) -> Self {
        self.normal = Some(normal);
        self
    }
    /// Albedo and normal are free of noise: every detail of them is kept.
    pub fn clean(mut self, clean: bool) -> Self {
        self.clean = clean;
        self
    }
    /// The denoiser's own threads; 0 = one per core.
    pub fn threads(mut self, threads: u32) -> Self {
        self.threads = threads;
        self
    }
    /// The picture without noise.
    ///
    /// # Errors
    /// [`Unsupported`](crate::ErrorCode::Unsupported) where Open Image Denoise is not there, or too old;
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for pictures of different sizes, and normals without albedo.
    pub fn run(&self) -> Result<Image> {
        let (width, height) = (self.color.width(), self.color.height());
        for (name, image) in [("albedo", self.albedo), ("normal", self.normal)] {
            if image.map_or(false, |image| (image.width(), image.height()) != (width, height)) {
                return Err(Error::refused(format!("{name} has another size than the picture's {width} x {height}")));
            }
        }
        let pixels = |image: Option<&Image>| image.map_or(null(), |image| image.as_floats().as_ptr());
        let mut output = Image::new(width, height)?;
        let desc = sys::bdpt_denoise_desc {
            width,
            height,
            clean: self.clean.into(),
            color: pixels(Some(self.color)),
            albedo: pixels(self.albedo),
            normal: pixels(self.normal),
            output: output.as_floats_mut().as_mut_ptr(),
            threads: self.threads,
            ..Default::default()
        };
        // SAFETY: all pictures have the size that desc tells, and live until the call returns.
        check(unsafe { sys::bdpt_denoise(&desc) })?;
        Ok(output)
    }
}
