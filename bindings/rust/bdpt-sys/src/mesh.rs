// SPDX-License-Identifier: Apache-2.0

//! Triangle meshes

use crate::*;
use std::os::raw::c_char;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_mesh_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub indices: bdpt_data,
    pub normals: bdpt_data,
    pub uv: [bdpt_data; 2],
    pub colors: bdpt_data,
    pub tangents: bdpt_data,
}
sized!(bdpt_mesh_desc);

extern "C" {
    /// Adds a triangle mesh.
    pub fn bdpt_mesh_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_mesh_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;
}
