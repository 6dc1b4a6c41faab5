// SPDX-License-Identifier: Apache-2.0
//! From linear pixels to what a screen shows.

use crate::context::Context;
use crate::error::{check, Result, Text};
use crate::image::Image;
use crate::panics::{call, Panics};
use bdpt_sys as sys;
use std::path::PathBuf;
use std::ptr::null;

/// How linear pixels become display values in \[0, 1\].
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let mut image = bdpt::Image::from_pixels(2, 1, vec![[0.18; 3], [20.0; 3]])?;
/// bdpt::Display::srgb().exposure(1.0).apply(&mut image)?;
/// assert!((image.pixels()[0][0] - 0.634).abs() < 1e-3);
/// assert_eq!(image.pixels()[1], [1.0; 3]);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Display {
    view: sys::bdpt_view,
    exposure: f32,
    context: Option<Context>,
    config: Option<PathBuf>,
    color_space: Option<String>,
    display: Option<String>,
    ocio_view: Option<String>,
}

impl Display {
    /// The sRGB curve, clipped: what numbers look like.
    pub fn srgb() -> Self {
        Self { view: sys::BDPT_VIEW_SRGB, ..Self::default() }
    }
    /// ACES 1.0 SDR video: highlights roll off.
    pub fn aces() -> Self {
        Self { view: sys::BDPT_VIEW_ACES, ..Self::default() }
    }
    /// A display and view of an OpenColorIO configuration: that of the [`context`](Self::context), or another
    /// [`config`](Self::config).
    pub fn ocio() -> Self {
        Self { view: sys::BDPT_VIEW_OCIO, ..Self::default() }
    }
    /// In stops: the pixels are multiplied by two to this power first.
    pub fn exposure(mut self, stops: f32) -> Self {
        self.exposure = stops;
        self
    }
    /// Whose rendering space the pixels are in; without one, linear Rec. 709.
    pub fn context(mut self, context: &Context) -> Self {
        self.context = Some(context.clone());
        self
    }
    /// A configuration's path.
    pub fn config(mut self, path: impl Into<PathBuf>) -> Self {
        self.config = Some(path.into());
        self
    }
    /// The pixels' colour space, by a name of the configuration.
    pub fn color_space(mut self, name: impl Into<String>) -> Self {
        self.color_space = Some(name.into());
        self
    }
    /// The configuration's display; its default without.
    pub fn display(mut self, name: impl Into<String>) -> Self {
        self.display = Some(name.into());
        self
    }
    /// The display's view; its default without.
    pub fn view(mut self, name: impl Into<String>) -> Self {
        self.ocio_view = Some(name.into());
        self
    }
    /// Turns a picture into display values, in place. What is not a number counts as 0.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) also for names that the configuration does not have,
    /// [`Io`](crate::ErrorCode::Io) and [`Format`](crate::ErrorCode::Format) for a configuration that is missing or
    /// damaged.
    pub fn apply(&self, image: &mut Image) -> Result<()> {
        let config = self.config.as_deref().map(Text::path).transpose()?;
        let names = [&self.color_space, &self.display, &self.ocio_view].map(Text::new);
        let [color_space, display, ocio_view] = names;
        let (color_space, display, ocio_view) = (color_space?, display?, ocio_view?);
        let desc = sys::bdpt_display_desc {
            view: self.view,
            exposure: self.exposure,
            config: config.as_ref().map_or(null(), Text::as_ptr),
            color_space: color_space.as_ptr(),
            display: display.as_ptr(),
            ocio_view: ocio_view.as_ptr(),
            context: self.context.as_ref().map_or(null(), |context| context.as_ptr()),
            ..Default::default()
        };
        let (width, height) = (image.width(), image.height());
        let pixels = image.as_floats_mut().as_mut_ptr();
        // SAFETY: texts and context live until the call returns, and pixels are those of the picture.
        let run = || unsafe { sys::bdpt_image_display(&desc, pixels, width, height) };
        match &self.context {
            Some(context) => call(context.panics(), run),
            None => call(&Panics::default(), run),
        }
    }
}

/// Pictures as PNG.
impl Image {
    /// Writes display values as an 8-bit PNG, first under another name, so that `path` holds the old file or the new one.
    /// Values are clipped to \[0, 1\] and rounded; see [`Display`](crate::Display).
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut image = bdpt::Image::from_pixels(1, 1, vec![[0.2, 0.4, 0.6]])?;
    /// bdpt::Display::srgb().apply(&mut image)?;
    /// let path = std::env::temp_dir().join(format!("bdpt-{}.png", std::process::id()));
    /// image.write_png(&path)?;
    /// assert!(std::fs::read(&path)?.starts_with(b"\x89PNG"));
    /// std::fs::remove_file(&path)?;
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`Io`](crate::ErrorCode::Io), and [`InvalidArgument`](crate::ErrorCode::InvalidArgument) also for a value that is
    /// not a number.
    pub fn write_png(&self, path: impl AsRef<std::path::Path>) -> Result<()> {
        let path = Text::path(path.as_ref())?;
        let pixels = self.as_floats().as_ptr();
        // SAFETY: pixels are those of the picture, the path ends with a zero.
        check(unsafe { sys::bdpt_image_write_png(path.as_ptr(), pixels, self.width(), self.height()) })
    }
}
