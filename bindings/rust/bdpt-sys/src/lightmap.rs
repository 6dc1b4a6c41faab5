// SPDX-License-Identifier: Apache-2.0

//! Lightmap sensors

use crate::*;

/// An instance and its place in an atlas.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_instance {
    pub struct_size: u32,
    pub atlas: u32,
    pub instance: bdpt_instance_id,
    pub uv_set: u32,
    pub flip: u32,
    pub scale: [f32; 2],
    pub offset: [f32; 2],
}
sized!(bdpt_lightmap_instance);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub atlas_count: u32,
    pub instance_count: u32,
    pub instance_stride: u32,
    pub instances: *const bdpt_lightmap_instance,
    pub output_count: u32,
    pub output_stride: u32,
    pub outputs: *const bdpt_output_desc,
    pub rect: [u32; 4],
    pub geometric_normals: u32,
    pub buried_rays: u32,
    pub backface_tolerance: f32,
    pub all_backs: u32,
    pub cancel: *const bdpt_cancel,
    pub film_of_rect: u32,
    pub reserved: u32,
}
sized!(bdpt_lightmap_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_info {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub reserved: u32,
    pub texels: u64,
    pub texels_shared: u64,
    pub triangles_unmapped: u64,
    pub triangles_outside: u64,
    pub area: f64,
    pub area_outside: f64,
    pub texels_buried: u64,
    pub area_buried: f64,
}
sized!(bdpt_lightmap_info);

extern "C" {
    /// Creates a lightmap.
    pub fn bdpt_lightmap_create(
        scene: *mut bdpt_scene,
        desc: *const bdpt_lightmap_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Tells what a lightmap covers.
    pub fn bdpt_lightmap_get_info(sensor: *const bdpt_sensor, info: *mut bdpt_lightmap_info) -> bdpt_result;

    /// Reads, for each texel in rows, the part of it that its surfaces cover, by area in the atlas (above 1 where they
    /// overlap; 0 where nothing is measured), and the area of these surfaces in the world.
    pub fn bdpt_lightmap_read_texels(
        sensor: *const bdpt_sensor,
        coverage: *mut f32,
        area: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Reads, for each texel in rows, the part of it whose surfaces are buried, by area in the atlas;
    /// bdpt_lightmap_read_texels tells of what is left.
    pub fn bdpt_lightmap_read_buried(sensor: *const bdpt_sensor, buried: *mut f32, capacity: u64) -> bdpt_result;
}
