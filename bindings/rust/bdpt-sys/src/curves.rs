// SPDX-License-Identifier: Apache-2.0

//! Curves

use crate::*;
use std::os::raw::c_char;

pub type bdpt_curve_basis = i32;

/// cones that touch spheres round the control points. 2 points, and 1 for each further segment. Closed: a sphere at
/// either end
pub const BDPT_CURVE_LINEAR: bdpt_curve_basis = 0;

/// cubic: 4 points, and 3 for each further segment
pub const BDPT_CURVE_BEZIER: bdpt_curve_basis = 1;

/// cubic, uniform: 4 points, and 1 for each further segment
pub const BDPT_CURVE_BSPLINE: bdpt_curve_basis = 2;

/// cubic: 4 points, and 1 for each further segment; through all but a strand's ends
pub const BDPT_CURVE_CATMULL_ROM: bdpt_curve_basis = 3;

/// Round curves, such as hair: strands along which a circle is swept, whose radius varies as the axis does.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_curves_desc {
    pub struct_size: u32,
    pub basis: bdpt_curve_basis,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub radii: bdpt_data,
    pub counts: bdpt_data,
}
sized!(bdpt_curves_desc);

extern "C" {
    /// Adds curves, as a set: one for all hair of a head is better than one for each.
    pub fn bdpt_curves_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_curves_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;
}
