// SPDX-License-Identifier: Apache-2.0
//! Pictures as OpenEXR.

use crate::color::{chromaticities_ptr, Chromaticities};
use crate::count::count;
use crate::error::{check, Error, Result, Text};
use crate::image::Image;
use bdpt_sys as sys;
use std::path::Path;

/// An OpenEXR file of one layer or several, all of one size.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let (picture, albedo) = (bdpt::Image::new(4, 3)?, bdpt::Image::new(4, 3)?);
/// let path = std::env::temp_dir().join(format!("bdpt-{}.exr", std::process::id()));
/// bdpt::Exr::new(&picture).layer("albedo", &albedo).half(true).write(&path)?;
/// assert!(std::fs::read(&path)?.starts_with(&[0x76, 0x2f, 0x31, 0x01]));
/// std::fs::remove_file(&path)?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Exr<'a> {
    layers: Vec<(Option<String>, &'a Image)>,
    half: bool,
    chromaticities: Option<Chromaticities>,
}

impl<'a> Exr<'a> {
    /// A file with a picture as its main layer: channels R, G and B.
    pub fn new(image: &'a Image) -> Self {
        Self { layers: vec![(None, image)], half: false, chromaticities: None }
    }
    /// One more layer: channels `name.R`, `name.G` and `name.B`.
    pub fn layer(mut self, name: impl Into<String>, image: &'a Image) -> Self {
        self.layers.push((Some(name.into()), image));
        self
    }
    /// 16-bit floats instead of 32-bit ones; finite values are clipped to ±65504.
    pub fn half(mut self, half: bool) -> Self {
        self.half = half;
        self
    }
    /// Of the pixels, written beside them; Rec. 709 by default. A film's are those of
    /// [`Context::color_info`](crate::Context::color_info).
    pub fn chromaticities(mut self, chromaticities: Chromaticities) -> Self {
        self.chromaticities = Some(chromaticities);
        self
    }
    /// Writes the file, first under another name, so that `path` holds the old file or the new one.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for layers of different sizes or the same name,
    /// [`Io`](crate::ErrorCode::Io).
    pub fn write(&self, path: impl AsRef<Path>) -> Result<()> {
        let path = Text::path(path.as_ref())?;
        let (width, height) = self.layers.first().map_or((0, 0), |(_, image)| (image.width(), image.height()));
        let names: Vec<_> = self.layers.iter().map(|(name, _)| Text::new(name)).collect::<Result<_>>()?;
        let mut layers = Vec::new();
        for (name, (text, image)) in names.iter().zip(&self.layers) {
            let (w, h) = (image.width(), image.height());
            if (w, h) != (width, height) {
                let text = text.as_deref().unwrap_or_default();
                return Err(Error::refused(format!("layer {text:?} is {w} x {h}, the first is {width} x {height}")));
            }
            layers.push(sys::bdpt_image_layer { name: name.as_ptr(), pixels: image.as_floats().as_ptr() });
        }
        let chromaticities = self.chromaticities.map(|chromaticities| chromaticities.raw());
        let desc = sys::bdpt_exr_desc {
            width,
            height,
            layer_count: count(layers.len(), "layers")?,
            layers: layers.as_ptr(),
            half: self.half.into(),
            chromaticities: chromaticities_ptr(&chromaticities),
            ..Default::default()
        };
        // SAFETY: texts and pictures live until the call returns, and all layers have the size that desc tells.
        check(unsafe { sys::bdpt_image_write_exr(path.as_ptr(), &desc) })
    }
}
