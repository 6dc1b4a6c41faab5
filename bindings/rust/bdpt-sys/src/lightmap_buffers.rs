// SPDX-License-Identifier: Apache-2.0

//! Lightmaps: work on buffers. These need no context.

use crate::*;
use std::os::raw::c_void;

/// A mesh in the world and in an atlas.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_uv_instance {
    pub mesh: *const bdpt_mesh_desc,
    pub transform: [f32; 12],
    pub uv_scale: [f32; 2],
    pub uv_offset: [f32; 2],
    pub atlas: u32,
    pub reserved: u32,
}
zeroed!(bdpt_uv_instance);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_uv_check_desc {
    pub struct_size: u32,
    pub instance_count: u32,
    pub instances: *const bdpt_uv_instance,
    pub instance_stride: u32,
    pub atlas: u32,
    pub width: u32,
    pub height: u32,
    pub padding_reach: u32,
    pub reserved: u32,
    pub max_overlaps: u64,
}
sized!(bdpt_uv_check_desc);

/// Where bdpt_uv_check leaves its maps; each buffer may be NULL.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_uv_maps {
    pub struct_size: u32,
    pub reserved: u32,
    pub triangle_charts: *mut u32,
    pub triangle_charts_capacity: u64,
    pub texel_charts: *mut u32,
    pub texel_charts_capacity: u64,
    pub texel_claims: *mut u32,
    pub texel_claims_capacity: u64,
    pub texel_overlaps: *mut u32,
    pub texel_overlaps_capacity: u64,
}
sized!(bdpt_uv_maps);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_uv_report {
    pub struct_size: u32,
    pub padding: i32,
    pub triangles: u64,
    pub charts: u64,
    pub outside_rect: u64,
    pub outside_atlas: u64,
    pub zero_area_uv: u64,
    pub zero_area_world: u64,
    pub mirrored: u64,
    pub texels_claimed: u64,
    pub texels_shared: u64,
    pub overlaps_within: u64,
    pub overlaps_between: u64,
    pub overlap_area_within: f64,
    pub overlap_area_between: f64,
    pub density_min: f32,
    pub density_mean: f32,
    pub density_max: f32,
    pub overlaps_cut: u32,
}
sized!(bdpt_uv_report);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_dilate_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub channels: u32,
    pub steps: u32,
    pub reserved: u32,
    pub pixels: *mut f32,
    pub pixels_capacity: u64,
    pub mask: *mut u8,
    pub mask_capacity: u64,
    pub charts: *mut u32,
    pub charts_capacity: u64,
}
sized!(bdpt_lightmap_dilate_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_dilate_report {
    pub struct_size: u32,
    pub reserved: u32,
    pub filled: u64,
    pub not_finite: u64,
    pub left: u64,
}
sized!(bdpt_lightmap_dilate_report);

/// An atlas' pixels.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_image {
    pub pixels: *mut f32,
    pub capacity: u64,
    pub mask: *const u8,
    pub mask_capacity: u64,
    pub width: u32,
    pub height: u32,
}
zeroed!(bdpt_lightmap_image);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_seams_desc {
    pub struct_size: u32,
    pub instance_count: u32,
    pub instances: *const bdpt_uv_instance,
    pub instance_stride: u32,
    pub image_count: u32,
    pub images: *const bdpt_lightmap_image,
    pub image_stride: u32,
    pub channels: u32,
    pub position_tolerance: f32,
    pub angle: f32,
    pub lambda: f32,
    pub max_iterations: u32,
}
sized!(bdpt_lightmap_seams_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_seams_report {
    pub struct_size: u32,
    pub iterations: u32,
    pub seams: u64,
    pub samples: u64,
    pub samples_skipped: u64,
    pub not_finite: u64,
    pub texels: u64,
    pub error_before: f64,
    pub error_after: f64,
    pub converged: u32,
    pub reserved: u32,
}
sized!(bdpt_lightmap_seams_report);

/// Encodings, each of a texel: HALF channels 16-bit floats, rounded to nearest; clipped to +-65504 RGBM 4 bytes R, G,
/// B, M of an RGB colour: range M/255 (R, G, B)/255; clipped to \[0, range\], of which each channel keeps an error of
/// at most 1/510 of range M/255 RGBD 4 bytes R, G, B, D of an RGB colour, D at least 1: range/D (R, G, B)/255; clipped
/// to \[0, range\]; an error of at most 1/510 of range/D, so of 1/255 of the largest channel where that is at least
/// range/255 The others take coefficients c of spherical harmonics, RGB each, in the order 1; y, z, x; xy, yz, 3z²-1,
/// xz, x²-y² with the factors 0.282095; 0.488603; 1.092548, 1.092548, 0.315392, 1.092548, 0.546274.
pub type bdpt_lightmap_encoding = i32;
pub const BDPT_LIGHTMAP_ENCODING_HALF: bdpt_lightmap_encoding = 0;
pub const BDPT_LIGHTMAP_ENCODING_RGBM: bdpt_lightmap_encoding = 1;
pub const BDPT_LIGHTMAP_ENCODING_RGBD: bdpt_lightmap_encoding = 2;
pub const BDPT_LIGHTMAP_ENCODING_DOMINANT: bdpt_lightmap_encoding = 3;
pub const BDPT_LIGHTMAP_ENCODING_MONO_SH: bdpt_lightmap_encoding = 4;
pub const BDPT_LIGHTMAP_ENCODING_H4: bdpt_lightmap_encoding = 5;
pub const BDPT_LIGHTMAP_ENCODING_H6: bdpt_lightmap_encoding = 6;

pub type bdpt_sh = i32;

/// c_lm = integral of L Y_lm over directions; E(n) = sum A_l c_lm Y_lm(n) with A = pi, 2pi/3, pi/4
pub const BDPT_SH_RADIANCE: bdpt_sh = 0;

/// those times A_l: E(n) = sum c_lm Y_lm(n)
pub const BDPT_SH_IRRADIANCE: bdpt_sh = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_encode_desc {
    pub struct_size: u32,
    pub encoding: bdpt_lightmap_encoding,
    pub sh: bdpt_sh,
    pub channels: u32,
    pub texels: u64,
    pub pixels: *const f32,
    pub pixels_capacity: u64,
    pub texel_stride: u64,
    pub plane_stride: u64,
    pub encoded: *mut c_void,
    pub encoded_capacity: u64,
    pub range: f32,
    pub reserved: u32,
}
sized!(bdpt_lightmap_encode_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_encode_report {
    pub struct_size: u32,
    pub reserved: u32,
    pub clipped: u64,
    pub not_finite: u64,
}
sized!(bdpt_lightmap_encode_report);

extern "C" {
    /// Tells what is wrong with the lightmap coordinates of an atlas, and what they are like.
    pub fn bdpt_uv_check(
        desc: *const bdpt_uv_check_desc,
        maps: *const bdpt_uv_maps,
        report: *mut bdpt_uv_report,
    ) -> bdpt_result;

    /// Fills gutters, in place: in each step every texel without a value that has neighbours with one, among the eight
    /// round it, takes their mean in every channel.
    pub fn bdpt_lightmap_dilate(
        desc: *const bdpt_lightmap_dilate_desc,
        report: *mut bdpt_lightmap_dilate_report,
    ) -> bdpt_result;

    /// Makes the two sides of every seam agree, within and between meshes, instances and atlases, in place: the texels
    /// T that bilinear lookups along seams read minimise sum w (B_a T - B_b T)² + lambda |T - T_0|² over samples half a
    /// texel apart, w being the length they stand for in texels, B_a T and B_b T the lookups on both sides, T_0 the
    /// values given.
    pub fn bdpt_lightmap_fix_seams(
        desc: *const bdpt_lightmap_seams_desc,
        report: *mut bdpt_lightmap_seams_report,
    ) -> bdpt_result;

    /// Encodes texels.
    pub fn bdpt_lightmap_encode(
        desc: *const bdpt_lightmap_encode_desc,
        report: *mut bdpt_lightmap_encode_report,
    ) -> bdpt_result;
}
