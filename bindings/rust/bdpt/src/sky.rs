// SPDX-License-Identifier: Apache-2.0
//! A clear sky as a picture.

use crate::error::{check, Result};
use crate::image::Image;
use bdpt_sys as sys;

/// A clear sky without its sun, as the picture of an environment light, +y up. Luminance is in kcd/m²; the colours are
/// linear Rec. 709. After Preetham, Shirley and Smits (1999).
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let sky = bdpt::Sky::new([0.3, 0.5, -1.0]).turbidity(2.5).ground([0.1; 3]).fill(64, 32)?;
/// let (zenith, below) = (sky.pixel(32, 0).unwrap(), sky.pixel(32, 31).unwrap());
/// assert!(zenith[2] > zenith[0] && below == [0.1; 3]);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    raw: sys::bdpt_sky_desc,
}

impl Sky {
    /// A sky by the direction to its sun, of any length but zero, not below the horizon.
    pub fn new(to_sun: [f32; 3]) -> Self {
        Self { raw: sys::bdpt_sky_desc { to_sun, ..Default::default() } }
    }
    /// Of haze, 1.7 to 10: 2 is very clear, 6 hazy; 3 by default.
    pub fn turbidity(mut self, turbidity: f32) -> Self {
        self.raw.turbidity = turbidity;
        self
    }
    /// What stands below the horizon; black by default.
    pub fn ground(mut self, ground: [f32; 3]) -> Self {
        self.raw.ground = ground;
        self
    }
    /// The picture, by longitude and latitude: the middle is -z, the top edge +y.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for a size beyond 1 to 65536, and for what is out of range.
    pub fn fill(&self, width: u32, height: u32) -> Result<Image> {
        let mut image = Image::new(width, height)?;
        let desc = sys::bdpt_sky_desc { width, height, ..self.raw };
        let pixels = image.as_floats_mut();
        // SAFETY: pixels has room for its length, which is told in floats.
        check(unsafe { sys::bdpt_sky_fill(&desc, pixels.as_mut_ptr(), pixels.len() as u64) })?;
        Ok(image)
    }
}
