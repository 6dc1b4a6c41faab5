// SPDX-License-Identifier: Apache-2.0

//! Film: the measurements

use crate::*;
use std::os::raw::c_char;

opaque!(bdpt_film);

pub type bdpt_filter = i32;

/// radius 0.5 by default
pub const BDPT_FILTER_BOX: bdpt_filter = 0;

/// radius 1
pub const BDPT_FILTER_TENT: bdpt_filter = 1;

/// radius 1.5, standard deviation a (0 = 0.5), shifted to reach zero
pub const BDPT_FILTER_GAUSSIAN: bdpt_filter = 2;

/// radius 2, with b and c (both 0 = 1/3 each); has negative lobes
pub const BDPT_FILTER_MITCHELL: bdpt_filter = 3;

/// radius 2
pub const BDPT_FILTER_BLACKMAN_HARRIS: bdpt_filter = 4;

pub type bdpt_normalization = i32;

/// the eye image is divided by its sum of weights, Veach (10.11): less noise, a slight bias; the two agree for a box of
/// 0.5
pub const BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED: bdpt_normalization = 0;

/// divided by the number of samples, Veach (10.10): unbiased
pub const BDPT_NORMALIZATION_SAMPLE_COUNT: bdpt_normalization = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_film_desc {
    pub struct_size: u32,
    pub filter: bdpt_filter,
    pub filter_radius: f32,
    pub filter_a: f32,
    pub filter_b: f32,
    pub normalization: bdpt_normalization,
    pub groups: u32,
    pub pyramid_edges: u32,
}
sized!(bdpt_film_desc);

/// Bytes, as the context's memory_limit counts them.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_memory_estimate {
    pub struct_size: u32,
    pub band_rows: u32,
    pub sensor: u64,
    pub film: u64,
    pub render: u64,
    pub total: u64,
}
sized!(bdpt_memory_estimate);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_film_info {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub groups: u32,
    pub pyramid_edges: u32,
    pub filter: bdpt_filter,
    pub filter_radius: f32,
    pub normalization: bdpt_normalization,
    pub passes: u64,
    pub first_pass: u64,
    pub next_pass: u64,
    pub seed: u64,
    pub scene_hash: u64,
    pub options_hash: u64,
    pub rejected: u64,
    pub relative_error: f64,
    pub measured: u64,
    pub planes: u32,
    pub coverages: u32,
}
sized!(bdpt_film_info);

pub type bdpt_layer = i32;

/// 3 channels: the image, eye image plus light image
pub const BDPT_LAYER_COLOR: bdpt_layer = 0;

/// 3 channels: t >= 2
pub const BDPT_LAYER_EYE: bdpt_layer = 1;

/// 3 channels: t \<= 1
pub const BDPT_LAYER_LIGHT: bdpt_layer = 2;

/// 3 channels: the variance of COLOR (of the mean, not of one sample), from the groups; with two groups it has one
/// degree of freedom: average it over a neighbourhood
pub const BDPT_LAYER_VARIANCE: bdpt_layer = 3;

/// 3 channels: the weighted contribution of technique (s,t) of the pyramid
pub const BDPT_LAYER_TECHNIQUE: bdpt_layer = 4;

/// 3 channels alike: how many contributions to the pixel, in any plane, were left out, not being finite or being too
/// large; a start that cannot be used counts as one
pub const BDPT_LAYER_REJECTED: bdpt_layer = 5;

/// 3 channels alike: the eye samples of the pixel. Of cameras with outputs
pub const BDPT_LAYER_SAMPLES: bdpt_layer = 6;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_read_desc {
    pub struct_size: u32,
    pub layer: bdpt_layer,
    pub s: u32,
    pub t: u32,
    pub rect: [u32; 4],
    pub row_stride: u64,
    pub flip: u32,
    pub include_partial: u32,
    pub plane: u32,
    pub reserved: u32,
}
sized!(bdpt_read_desc);

/// Which ids to read, and where.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_coverage_desc {
    pub struct_size: u32,
    pub coverage: u32,
    pub rect: [u32; 4],
    pub ranks: u32,
    pub include_partial: u32,
}
sized!(bdpt_coverage_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_coverage {
    pub id: u64,
    pub part: f32,
    pub reserved: u32,
}

extern "C" {
    /// Creates an empty film for a sensor.
    pub fn bdpt_film_create(
        sensor: *mut bdpt_sensor,
        desc: *const bdpt_film_desc,
        film: *mut *mut bdpt_film,
    ) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_film_retain(film: *mut bdpt_film);

    /// Takes a reference.
    pub fn bdpt_film_release(film: *mut bdpt_film);

    /// Tells what a film and its render will take, before there is one.
    pub fn bdpt_film_estimate(
        sensor: *const bdpt_sensor,
        desc: *const bdpt_film_desc,
        estimate: *mut bdpt_memory_estimate,
    ) -> bdpt_result;

    /// The same for a lightmap that is not there yet, and its film; film may be NULL.
    pub fn bdpt_lightmap_estimate(
        scene: *mut bdpt_scene,
        desc: *const bdpt_lightmap_desc,
        film: *const bdpt_film_desc,
        budget: u64,
        estimate: *mut bdpt_memory_estimate,
    ) -> bdpt_result;

    /// Tells what a film holds.
    pub fn bdpt_film_get_info(film: *const bdpt_film, info: *mut bdpt_film_info) -> bdpt_result;

    /// Reads a layer as 32-bit floats, 3 to a pixel.
    pub fn bdpt_film_read(
        film: *const bdpt_film,
        desc: *const bdpt_read_desc,
        pixels: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Reads the ids of each pixel, by rows, `ranks` for each, those with the largest parts first.
    pub fn bdpt_film_read_coverage(
        film: *const bdpt_film,
        desc: *const bdpt_coverage_desc,
        entries: *mut bdpt_coverage,
        capacity: u64,
        lost: *mut f64,
    ) -> bdpt_result;

    /// Empties a film, so that another scene or other options may fill it.
    pub fn bdpt_film_clear(film: *mut bdpt_film) -> bdpt_result;

    /// Adds the passes of source to destination, exactly: the merge of \[0,k) and \[k,n) is the render of \[0,n).
    pub fn bdpt_film_merge(destination: *mut bdpt_film, source: *const bdpt_film) -> bdpt_result;

    /// Writes the film's whole state to a file, first under another name, so that path holds the old file or the new
    /// one.
    pub fn bdpt_film_save(film: *const bdpt_film, path: *const c_char) -> bdpt_result;

    /// Reads a film that bdpt_film_save wrote.
    pub fn bdpt_film_load(context: *mut bdpt_context, path: *const c_char, film: *mut *mut bdpt_film) -> bdpt_result;
}
