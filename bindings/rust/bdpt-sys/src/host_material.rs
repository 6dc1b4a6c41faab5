// SPDX-License-Identifier: Apache-2.0

//! Materials of the host

use std::os::raw::c_void;

/// Where a host's material scatters.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_scattering_place {
    pub previous: [f32; 3],
    pub reflectance: [f32; 3],
    pub roughness: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_scattering_value {
    pub f: [f32; 3],
    pub density: f32,
    pub density_reverse: f32,
}

/// A material of yours.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_host_material {
    pub struct_size: u32,
    pub transmits: u32,
    pub user: *mut c_void,
    pub evaluate: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            place: *const bdpt_scattering_place,
            next: *const f32,
            value: *mut bdpt_scattering_value,
        ) -> i32,
    >,
    pub sample: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            place: *const bdpt_scattering_place,
            u: *const f32,
            next: *mut f32,
        ) -> i32,
    >,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
    pub hash: u64,
}
sized!(bdpt_host_material);
