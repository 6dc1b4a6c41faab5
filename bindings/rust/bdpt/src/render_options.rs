// SPDX-License-Identifier: Apache-2.0
//! How paths are sampled, connected and weighed.

use crate::error::{owned, Result, Text};
use crate::plain::Plain;
use bdpt_sys as sys;
use std::ffi::CStr;

enumeration!(
    /// How techniques that can make the same path are weighed.
    Heuristic: bdpt_heuristic {
        /// Veach (9.11): w = p^beta / sum p^beta.
        Power = BDPT_HEURISTIC_POWER,
        /// The power heuristic with beta = 1.
        Balance = BDPT_HEURISTIC_BALANCE,
        /// Veach (9.10): balance among the techniques with p >= cutoff * p_max.
        Cutoff = BDPT_HEURISTIC_CUTOFF,
        /// The technique with the greatest p takes all.
        Maximum = BDPT_HEURISTIC_MAXIMUM,
        /// All techniques that can make the path, alike; the variance may be infinite.
        Average = BDPT_HEURISTIC_AVERAGE,
        /// No weights: every technique in full. The image is no estimate; its pyramid shows each technique alone.
        None = BDPT_HEURISTIC_NONE,
    }
);

enumeration!(
    /// Where random numbers come from.
    Sampler: bdpt_sampler {
        /// Owen-scrambled Sobol points, fixed dimensions for each vertex.
        Sobol = BDPT_SAMPLER_SOBOL,
        /// Independent ones.
        Independent = BDPT_SAMPLER_INDEPENDENT,
        /// Veach 10.3.1: each pixel in n x n strata, the rest independent.
        Stratified = BDPT_SAMPLER_STRATIFIED,
    }
);

enumeration!(
    /// Which connections are tested for visibility.
    ShadowRoulette: bdpt_shadow_roulette {
        /// Every one that carries light.
        None = BDPT_SHADOW_ROULETTE_NONE,
        /// With probability min(1, c / threshold), c the contribution's largest channel.
        Fixed = BDPT_SHADOW_ROULETTE_FIXED,
        /// Veach (1997), 10.4: by a threshold for each region of the image, which a pilot finds.
        Efficiency = BDPT_SHADOW_ROULETTE_EFFICIENCY,
    }
);

enumeration!(
    /// How many samples a pixel gets.
    Adaptive: bdpt_adaptive {
        /// One in each pass.
        None = BDPT_ADAPTIVE_NONE,
        /// Veach (1997), 10.3.6: as many in all, but more of them where it is noisy, as a pilot finds.
        TwoStages = BDPT_ADAPTIVE_TWO_STAGES,
    }
);

enumeration!(
    /// Where light subpaths start.
    LightStart: bdpt_light_start {
        /// By emitted power.
        Power = BDPT_LIGHT_START_POWER,
        /// At every light alike.
        Uniform = BDPT_LIGHT_START_UNIFORM,
        /// By what each light's subpaths bring to this view: Veach (1997), 10.7.
        Importance = BDPT_LIGHT_START_IMPORTANCE,
    }
);

enumeration!(
    /// How direct lighting chooses a light for the point that is lit.
    LightSelection: bdpt_light_selection {
        /// One light, by emitted power.
        Power = BDPT_LIGHT_SELECTION_POWER,
        /// One light, every light alike.
        Uniform = BDPT_LIGHT_SELECTION_UNIFORM,
        /// One light, or triangle of a light, by what it may send to the point: a tree of lights, for many of them.
        Tree = BDPT_LIGHT_SELECTION_TREE,
        /// Every light in turn, at most 64 lights.
        Each = BDPT_LIGHT_SELECTION_EACH,
    }
);

enumeration!(
    /// How the plan `matrix` puts subpaths in order.
    Order: bdpt_order {
        /// By the sum of the squares of a subpath's edges.
        Metric = BDPT_ORDER_METRIC,
        /// By the place of the last vertex on a Hilbert curve.
        Hilbert = BDPT_ORDER_HILBERT,
        /// As they were sampled.
        None = BDPT_ORDER_NONE,
    }
);

