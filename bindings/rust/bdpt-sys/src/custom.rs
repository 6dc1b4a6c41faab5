// SPDX-License-Identifier: Apache-2.0

//! Measurements of the host's own

use crate::*;
use std::os::raw::c_void;

/// Where a measurement begins.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_start {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
    pub weight: f32,
    pub density_position: f32,
    pub density_direction: f32,
    pub offset: f32,
    pub reserved: u32,
}

/// A point of a measurement and a direction there.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_place {
    pub measurement: u64,
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
    pub reserved: u32,
}

/// Light that lands on a surface of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_landing {
    pub instance: bdpt_instance_id,
    pub triangle: u32,
    pub u: f32,
    pub v: f32,
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
}

/// What it counts for.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_landed {
    pub measurement: u64,
    pub normal: [f32; 3],
    pub weight: f32,
    pub density_position: f32,
    pub reserved: u32,
}

pub const BDPT_NO_MEASUREMENT: u64 = u64::MAX;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_custom_desc {
    pub struct_size: u32,
    pub planes: u32,
    pub measurements: u64,
    pub hash: u64,
    pub start: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            measurements: *const u64,
            numbers: *const [f32; 4],
            starts: *mut bdpt_measurement_start,
        ) -> i32,
    >,
    pub density: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            places: *const bdpt_measurement_place,
            densities: *mut f32,
        ) -> i32,
    >,
    pub respond: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            places: *const bdpt_measurement_place,
            responses: *mut f32,
        ) -> i32,
    >,
    pub land: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            landings: *const bdpt_measurement_landing,
            landed: *mut bdpt_measurement_landed,
        ) -> i32,
    >,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
}
sized!(bdpt_custom_desc);

extern "C" {
    /// Creates a sensor from functions.
    pub fn bdpt_custom_create(
        context: *mut bdpt_context,
        desc: *const bdpt_custom_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;
}
