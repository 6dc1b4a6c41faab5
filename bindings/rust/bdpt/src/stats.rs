// SPDX-License-Identifier: Apache-2.0
//! What a render has done.

use bdpt_sys as sys;

macro_rules! stats {
    ($(#[$doc:meta])* $name:ident: $raw:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* }) => {
        $(#[$doc])*
        #[non_exhaustive]
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name {
            $($(#[$field_doc])* pub $field: $type,)*
        }
        impl $name {
            pub(crate) fn new(raw: &sys::$raw) -> Self {
                Self { $($field: raw.$field,)* }
            }
        }
    };
}

stats!(
    /// What a [`Render`](crate::Render) has done so far.
    RenderStats: bdpt_render_stats {
        /// Whole passes by this render.
        passes: u64,
        /// Eye subpaths.
        samples: u64,
        /// Rays that extended an eye subpath.
        eye_rays: u64,
        /// Rays that extended a light subpath.
        light_rays: u64,
        /// Rays that tested a connection.
        shadow_rays: u64,
        /// Of these, those that met something.
        shadow_rays_blocked: u64,
        /// By the shadow rays' roulette.
        shadow_rays_skipped: u64,
        /// Connections weighed; those with nothing to carry cost no shadow ray.
        connections: u64,
        /// Contributions not finite or too large, left out.
        rejected: u64,
        /// Inside [`Render::advance`](crate::Render::advance).
        seconds: f64,
        /// Thread-seconds of first vertices.
        seconds_start: f64,
        /// Thread-seconds of scattering and, with it, s = 0 and t = 0.
        seconds_extend: f64,
        /// Of which inside the ray queries.
        seconds_extend_rays: f64,
        /// Thread-seconds of connections and their weights.
        seconds_connect: f64,
        /// Thread-seconds of shadow rays.
        seconds_shadow: f64,
        /// Thread-seconds of the film.
        seconds_accumulate: f64,
        /// Of Markov chains: proposals.
        mutations: u64,
        /// How many became the state.
        accepted: u64,
        /// Light subpaths for each eye subpath.
        light_samples: u32,
        /// Plan `automatic`, after its pilot: part of the image by path tracing.
        share_path: f32,
        /// By the plan two-way.
        share_two_way: f32,
        /// By the plan one-to-one.
        share_one_to_one: f32,
        /// By the plan matrix.
        share_matrix: f32,
    }
);

stats!(
    /// What a technique (s,t) has done so far.
    TechniqueStats: bdpt_technique_stats {
        /// Connections that carried light, before their visibility was known.
        contributions: u64,
        /// Rays that tested a connection.
        shadow_rays: u64,
        /// Of these, those that met something.
        shadow_rays_blocked: u64,
        /// By the shadow rays' roulette.
        shadow_rays_skipped: u64,
        /// Share of the sum of all contributions, in \[0,1\].
        energy: f64,
        /// Share of the sum of their squares, in \[0,1\]: where noise comes from.
        squares: f64,
        /// Thread-seconds of connecting and of shadow rays.
        seconds: f64,
    }
);