enumeration!(
    /// How the plan `matrix` chooses light subpaths in that order.
    Partners: bdpt_partners {
        /// A (0,2) sequence over the ordered matrix.
        Sobol = BDPT_PARTNERS_SOBOL,
        /// Chaitanya et al.
        LatinHypercube = BDPT_PARTNERS_LATIN_HYPERCUBE,
    }
);

enumeration!(
    /// How the plan `pooled` chooses the light vertices that an eye vertex meets.
    PoolSelection: bdpt_pool_selection {
        /// Each alike.
        Uniform = BDPT_POOL_SELECTION_UNIFORM,
        /// Half by the light that arrives at them, half alike.
        Importance = BDPT_POOL_SELECTION_IMPORTANCE,
    }
);

enumeration!(
    /// The matrices of the plan `matrix`.
    MatrixKind: bdpt_matrix_kind {
        /// One for each (s,t).
        PerTechnique = BDPT_MATRIX_PER_TECHNIQUE,
        /// One for all lengths.
        AllLengths = BDPT_MATRIX_ALL_LENGTHS,
    }
);

/// Which techniques (s,t) take part; 31 stands for 31 and more, in both.
///
/// ```
/// use bdpt::Techniques;
/// let no_caustics_from_light = Techniques::ALL.without(2, 1);
/// assert!(!no_caustics_from_light.has(2, 1) && no_caustics_from_light.has(2, 2));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Techniques([u32; 32]);

impl Techniques {
    /// All that there are.
    pub const ALL: Self = Self([u32::MAX; 32]);
    /// Path tracing: s <= 1.
    pub const PATH_TRACING: Self = {
        let mut rows = [0; 32];
        rows[0] = u32::MAX;
        rows[1] = u32::MAX;
        Self(rows)
    };
    /// Light tracing: t <= 1.
    pub const LIGHT_TRACING: Self = Self([3; 32]);

    /// One technique alone.
    pub fn only(s: u32, t: u32) -> Self {
        Self([0; 32]).with(s, t)
    }
    /// One technique more.
    pub fn with(mut self, s: u32, t: u32) -> Self {
        if let Some(row) = self.0.get_mut(s.min(31) as usize) {
            *row |= 1 << t.min(31);
        }
        self
    }
    /// One technique less.
    pub fn without(mut self, s: u32, t: u32) -> Self {
        if let Some(row) = self.0.get_mut(s.min(31) as usize) {
            *row &= !(1 << t.min(31));
        }
        self
    }
    /// Whether a technique takes part.
    pub fn has(&self, s: u32, t: u32) -> bool {
        self.0.get(s.min(31) as usize).map_or(false, |row| row >> t.min(31) & 1 == 1)
    }
}

/// How paths are sampled, connected and weighed. `bdpt.h` defines each number and its range; zero is the default of
/// each.
///
/// ```
/// use bdpt::{Heuristic, LightSelection, RenderOptions};
/// let options = RenderOptions::new()
///     .seed(7)
///     .max_edges(12)
///     .plan("matrix")
///     .heuristic(Heuristic::Balance)
///     .light_selection(LightSelection::Tree);
/// # let _ = options;
/// ```
#[derive(Clone, Debug, Default)]
pub struct RenderOptions {
    plan: Option<String>,
    techniques: Option<Techniques>,
    raw: Plain<sys::bdpt_render_desc>,
}

