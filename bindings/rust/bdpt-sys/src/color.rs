// SPDX-License-Identifier: Apache-2.0

//! Colour

use crate::*;
use std::os::raw::c_char;

/// CIE 1931 xy.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_chromaticities {
    pub red: [f32; 2],
    pub green: [f32; 2],
    pub blue: [f32; 2],
    pub white: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_color_info {
    pub struct_size: u32,
    pub reserved: u32,
    pub rendering_space: *const c_char,
    pub chromaticities: bdpt_chromaticities,
    pub luminance: [f32; 3],
    pub reserved2: u32,
}
sized!(bdpt_color_info);

extern "C" {
    /// Tells what the numbers of the rendering space mean.
    pub fn bdpt_color_get_info(context: *const bdpt_context, info: *mut bdpt_color_info) -> bdpt_result;

    /// Converts count colours of 3 floats, packed, in place.
    pub fn bdpt_color_convert(
        context: *const bdpt_context,
        from: *const c_char,
        to: *const c_char,
        rgb: *mut f32,
        count: u64,
    ) -> bdpt_result;

    /// The same for linear RGB of any primaries, such as an OpenEXR file names; NULL = Rec. 709.
    pub fn bdpt_color_convert_chromaticities(
        from: *const bdpt_chromaticities,
        to: *const bdpt_chromaticities,
        rgb: *mut f32,
        count: u64,
    ) -> bdpt_result;
}
