// SPDX-License-Identifier: Apache-2.0

//! Context: threads, memory limit, log

use crate::*;
use std::os::raw::{c_char, c_void};

opaque!(bdpt_context);

/// The host's threads.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_executor {
    pub struct_size: u32,
    pub worker_count: u32,
    pub run: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            body: Option<unsafe extern "C" fn(body_user: *mut c_void, i: u32)>,
            body_user: *mut c_void,
        ),
    >,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
}
sized!(bdpt_executor);

pub type bdpt_log_level = i32;
pub const BDPT_LOG_INFO: bdpt_log_level = 0;
pub const BDPT_LOG_WARNING: bdpt_log_level = 1;

/// Receives what is worth telling and is no error, such as triangles dropped.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_log {
    pub struct_size: u32,
    pub reserved: u32,
    pub write: Option<unsafe extern "C" fn(user: *mut c_void, level: bdpt_log_level, text: *const c_char)>,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
}
sized!(bdpt_log);

pub type bdpt_isa = i32;

/// the widest this machine has
pub const BDPT_ISA_BEST: bdpt_isa = 0;
pub const BDPT_ISA_SSE42: bdpt_isa = 1;
pub const BDPT_ISA_AVX2: bdpt_isa = 2;
pub const BDPT_ISA_AVX512: bdpt_isa = 3;
/// of 64-bit Arm
pub const BDPT_ISA_NEON: bdpt_isa = 4;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_context_desc {
    pub struct_size: u32,
    pub threads: u32,
    pub executor: *const bdpt_executor,
    pub log: *const bdpt_log,
    pub memory_limit: u64,
    pub isa: bdpt_isa,
    pub reserved: u32,
    pub color_config: *const c_char,
    pub rendering_space: *const c_char,
}
sized!(bdpt_context_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_context_info {
    pub struct_size: u32,
    pub threads: u32,
    pub isa: bdpt_isa,
    pub embree: u32,
    pub memory: u64,
    pub memory_peak: u64,
    pub code_isa: bdpt_isa,
    pub reserved: u32,
}
sized!(bdpt_context_info);

extern "C" {
    /// Creates a context.
    pub fn bdpt_context_create(
        abi: u32,
        desc: *const bdpt_context_desc,
        context: *mut *mut bdpt_context,
    ) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_context_retain(context: *mut bdpt_context);

    /// Takes a reference.
    pub fn bdpt_context_release(context: *mut bdpt_context);

    /// Tells what the context is made of and what it uses.
    pub fn bdpt_context_get_info(context: *const bdpt_context, info: *mut bdpt_context_info) -> bdpt_result;
}
