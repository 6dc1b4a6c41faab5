// SPDX-License-Identifier: Apache-2.0

//! Textures in materials: slots, lookup, opacity

use crate::*;

pub type bdpt_slot = i32;

/// colour
pub const BDPT_SLOT_REFLECTANCE: bdpt_slot = 0;

/// number, along u and v
pub const BDPT_SLOT_ROUGHNESS: bdpt_slot = 1;

/// a tangent-space normal map: 2 rgb - 1, x along u, y along v; x and y times scale
pub const BDPT_SLOT_NORMAL: bdpt_slot = 2;

/// the surface seems raised along its normal by a channel times scale, in world units
pub const BDPT_SLOT_BUMP: bdpt_slot = 3;

/// number
pub const BDPT_SLOT_OPACITY: bdpt_slot = 4;

/// colour; on meshes alone. Such a light is sampled by its texels
pub const BDPT_SLOT_EMISSION: bdpt_slot = 5;
pub const BDPT_SLOT_DIFFUSE_ROUGHNESS: bdpt_slot = 6;

/// colour
pub const BDPT_SLOT_TRANSMITTANCE: bdpt_slot = 7;
pub const BDPT_SLOT_METALNESS: bdpt_slot = 8;
pub const BDPT_SLOT_SPECULAR: bdpt_slot = 9;

/// colour
pub const BDPT_SLOT_SPECULAR_COLOR: bdpt_slot = 10;
pub const BDPT_SLOT_COAT: bdpt_slot = 11;
pub const BDPT_SLOT_COAT_ROUGHNESS: bdpt_slot = 12;

/// colour
pub const BDPT_SLOT_SHEEN_COLOR: bdpt_slot = 13;
pub const BDPT_SLOT_SHEEN_ROUGHNESS: bdpt_slot = 14;
pub const BDPT_SLOT_TRANSMISSION: bdpt_slot = 15;
pub const BDPT_SLOT_DIFFUSE_TRANSMISSION: bdpt_slot = 16;

/// as in glTF: red and green the direction, 2 rg - 1, in the frame of u; blue the number
pub const BDPT_SLOT_ANISOTROPY: bdpt_slot = 17;
pub const BDPT_SLOT_MIX: bdpt_slot = 18;
pub const BDPT_SLOT_IRIDESCENCE: bdpt_slot = 19;

/// from iridescence_thickness_minimum to iridescence_thickness
pub const BDPT_SLOT_IRIDESCENCE_THICKNESS: bdpt_slot = 20;

pub type bdpt_wrap = i32;
pub const BDPT_WRAP_REPEAT: bdpt_wrap = 0;
pub const BDPT_WRAP_MIRROR: bdpt_wrap = 1;

/// beyond the edge the last texel goes on
pub const BDPT_WRAP_CLAMP: bdpt_wrap = 2;

pub type bdpt_lookup = i32;
pub const BDPT_LOOKUP_BILINEAR: bdpt_lookup = 0;
pub const BDPT_LOOKUP_NEAREST: bdpt_lookup = 1;

/// by B-splines: smooth, and never beyond the texels' range
pub const BDPT_LOOKUP_BICUBIC: bdpt_lookup = 2;

/// A texture that varies a number of a material over the surface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_texture_use {
    pub struct_size: u32,
    pub slot: bdpt_slot,
    pub texture: bdpt_texture_id,
    pub channel: u32,
    pub uv_set: u32,
    pub transform: [f32; 6],
    pub wrap: [bdpt_wrap; 2],
    pub lookup: bdpt_lookup,
    pub level: f32,
    pub scale: f32,
    pub reserved: u32,
}
sized!(bdpt_texture_use);

pub type bdpt_opacity_mode = i32;
pub const BDPT_OPACITY_OPAQUE: bdpt_opacity_mode = 0;

/// there where opacity is at least the cutoff
pub const BDPT_OPACITY_MASK: bdpt_opacity_mode = 1;

/// there with the probability of opacity, by a hash of the ray
pub const BDPT_OPACITY_BLEND: bdpt_opacity_mode = 2;
