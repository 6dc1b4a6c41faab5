// SPDX-License-Identifier: Apache-2.0
//! How a film keeps its samples.

use bdpt_sys as sys;

enumeration!(
    /// How samples are spread over pixels.
    Filter: bdpt_filter {
        /// Radius 0.5 by default.
        Box = BDPT_FILTER_BOX,
        /// Radius 1.
        Tent = BDPT_FILTER_TENT,
        /// Radius 1.5, standard deviation 0.5 by default.
        Gaussian = BDPT_FILTER_GAUSSIAN,
        /// Radius 2, with B and C 1/3 each by default; has negative lobes.
        Mitchell = BDPT_FILTER_MITCHELL,
        /// Radius 2.
        BlackmanHarris = BDPT_FILTER_BLACKMAN_HARRIS,
    }
);

enumeration!(
    /// By what sums are divided.
    Normalization: bdpt_normalization {
        /// The eye image by its sum of weights, Veach (10.11): less noise, a slight bias.
        FilterWeightsBiased = BDPT_NORMALIZATION_FILTER_WEIGHTS_BIASED,
        /// By the number of samples, Veach (10.10): unbiased.
        SampleCount = BDPT_NORMALIZATION_SAMPLE_COUNT,
    }
);

/// How a [`Film`](crate::Film) keeps its samples.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Camera, Context, Film, FilmOptions, Filter};
/// let sensor = Camera::perspective(64, 48).create(&Context::new()?)?;
/// let options = FilmOptions::default().filter(Filter::Mitchell).groups(4);
/// println!("takes {} bytes", Film::estimate(&sensor, &options)?.total);
/// let film = Film::new(&sensor, &options)?;
/// assert_eq!(film.info()?.groups, 4);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct FilmOptions {
    pub(crate) raw: sys::bdpt_film_desc,
}

impl FilmOptions {
    setters! {
        /// How samples are spread over pixels.
        filter: Filter => filter;
        /// In pixels, \[0.5, 8\]; 0 = the filter's own.
        filter_radius: f32 => filter_radius;
        /// By what sums are divided.
        normalization: Normalization => normalization;
        /// Independent groups of passes, 1 to 16; 0 = 2. The estimate of variance needs two.
        groups: u32 => groups;
        /// Keeps an image of each technique (s,t) of paths of up to so many edges, at most 15.
        pyramid_edges: u32 => pyramid_edges;
    }
    /// A Gaussian's standard deviation in pixels.
    pub fn gaussian(mut self, deviation: f32) -> Self {
        self.raw.filter = Filter::Gaussian.raw();
        self.raw.filter_a = deviation;
        self
    }
    /// Mitchell's B and C.
    pub fn mitchell(mut self, b: f32, c: f32) -> Self {
        self.raw.filter = Filter::Mitchell.raw();
        (self.raw.filter_a, self.raw.filter_b) = (b, c);
        self
    }
}

/// Bytes that a film and its render will take, as the context's memory limit counts them.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryEstimate {
    /// Of a lightmap: bake it in bands of so many rows, and no band needs more than the budget.
    pub band_rows: u32,
    /// Of a sensor that is not there yet.
    pub sensor: u64,
    /// Of the film.
    pub film: u64,
    /// Of a render with default options.
    pub render: u64,
    /// Of all.
    pub total: u64,
}

impl MemoryEstimate {
    pub(crate) fn new(raw: &sys::bdpt_memory_estimate) -> Self {
        Self { band_rows: raw.band_rows, sensor: raw.sensor, film: raw.film, render: raw.render, total: raw.total }
    }
}
