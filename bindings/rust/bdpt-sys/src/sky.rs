// SPDX-License-Identifier: Apache-2.0

//! Sky

use crate::*;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_sky_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub turbidity: f32,
    pub to_sun: [f32; 3],
    pub ground: [f32; 3],
}
sized!(bdpt_sky_desc);

extern "C" {
    /// Fills a picture for the texture of an environment with a clear sky, without its sun, +y up: 3 floats a pixel,
    /// linear Rec. 709.
    pub fn bdpt_sky_fill(desc: *const bdpt_sky_desc, pixels: *mut f32, capacity: u64) -> bdpt_result;
}
