// SPDX-License-Identifier: Apache-2.0

//! Render

use crate::*;
use std::os::raw::{c_char, c_void};

opaque!(bdpt_render);

pub type bdpt_heuristic = i32;

/// Veach (9.11): w = p^beta / sum p^beta
pub const BDPT_HEURISTIC_POWER: bdpt_heuristic = 0;

/// the power heuristic with beta = 1
pub const BDPT_HEURISTIC_BALANCE: bdpt_heuristic = 1;

/// Veach (9.10): balance among the techniques with p >= cutoff * p_max
pub const BDPT_HEURISTIC_CUTOFF: bdpt_heuristic = 2;

/// the technique with the greatest p takes all
pub const BDPT_HEURISTIC_MAXIMUM: bdpt_heuristic = 3;

/// all techniques that can make the path, alike; the variance may be infinite
pub const BDPT_HEURISTIC_AVERAGE: bdpt_heuristic = 4;

/// no weights: every technique in full. The image is no estimate; its pyramid shows each technique alone
pub const BDPT_HEURISTIC_NONE: bdpt_heuristic = 5;

pub type bdpt_sampler = i32;

/// Owen-scrambled Sobol points, fixed dimensions for each vertex
pub const BDPT_SAMPLER_SOBOL: bdpt_sampler = 0;
pub const BDPT_SAMPLER_INDEPENDENT: bdpt_sampler = 1;

/// Veach 10.3.1: each pixel in n x n strata, the rest independent
pub const BDPT_SAMPLER_STRATIFIED: bdpt_sampler = 2;

pub type bdpt_shadow_roulette = i32;

/// every connection that carries light is tested for visibility
pub const BDPT_SHADOW_ROULETTE_NONE: bdpt_shadow_roulette = 0;

/// with probability min(1, c / threshold), c the contribution's largest channel
pub const BDPT_SHADOW_ROULETTE_FIXED: bdpt_shadow_roulette = 1;

/// Veach (1997), 10.4: the threshold of each region of the image is the standard deviation of a sample per ray, found
/// by a pilot of some thousand samples at the start of the first call of bdpt_render_advance
pub const BDPT_SHADOW_ROULETTE_EFFICIENCY: bdpt_shadow_roulette = 2;

pub type bdpt_adaptive = i32;

/// one eye sample of each pixel in each pass
pub const BDPT_ADAPTIVE_NONE: bdpt_adaptive = 0;

/// Veach (1997), 10.3.6: as many in all, but more of them where they are noisy in relation to the picture: a pixel gets
/// r in a pass, in the mean, r in quarters from 1/2 to 4, and each counts 1/r times. A pilot of some thousand samples
/// at the start of the first call of bdpt_render_advance finds r for each region of the image, before any sample is
/// taken: no bias. In one pass alone some pixels get none; it is at its best in multiples of four passes for each of
/// the film's groups
pub const BDPT_ADAPTIVE_TWO_STAGES: bdpt_adaptive = 1;

pub type bdpt_light_start = i32;

/// light subpaths start by emitted power
pub const BDPT_LIGHT_START_POWER: bdpt_light_start = 0;

/// every light alike
pub const BDPT_LIGHT_START_UNIFORM: bdpt_light_start = 1;

/// by what each light's subpaths bring to this view, and a tenth by power: Veach (1997), 10.7. bdpt_render_create
/// traces a pilot of 8192 to 65536 samples to find it; they count in the statistics
pub const BDPT_LIGHT_START_IMPORTANCE: bdpt_light_start = 2;

/// How direct lighting (s = 1) chooses a light for the point that is lit.
pub type bdpt_light_selection = i32;

/// one light, by emitted power; a point on it by area
pub const BDPT_LIGHT_SELECTION_POWER: bdpt_light_selection = 0;

/// one light, every light alike
pub const BDPT_LIGHT_SELECTION_UNIFORM: bdpt_light_selection = 1;

/// one light, or triangle of a light, by what it may send to the point: a tree of lights, for many of them. Infinite
/// lights take half
pub const BDPT_LIGHT_SELECTION_TREE: bdpt_light_selection = 2;

/// every light in turn, at most 64 lights
pub const BDPT_LIGHT_SELECTION_EACH: bdpt_light_selection = 3;

pub type bdpt_order = i32;

/// by the sum of the squares of a subpath's edges: Chaitanya et al. (2018), 4.2
pub const BDPT_ORDER_METRIC: bdpt_order = 0;

/// by the place of the last vertex on a Hilbert curve
pub const BDPT_ORDER_HILBERT: bdpt_order = 1;

/// as they were sampled
pub const BDPT_ORDER_NONE: bdpt_order = 2;

pub type bdpt_partners = i32;

/// a (0,2) sequence over the ordered matrix: neighbours differ
pub const BDPT_PARTNERS_SOBOL: bdpt_partners = 0;

/// Chaitanya et al.
pub const BDPT_PARTNERS_LATIN_HYPERCUBE: bdpt_partners = 1;

/// How the pooled plan chooses the light vertices that an eye vertex meets, among all of the pass.
pub type bdpt_pool_selection = i32;

/// each alike
pub const BDPT_POOL_SELECTION_UNIFORM: bdpt_pool_selection = 0;

/// half by the light that arrives at them, half alike
pub const BDPT_POOL_SELECTION_IMPORTANCE: bdpt_pool_selection = 1;

pub type bdpt_matrix_kind = i32;

/// one for each (s,t)
pub const BDPT_MATRIX_PER_TECHNIQUE: bdpt_matrix_kind = 0;

