// SPDX-License-Identifier: Apache-2.0

//! Images: display transform and files. These need no context.

use crate::*;
use std::os::raw::c_char;

pub type bdpt_view = i32;

/// the sRGB curve, clipped: what numbers look like
pub const BDPT_VIEW_SRGB: bdpt_view = 0;

/// ACES 1.0 SDR video output transform: highlights roll off
pub const BDPT_VIEW_ACES: bdpt_view = 1;

/// a display and view of a configuration file
pub const BDPT_VIEW_OCIO: bdpt_view = 2;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_display_desc {
    pub struct_size: u32,
    pub view: bdpt_view,
    pub exposure: f32,
    pub reserved: u32,
    pub config: *const c_char,
    pub color_space: *const c_char,
    pub display: *const c_char,
    pub ocio_view: *const c_char,
    pub context: *const bdpt_context,
}
sized!(bdpt_display_desc);

/// How a photographer exposes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_exposure_desc {
    pub struct_size: u32,
    pub iso: f32,
    pub shutter_time: f32,
    pub f_number: f32,
    pub ev100: f32,
    pub reserved: u32,
}
sized!(bdpt_exposure_desc);

/// Images of 3 floats to a pixel, packed, row 0 the top.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_denoise_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub clean: u32,
    pub color: *const f32,
    pub albedo: *const f32,
    pub normal: *const f32,
    pub output: *mut f32,
    pub threads: u32,
    pub reserved: u32,
}
sized!(bdpt_denoise_desc);

/// One layer of an image file: 3 floats to a pixel, packed, row 0 the top.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_image_layer {
    pub name: *const c_char,
    pub pixels: *const f32,
}
zeroed!(bdpt_image_layer);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_exr_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub layer_count: u32,
    pub layers: *const bdpt_image_layer,
    pub half: u32,
    pub layer_stride: u32,
    pub chromaticities: *const bdpt_chromaticities,
}
sized!(bdpt_exr_desc);

extern "C" {
    /// Turns linear pixels (3 floats each, packed) into display values in \[0,1\], in place, by OpenColorIO.
    pub fn bdpt_image_display(desc: *const bdpt_display_desc, pixels: *mut f32, width: u32, height: u32)
        -> bdpt_result;

    /// The exposure for bdpt_display_desc.exposure, in stops: for pictures whose numbers are luminances in candela per
    /// square metre (lights in lux, candela or nit).
    pub fn bdpt_exposure_stops(desc: *const bdpt_exposure_desc, stops: *mut f32) -> bdpt_result;

    /// Whether it is there: 1 or 0; the first call looks for it.
    pub fn bdpt_has_denoiser() -> i32;

    /// Removes the noise of a picture, on the processor.
    pub fn bdpt_denoise(desc: *const bdpt_denoise_desc) -> bdpt_result;

    /// Writes an OpenEXR file (scanlines, ZIP), first under another name, so that path holds the old file or the new
    /// one.
    pub fn bdpt_image_write_exr(path: *const c_char, desc: *const bdpt_exr_desc) -> bdpt_result;

    /// Writes display values as an 8-bit PNG, in the same safe way.
    pub fn bdpt_image_write_png(path: *const c_char, pixels: *const f32, width: u32, height: u32) -> bdpt_result;
}
