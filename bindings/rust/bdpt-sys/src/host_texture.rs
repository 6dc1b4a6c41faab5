// SPDX-License-Identifier: Apache-2.0

//! Textures of the host

use crate::*;
use std::os::raw::{c_char, c_void};

/// Where a texture of yours is looked up.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_texture_place {
    pub uv: [f32; 2],
    pub position: [f32; 3],
    pub reserved: u32,
    pub instance: bdpt_instance_id,
}

/// A texture of yours: a function that computes colours, for patterns and noise.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_host_texture_desc {
    pub struct_size: u32,
    pub maximum: f32,
    pub label: *const c_char,
    pub look_up: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            count: u32,
            places: *const bdpt_texture_place,
            colors: *mut [f32; 4],
        ) -> i32,
    >,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
    pub hash: u64,
    pub step: [f32; 2],
}
sized!(bdpt_host_texture_desc);

extern "C" {
    /// Adds a texture of yours.
    pub fn bdpt_host_texture_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_host_texture_desc,
        texture: *mut bdpt_texture_id,
    ) -> bdpt_result;
}
