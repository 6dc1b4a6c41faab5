// SPDX-License-Identifier: Apache-2.0

//! Builder and scene

use crate::*;
use std::os::raw::{c_char, c_void};

opaque!(bdpt_builder);

opaque!(bdpt_scene);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_build_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub cancel: *mut bdpt_cancel,
    pub progress: bdpt_progress_fn,
    pub user: *mut c_void,
    pub medium: bdpt_medium_id,
}
sized!(bdpt_build_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_scene_info {
    pub struct_size: u32,
    pub lights: u32,
    pub instances: u64,
    pub triangles: u64,
    pub spheres: u64,
    pub degenerate_triangles: u64,
    pub memory: u64,
    pub memory_embree: u64,
    pub hash: u64,
    pub bounds_min: [f32; 3],
    pub bounds_max: [f32; 3],
    pub curves: u64,
}
sized!(bdpt_scene_info);

/// One of a scene's lights: a light, or an instance of a material that emits.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_scene_light {
    pub struct_size: u32,
    pub group: u32,
    pub light: bdpt_light_id,
    pub instance: bdpt_instance_id,
    pub label: *const c_char,
}
sized!(bdpt_scene_light);

extern "C" {
    /// Creates an empty builder.
    pub fn bdpt_builder_create(context: *mut bdpt_context, builder: *mut *mut bdpt_builder) -> bdpt_result;

    /// Destroys a builder; scenes built from it live on.
    pub fn bdpt_builder_destroy(builder: *mut bdpt_builder);

    /// Builds an immutable scene from what the builder holds.
    pub fn bdpt_scene_build(
        builder: *mut bdpt_builder,
        desc: *const bdpt_build_desc,
        scene: *mut *mut bdpt_scene,
    ) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_scene_retain(scene: *mut bdpt_scene);

    /// Takes a reference.
    pub fn bdpt_scene_release(scene: *mut bdpt_scene);

    /// Tells what a scene holds.
    pub fn bdpt_scene_get_info(scene: *const bdpt_scene, info: *mut bdpt_scene_info) -> bdpt_result;

    /// Tells what light `index` is, below bdpt_scene_info.lights: lights first, then instances, each in the order of
    /// adding.
    pub fn bdpt_scene_get_light(scene: *const bdpt_scene, index: u32, light: *mut bdpt_scene_light) -> bdpt_result;
}
