// SPDX-License-Identifier: Apache-2.0
//! Exposure as photographers know it.

use crate::error::{check, Result};
use bdpt_sys as sys;

/// How a photographer exposes: for pictures whose numbers are luminances in candela per square metre. Films hold
/// radiance, whatever the exposure; it is for [`Display::exposure`](crate::Display::exposure).
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::Exposure;
/// let sunny = Exposure::camera(1.0 / 100.0, 16.0).stops()?;
/// let faster = Exposure::camera(1.0 / 100.0, 16.0).iso(200.0).stops()?;
/// assert!((faster - sunny - 1.0).abs() < 1e-4);
/// assert!((Exposure::ev100(14.6439).stops()? - sunny).abs() < 1e-3);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Exposure {
    raw: sys::bdpt_exposure_desc,
}

impl Exposure {
    /// By a camera's settings at ISO 100: the shutter's time in seconds, 1e-7 to 1e7, and the f-number, 0.1 to 1000.
    pub fn camera(shutter_time: f32, f_number: f32) -> Self {
        Self { raw: sys::bdpt_exposure_desc { shutter_time, f_number, ..Default::default() } }
    }
    /// By the exposure value at ISO 100, -64 to 64.
    pub fn ev100(ev100: f32) -> Self {
        Self { raw: sys::bdpt_exposure_desc { ev100, ..Default::default() } }
    }
    /// The film's speed, 1 to 1e7. Not with an exposure value.
    pub fn iso(mut self, iso: f32) -> Self {
        self.raw.iso = iso;
        self
    }
    /// By how many powers of two to multiply a picture.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for what is out of range.
    pub fn stops(&self) -> Result<f32> {
        let mut stops = 0.0;
        // SAFETY: the struct has its size set, and stops is writable.
        check(unsafe { sys::bdpt_exposure_stops(&self.raw, &mut stops) })?;
        Ok(stops)
    }
}
