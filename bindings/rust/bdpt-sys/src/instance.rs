// SPDX-License-Identifier: Apache-2.0

//! Instances

use crate::*;
use std::os::raw::c_char;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_instance_desc {
    pub struct_size: u32,
    pub invisible: u32,
    pub label: *const c_char,
    pub shape: bdpt_shape_id,
    pub material: bdpt_material_id,
    pub transform: [f32; 12],
    pub end_transform: [f32; 12],
}
sized!(bdpt_instance_desc);

extern "C" {
    /// Places a shape, with a material, in the world.
    pub fn bdpt_instance_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_instance_desc,
        instance: *mut bdpt_instance_id,
    ) -> bdpt_result;

    /// Replaces an instance's description for scenes built from now on.
    pub fn bdpt_instance_update(
        builder: *mut bdpt_builder,
        instance: bdpt_instance_id,
        desc: *const bdpt_instance_desc,
    ) -> bdpt_result;

    /// Removes an instance.
    pub fn bdpt_instance_remove(builder: *mut bdpt_builder, instance: bdpt_instance_id) -> bdpt_result;
}
