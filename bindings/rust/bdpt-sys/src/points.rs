// SPDX-License-Identifier: Apache-2.0

//! Points in space

use crate::*;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_point {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub radius: f32,
    pub cone: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_points_desc {
    pub struct_size: u32,
    pub output_count: u32,
    pub count: u64,
    pub point_stride: u64,
    pub points: *const bdpt_point,
    pub outputs: *const bdpt_output_desc,
    pub output_stride: u32,
    pub offset: f32,
}
sized!(bdpt_points_desc);

extern "C" {
    /// Creates a sensor of points in space.
    pub fn bdpt_points_create(
        context: *mut bdpt_context,
        desc: *const bdpt_points_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;
}
