// SPDX-License-Identifier: Apache-2.0

//! Media

use crate::*;
use std::os::raw::c_char;

/// A homogeneous medium: what fills closed surfaces, or the whole scene.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_medium_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub label: *const c_char,
    pub sigma_a: [f32; 3],
    pub sigma_s: [f32; 3],
    pub g: f32,
    pub reserved2: u32,
}
sized!(bdpt_medium_desc);

extern "C" {
    /// Adds a medium.
    pub fn bdpt_medium_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_medium_desc,
        medium: *mut bdpt_medium_id,
    ) -> bdpt_result;

    /// Replaces a medium's description for scenes built from now on.
    pub fn bdpt_medium_update(
        builder: *mut bdpt_builder,
        medium: bdpt_medium_id,
        desc: *const bdpt_medium_desc,
    ) -> bdpt_result;

    /// Removes a medium that no material uses.
    pub fn bdpt_medium_remove(builder: *mut bdpt_builder, medium: bdpt_medium_id) -> bdpt_result;
}
