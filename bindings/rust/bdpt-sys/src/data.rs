// SPDX-License-Identifier: Apache-2.0

//! Strided arrays

use std::os::raw::c_void;

pub type bdpt_format = i32;

/// allowed only in a view whose count is 0
pub const BDPT_FORMAT_NONE: bdpt_format = 0;

/// two 32-bit floats
pub const BDPT_FORMAT_FLOAT2: bdpt_format = 1;

/// three 32-bit floats
pub const BDPT_FORMAT_FLOAT3: bdpt_format = 2;

/// a triangle's three indices
pub const BDPT_FORMAT_UINT16X3: bdpt_format = 3;
pub const BDPT_FORMAT_UINT32X3: bdpt_format = 4;

/// four 32-bit floats
pub const BDPT_FORMAT_FLOAT4: bdpt_format = 5;

/// one 32-bit float
pub const BDPT_FORMAT_FLOAT1: bdpt_format = 6;

/// one 32-bit number
pub const BDPT_FORMAT_UINT32: bdpt_format = 7;

pub type bdpt_ownership = i32;

/// the library copies during the call
pub const BDPT_OWNERSHIP_COPY: bdpt_ownership = 0;

/// the data must stay, unchanged, until release is called
pub const BDPT_OWNERSHIP_BORROW: bdpt_ownership = 1;

/// A strided array.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_data {
    pub data: *const c_void,
    pub count: u64,
    pub stride: u64,
    pub format: bdpt_format,
    pub ownership: bdpt_ownership,
    pub slack_bytes: u64,
    pub release: Option<unsafe extern "C" fn(user: *mut c_void, data: *const c_void)>,
    pub user: *mut c_void,
}
zeroed!(bdpt_data);
