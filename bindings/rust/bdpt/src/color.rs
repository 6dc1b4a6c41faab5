// SPDX-License-Identifier: Apache-2.0
//! What colours mean, and their conversion.

use crate::context::Context;
use crate::error::{owned, Result, Text};
use crate::image::floats_mut;
use crate::panics::call;
use bdpt_sys as sys;
use std::ptr::null;

/// Where red, green, blue and white of a linear RGB space are: CIE 1931 xy.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::Chromaticities;
/// let mut green = [[0.0, 1.0, 0.0]];
/// Chromaticities::REC2020.convert(&Chromaticities::REC709, &mut green)?;
/// // The green of Rec. 2020 is out of reach of Rec. 709: nothing is clipped.
/// assert!(green[0][0] < 0.0 && green[0][1] > 1.0);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chromaticities {
    /// Of (1, 0, 0).
    pub red: [f32; 2],
    /// Of (0, 1, 0).
    pub green: [f32; 2],
    /// Of (0, 0, 1).
    pub blue: [f32; 2],
    /// Of (1, 1, 1), inside the triangle of the others.
    pub white: [f32; 2],
}

impl Chromaticities {
    /// Of Rec. 709, and of sRGB.
    pub const REC709: Self = Self { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
    /// Of Rec. 2020.
    pub const REC2020: Self =
        Self { red: [0.708, 0.292], green: [0.17, 0.797], blue: [0.131, 0.046], white: [0.3127, 0.329] };
    /// Of ACEScg.
    pub const ACESCG: Self =
        Self { red: [0.713, 0.293], green: [0.165, 0.83], blue: [0.128, 0.044], white: [0.32168, 0.33767] };

    /// Converts linear colours of these primaries to those of `to`, in place. White stays white (Bradford). What the
    /// target's primaries cannot mix becomes negative in some channel: nothing is clipped.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for primaries on a line, or white outside of them.
    pub fn convert(&self, to: &Self, colors: &mut [[f32; 3]]) -> Result<()> {
        let (from, to, count) = (self.raw(), to.raw(), colors.len() as u64);
        let rgb = floats_mut(colors).as_mut_ptr();
        // SAFETY: rgb is 3 * count floats.
        crate::error::check(unsafe { sys::bdpt_color_convert_chromaticities(&from, &to, rgb, count) })
    }
    pub(crate) fn raw(&self) -> sys::bdpt_chromaticities {
        sys::bdpt_chromaticities { red: self.red, green: self.green, blue: self.blue, white: self.white }
    }
}

/// What the numbers of a context's rendering space mean.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub struct ColorInfo {
    /// The rendering space's name, as it was given.
    pub rendering_space: String,
    /// Its primaries; write them beside pictures in it.
    pub chromaticities: Chromaticities,
    /// Luminance is the product of this with a colour.
    pub luminance: [f32; 3],
}

/// Colours.
impl Context {
    /// What the numbers of the rendering space mean.
    ///
    /// ```
    /// # fn main() -> bdpt::Result<()> {
    /// let context = bdpt::ContextOptions::default().rendering_space("ACEScg").create()?;
    /// let info = context.color_info()?;
    /// assert_eq!(info.rendering_space, "ACEScg");
    /// assert_eq!(info.chromaticities, bdpt::Chromaticities::ACESCG);
    /// # Ok(()) }
    /// ```
    pub fn color_info(&self) -> Result<ColorInfo> {
        let mut info = sys::bdpt_color_info::default();
        // SAFETY: the context is alive, and the struct has its size set.
        call(self.panics(), || unsafe { sys::bdpt_color_get_info(self.as_ptr(), &mut info) })?;
        let sys::bdpt_chromaticities { red, green, blue, white } = info.chromaticities;
        Ok(ColorInfo {
            // SAFETY: the name is the context's.
            rendering_space: unsafe { owned(info.rendering_space) },
            chromaticities: Chromaticities { red, green, blue, white },
            luminance: info.luminance,
        })
    }

    /// Converts colours from one space to another, both by name, in place; `None` is the rendering space.
    ///
    /// These names need no configuration, in any case of letters: `"Linear Rec.709 (sRGB)"`, `"sRGB - Texture"`,
    /// `"ACEScg"`, `"ACES2065-1"`, `"Linear Rec.2020"`, `"Linear P3-D65"` and `"Raw"`.
    ///
    /// ```
    /// # fn main() -> bdpt::Result<()> {
    /// let context = bdpt::Context::new()?;
    /// let mut colors = [[0.5, 0.5, 0.5]];
    /// context.convert_colors(Some("sRGB - Texture"), None, &mut colors)?;
    /// assert!((colors[0][0] - 0.2140).abs() < 1e-4);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for a name that is unknown, or where nothing leads from
    /// one space to the other; [`Io`](crate::ErrorCode::Io) when a table of the configuration is missing.
    pub fn convert_colors(&self, from: Option<&str>, to: Option<&str>, colors: &mut [[f32; 3]]) -> Result<()> {
        let (from, to) = (Text::new(&from.map(String::from))?, Text::new(&to.map(String::from))?);
        let count = colors.len() as u64;
        let rgb = floats_mut(colors).as_mut_ptr();
        call(self.panics(), || {
            // SAFETY: the context is alive, the texts end with zeros, rgb is 3 * count floats.
            unsafe { sys::bdpt_color_convert(self.as_ptr(), from.as_ptr(), to.as_ptr(), rgb, count) }
        })
    }
}

/// NULL where there are none.
pub(crate) fn chromaticities_ptr(raw: &Option<sys::bdpt_chromaticities>) -> *const sys::bdpt_chromaticities {
    raw.as_ref().map_or(null(), |raw| raw)
}
