// SPDX-License-Identifier: Apache-2.0

//! Version, results, errors

use std::os::raw::c_char;

/// The ABI that is declared here; pass it to [`bdpt_context_create`](crate::bdpt_context_create).
pub const BDPT_ABI: u32 = 1;

pub type bdpt_result = i32;

/// success
pub const BDPT_OK: bdpt_result = 0;

/// stopped by a cancel token; finished work is kept
pub const BDPT_CANCELLED: bdpt_result = 1;

/// an argument or field is NULL, out of range, not finite or unknown
pub const BDPT_ERROR_INVALID_ARGUMENT: bdpt_result = -1;

/// an id is zero, stale, or of another builder
pub const BDPT_ERROR_INVALID_ID: bdpt_result = -2;

/// the system has no memory left
pub const BDPT_ERROR_OUT_OF_MEMORY: bdpt_result = -3;

/// the context's memory limit would be exceeded
pub const BDPT_ERROR_MEMORY_LIMIT: bdpt_result = -4;

/// not in this build, or not on this machine
pub const BDPT_ERROR_UNSUPPORTED: bdpt_result = -5;

/// header and library are of different ABI versions
pub const BDPT_ERROR_ABI: bdpt_result = -6;

/// a file could not be opened, read or written
pub const BDPT_ERROR_IO: bdpt_result = -7;

/// a file is damaged or of another kind
pub const BDPT_ERROR_FORMAT: bdpt_result = -8;

/// two objects do not fit: other scene, options, size, or overlapping passes
pub const BDPT_ERROR_MISMATCH: bdpt_result = -9;

/// the object is still referred to by another
pub const BDPT_ERROR_IN_USE: bdpt_result = -10;

/// called from inside a callback that does not allow it
pub const BDPT_ERROR_REENTRANT: bdpt_result = -11;

/// a callback of the host returned a value other than zero
pub const BDPT_ERROR_CALLBACK_FAILED: bdpt_result = -12;

/// a fault of the library: please report it
pub const BDPT_ERROR_INTERNAL: bdpt_result = -13;

extern "C" {
    /// The library's version, packed as 0x00MMmmpp (major, minor, patch).
    pub fn bdpt_version() -> u32;

    /// The ABI the library implements; compare with BDPT_ABI.
    pub fn bdpt_abi_version() -> u32;

    /// The name of a result code, such as "BDPT_ERROR_IO".
    pub fn bdpt_result_name(result: bdpt_result) -> *const c_char;

    /// What went wrong in the last call of this thread that failed: function, field, object and value, in one sentence.
    pub fn bdpt_last_error() -> *const c_char;
}
