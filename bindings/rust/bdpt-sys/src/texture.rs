// SPDX-License-Identifier: Apache-2.0

//! Image textures

use crate::*;
use std::os::raw::{c_char, c_void};

pub type bdpt_texel = i32;

/// 255 is 1
pub const BDPT_TEXEL_UINT8: bdpt_texel = 0;
pub const BDPT_TEXEL_FLOAT: bdpt_texel = 1;

/// 65535 is 1
pub const BDPT_TEXEL_UINT16: bdpt_texel = 2;
pub const BDPT_TEXEL_HALF: bdpt_texel = 3;

pub type bdpt_encoding = i32;

/// texels, but for alpha, are decoded by the sRGB curve
pub const BDPT_ENCODING_SRGB: bdpt_encoding = 0;
pub const BDPT_ENCODING_LINEAR: bdpt_encoding = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_texture_desc {
    pub struct_size: u32,
    pub channels: u32,
    pub label: *const c_char,
    pub pixels: *const c_void,
    pub width: u32,
    pub height: u32,
    pub row_stride: u64,
    pub texel: bdpt_texel,
    pub encoding: bdpt_encoding,
    pub mip_levels: u32,
    pub reserved: u32,
    pub color_space: *const c_char,
}
sized!(bdpt_texture_desc);

extern "C" {
    /// Adds an image texture.
    pub fn bdpt_texture_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_texture_desc,
        texture: *mut bdpt_texture_id,
    ) -> bdpt_result;

    /// Removes a texture that no material or light uses.
    pub fn bdpt_texture_remove(builder: *mut bdpt_builder, texture: bdpt_texture_id) -> bdpt_result;
}
