// SPDX-License-Identifier: Apache-2.0

//! Cancel token and progress

use crate::*;
use std::os::raw::c_void;

opaque!(bdpt_cancel);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_progress {
    pub struct_size: u32,
    pub reserved: u32,
    pub fraction: f64,
    pub seconds: f64,
    pub passes: u64,
    pub samples: u64,
}
sized!(bdpt_progress);

/// Called about ten times a second on the calling thread, once at the beginning, and once at the end of a call that
/// finishes.
pub type bdpt_progress_fn = Option<unsafe extern "C" fn(user: *mut c_void, progress: *const bdpt_progress) -> i32>;

extern "C" {
    /// Creates a token that stops the calls it is passed to.
    pub fn bdpt_cancel_create(cancel: *mut *mut bdpt_cancel) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_cancel_retain(cancel: *mut bdpt_cancel);

    /// Takes a reference.
    pub fn bdpt_cancel_release(cancel: *mut bdpt_cancel);

    /// Asks the calls that hold the token to stop, within one block of work per thread.
    pub fn bdpt_cancel_request(cancel: *mut bdpt_cancel);

    /// Makes the token fresh again.
    pub fn bdpt_cancel_reset(cancel: *mut bdpt_cancel);

    /// Returns: 1 if a stop was asked for, else 0; 0 for NULL.
    pub fn bdpt_cancel_is_requested(cancel: *const bdpt_cancel) -> u32;
}
