// SPDX-License-Identifier: Apache-2.0

//! Spheres, and what is common to shapes

use crate::*;
use std::os::raw::c_char;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_sphere_desc {
    pub struct_size: u32,
    pub radius: f32,
    pub label: *const c_char,
    pub center: [f32; 3],
    pub reserved: u32,
}
sized!(bdpt_sphere_desc);

extern "C" {
    /// Adds an exact sphere.
    pub fn bdpt_sphere_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_sphere_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;

    /// Removes a shape that no instance uses.
    pub fn bdpt_shape_remove(builder: *mut bdpt_builder, shape: bdpt_shape_id) -> bdpt_result;
}