/// one for all lengths, each row with as many columns as make about as many connections: Chaitanya et al. (2018), 7
pub const BDPT_MATRIX_ALL_LENGTHS: bdpt_matrix_kind = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_render_desc {
    pub struct_size: u32,
    pub max_edges: u32,
    pub seed: u64,
    pub first_pass: u64,
    pub techniques: [u32; 32],
    pub heuristic: bdpt_heuristic,
    pub beta: f32,
    pub cutoff: f32,
    pub sampler: bdpt_sampler,
    pub strata: u32,
    pub light_start: bdpt_light_start,
    pub roulette_start: u32,
    pub block_size: u32,
    pub plan: *const c_char,
    pub connections: u32,
    pub light_samples: u32,
    pub pool_passes: u32,
    pub order: bdpt_order,
    pub partners: bdpt_partners,
    pub shadow_roulette: bdpt_shadow_roulette,
    pub shadow_threshold: f32,
    pub light_selection: bdpt_light_selection,
    pub direct_samples: u32,
    pub direct_candidates: u32,
    pub adaptive: bdpt_adaptive,
    pub pool_selection: bdpt_pool_selection,
    pub correlation_aware: u32,
    pub pool_pixels: u32,
    pub matrix: bdpt_matrix_kind,
    pub reserved: u32,
}
sized!(bdpt_render_desc);

/// Receives the image of the whole passes so far, tile by tile: begin once, tile for each, end once with the result of
/// the sending.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_output_sink {
    pub struct_size: u32,
    pub every: u32,
    pub begin: Option<unsafe extern "C" fn(user: *mut c_void, width: u32, height: u32, passes: u64) -> i32>,
    pub tile:
        Option<unsafe extern "C" fn(user: *mut c_void, x0: u32, y0: u32, x1: u32, y1: u32, pixels: *const f32) -> i32>,
    pub end: Option<unsafe extern "C" fn(user: *mut c_void, result: bdpt_result)>,
    pub user: *mut c_void,
}
sized!(bdpt_output_sink);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_advance_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub passes: u64,
    pub seconds: f64,
    pub noise: f64,
    pub cancel: *mut bdpt_cancel,
    pub progress: bdpt_progress_fn,
    pub progress_user: *mut c_void,
    pub sink: *const bdpt_output_sink,
}
sized!(bdpt_advance_desc);

pub type bdpt_stop_reason = i32;
pub const BDPT_STOP_PASSES: bdpt_stop_reason = 0;
pub const BDPT_STOP_TIME: bdpt_stop_reason = 1;
pub const BDPT_STOP_NOISE: bdpt_stop_reason = 2;
pub const BDPT_STOP_CANCELLED: bdpt_stop_reason = 3;
pub const BDPT_STOP_CALLBACK: bdpt_stop_reason = 4;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_advance_report {
    pub struct_size: u32,
    pub reason: bdpt_stop_reason,
    pub passes: u64,
    pub next_pass: u64,
    pub seconds: f64,
    pub relative_error: f64,
}
sized!(bdpt_advance_report);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_render_stats {
    pub struct_size: u32,
    pub reserved: u32,
    pub passes: u64,
    pub samples: u64,
    pub eye_rays: u64,
    pub light_rays: u64,
    pub shadow_rays: u64,
    pub shadow_rays_blocked: u64,
    pub connections: u64,
    pub rejected: u64,
    pub seconds: f64,
    pub seconds_start: f64,
    pub seconds_extend: f64,
    pub seconds_extend_rays: f64,
    pub seconds_connect: f64,
    pub seconds_shadow: f64,
    pub seconds_accumulate: f64,
    pub shadow_rays_skipped: u64,
    pub mutations: u64,
    pub accepted: u64,
    pub light_samples: u32,
    pub share_path: f32,
    pub share_two_way: f32,
    pub share_one_to_one: f32,
    pub share_matrix: f32,
    pub reserved_2: u32,
}
sized!(bdpt_render_stats);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_technique_stats {
    pub struct_size: u32,
    pub reserved: u32,
    pub contributions: u64,
    pub shadow_rays: u64,
    pub shadow_rays_blocked: u64,
    pub shadow_rays_skipped: u64,
    pub energy: f64,
    pub squares: f64,
    pub seconds: f64,
}
sized!(bdpt_technique_stats);

extern "C" {
    /// Connection plans say which light vertices meet which eye vertices, s >= 2 and t >= 2; all plans measure the
    /// same. The name of plan number `index`; NULL past the last.
    pub fn bdpt_plan_name(index: u32) -> *const c_char;

    /// A line about plan number `index`; NULL past the last.
    pub fn bdpt_plan_summary(index: u32) -> *const c_char;

    /// Joins a scene, a sensor and a film.
    pub fn bdpt_render_create(
        scene: *mut bdpt_scene,
        sensor: *mut bdpt_sensor,
        film: *mut bdpt_film,
        desc: *const bdpt_render_desc,
        render: *mut *mut bdpt_render,
    ) -> bdpt_result;

    /// Destroys a render; the film keeps its whole passes.
    pub fn bdpt_render_destroy(render: *mut bdpt_render);

    /// Samples passes until a limit is reached; the first one reached counts, and at least one must be set.
    pub fn bdpt_render_advance(
        render: *mut bdpt_render,
        desc: *const bdpt_advance_desc,
        report: *mut bdpt_advance_report,
    ) -> bdpt_result;

    /// Tells what a render has done so far.
    pub fn bdpt_render_get_stats(render: *const bdpt_render, stats: *mut bdpt_render_stats) -> bdpt_result;

    /// Tells what technique (s,t) has done so far; 31 stands for 31 and more.
    pub fn bdpt_render_get_technique_stats(
        render: *const bdpt_render,
        s: u32,
        t: u32,
        stats: *mut bdpt_technique_stats,
    ) -> bdpt_result;
}