impl RenderOptions {
    /// The default.
    pub fn new() -> Self {
        Self::default()
    }
    /// A connection plan by its name: see [`plans`].
    pub fn plan(mut self, name: impl Into<String>) -> Self {
        self.plan = Some(name.into());
        self
    }
    /// Which techniques take part; all by default.
    pub fn techniques(mut self, techniques: Techniques) -> Self {
        self.techniques = Some(techniques);
        self
    }
    setters! {
        /// Longest path, k edges; 0 = no limit.
        max_edges: u32 => max_edges;
        /// Of the random numbers.
        seed: u64 => seed;
        /// Passes count up from here.
        first_pass: u64 => first_pass;
        /// How techniques that can make the same path are weighed.
        heuristic: Heuristic => heuristic;
        /// The power heuristic's exponent, up to 64; 0 = 2.
        beta: f32 => beta;
        /// The cutoff heuristic's threshold, in \[0,1\].
        cutoff: f32 => cutoff;
        /// Where random numbers come from.
        sampler: Sampler => sampler;
        /// Stratified: n, up to 256; 0 = 4.
        strata: u32 => strata;
        /// Where light subpaths start.
        light_start: LightStart => light_start;
        /// A subpath's first vertex at which Russian roulette may end it; 0 = 4.
        roulette_start: u32 => roulette_start;
        /// Samples in a block of work, up to 65536; 0 = chosen. Changes no bit of the result.
        block_size: u32 => block_size;
        /// Light vertices that each eye vertex meets (pooled; matrix: of each length), up to 1024.
        connections: u32 => connections;
        /// Light subpaths for each eye subpath, up to 1024.
        light_samples: u32 => light_samples;
        /// Matrix, mmlt, automatic: passes rendered at once, up to 64.
        pool_passes: u32 => pool_passes;
        /// Matrix: how subpaths are put in order.
        order: Order => order;
        /// Matrix: how light subpaths are chosen in that order.
        partners: Partners => partners;
        /// Which connections are tested for visibility.
        shadow_roulette: ShadowRoulette => shadow_roulette;
        /// Of [`ShadowRoulette::Fixed`]: in units of a pixel's value, above 0.
        shadow_threshold: f32 => shadow_threshold;
        /// How direct lighting chooses a light.
        light_selection: LightSelection => light_selection;
        /// Points on lights that direct lighting takes at each eye vertex, up to 64.
        direct_samples: u32 => direct_samples;
        /// Each of them is chosen among so many, up to 64.
        direct_candidates: u32 => direct_candidates;
        /// How many samples a pixel gets.
        adaptive: Adaptive => adaptive;
        /// Pooled: how light vertices are chosen.
        pool_selection: PoolSelection => pool_selection;
        /// The weights count connections that share an eye subpath as fewer than they are: Grittmann et al. (2021).
        correlation_aware: bool => correlation_aware;
        /// Matrix: pixels of a pool, 16 to 65536; 0 = 256.
        pool_pixels: u32 => pool_pixels;
        /// Matrix: one for each technique, or one for all.
        matrix: MatrixKind => matrix;
    }

    pub(crate) fn with_desc<R>(&self, call: impl FnOnce(&sys::bdpt_render_desc) -> Result<R>) -> Result<R> {
        let plan = Text::new(&self.plan)?;
        // All zero would mean all.
        let techniques = match self.techniques {
            Some(techniques) if techniques.0 == [0; 32] => {
                return Err(crate::Error::refused("techniques: none takes part"))
            }
            Some(techniques) => techniques.0,
            None => [0; 32],
        };
        call(&sys::bdpt_render_desc { plan: plan.as_ptr(), techniques, ..*self.raw })
    }
}

/// A connection plan: which light vertices meet which eye vertices.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// For [`RenderOptions::plan`].
    pub name: &'static str,
    /// A line about it.
    pub summary: String,
}

/// The connection plans; the first is the default.
///
/// ```
/// assert_eq!(bdpt::plans().next().unwrap().name, "one-to-one");
/// ```
pub fn plans() -> impl Iterator<Item = Plan> {
    (0..).map_while(|index| {
        // SAFETY: any index is allowed; the texts are the library's, for ever.
        unsafe {
            let name = sys::bdpt_plan_name(index);
            if name.is_null() {
                return None;
            }
            let name = CStr::from_ptr(name).to_str().ok()?;
            Some(Plan { name, summary: owned(sys::bdpt_plan_summary(index)) })
        }
    })
}
