// SPDX-License-Identifier: Apache-2.0

//! Subdivision surfaces

use crate::*;
use std::os::raw::{c_char, c_void};

pub type bdpt_boundary = i32;

/// boundaries are smooth curves, round at their corners
pub const BDPT_BOUNDARY_SMOOTH: bdpt_boundary = 0;

/// smooth, but for corners of one face, which stay where they are
pub const BDPT_BOUNDARY_PIN_CORNERS: bdpt_boundary = 1;

/// all of the boundary stays where it is
pub const BDPT_BOUNDARY_PIN: bdpt_boundary = 2;

/// Displaces `count` places of a surface: packed arrays of positions, unit normals and texture coordinates come in,
/// three, three and two floats each; displaced comes as the positions, and is what they become.
pub type bdpt_displace_fn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        count: u64,
        positions: *const f32,
        normals: *const f32,
        uv: *const f32,
        displaced: *mut f32,
    ) -> i32,
>;

/// A Catmull-Clark surface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_subdivision_desc {
    pub struct_size: u32,
    pub level: u32,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub face_counts: bdpt_data,
    pub indices: bdpt_data,
    pub uv: bdpt_data,
    pub uv_indices: bdpt_data,
    pub crease_edges: bdpt_data,
    pub crease_weights: bdpt_data,
    pub corners: bdpt_data,
    pub corner_weights: bdpt_data,
    pub boundary: bdpt_boundary,
    pub reserved: u32,
    pub displace: bdpt_displace_fn,
    pub user: *mut c_void,
}
sized!(bdpt_subdivision_desc);

extern "C" {
    /// Adds a subdivision surface as a mesh of points of its limit, so all that meshes can do, it can: 2 level²
    /// triangles for a face of 4 corners, n level² / 2 for one of n.
    pub fn bdpt_subdivision_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_subdivision_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;
}
