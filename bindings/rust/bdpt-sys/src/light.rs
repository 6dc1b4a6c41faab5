// SPDX-License-Identifier: Apache-2.0

//! Lights

use crate::*;
use std::os::raw::c_char;

pub type bdpt_light_type = i32;
pub const BDPT_LIGHT_POINT: bdpt_light_type = 0;

/// a point that shines into a cone, with a smooth edge
pub const BDPT_LIGHT_SPOT: bdpt_light_type = 1;

/// radiance from all directions: the same from each, or a picture's
pub const BDPT_LIGHT_ENVIRONMENT: bdpt_light_type = 2;

/// light from far away: from one direction, or from a disc: a sun
pub const BDPT_LIGHT_DIRECTIONAL: bdpt_light_type = 3;

/// What a luminaire sends into each direction, as measured: the table of an IES file of type C.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_photometry {
    pub struct_size: u32,
    pub vertical_count: u32,
    pub horizontal_count: u32,
    pub reserved: u32,
    pub vertical_angles: *const f32,
    pub horizontal_angles: *const f32,
    pub intensities: *const f32,
}
sized!(bdpt_photometry);

/// A rectangle through which light comes from infinitely far: a window, seen from either side.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_portal {
    pub corner: [f32; 3],
    pub edge_u: [f32; 3],
    pub edge_v: [f32; 3],
}

/// Area lights are instances whose material emits.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_light_desc {
    pub struct_size: u32,
    pub type_: bdpt_light_type,
    pub label: *const c_char,
    pub position: [f32; 3],
    pub direction: [f32; 3],
    pub intensity: [f32; 3],
    pub radiance: [f32; 3],
    pub cone_angle: f32,
    pub cone_falloff: f32,
    pub group: u32,
    pub reserved: u32,
    pub texture: bdpt_texture_id,
    pub transform: [f32; 12],
    pub irradiance: [f32; 3],
    pub angular_radius: f32,
    pub up: [f32; 3],
    pub reserved_2: u32,
    pub photometry: *const bdpt_photometry,
    pub portals: *const bdpt_portal,
    pub portal_count: u32,
    pub reserved_3: u32,
}
sized!(bdpt_light_desc);

extern "C" {
    /// Adds a light.
    pub fn bdpt_light_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_light_desc,
        light: *mut bdpt_light_id,
    ) -> bdpt_result;

    /// Replaces a light's description for scenes built from now on.
    pub fn bdpt_light_update(
        builder: *mut bdpt_builder,
        light: bdpt_light_id,
        desc: *const bdpt_light_desc,
    ) -> bdpt_result;

    /// Removes a light.
    pub fn bdpt_light_remove(builder: *mut bdpt_builder, light: bdpt_light_id) -> bdpt_result;
}
