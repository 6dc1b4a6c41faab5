// SPDX-License-Identifier: Apache-2.0

//! Outputs of sensors: what is measured

/// A measurement is a texel or a point; it has one or more outputs, all sampled at once; an output is one or more
/// planes of the film, of three colours each.
pub type bdpt_output_kind = i32;

/// 1 plane: E = INT L max(0, w·n) dw \[W/m²\]
pub const BDPT_OUTPUT_IRRADIANCE: bdpt_output_kind = 0;

/// 1 plane: E / pi, what a diffuse surface of albedo 1 would emit
pub const BDPT_OUTPUT_IRRADIANCE_OVER_PI: bdpt_output_kind = 1;

/// 4 planes: c_lm = INT L Y_lm(w) dw for l \<= 1, over the hemisphere of n (all directions, for points without normal)
pub const BDPT_OUTPUT_RADIANCE_SH1: bdpt_output_kind = 2;

/// 9 planes: l \<= 2
pub const BDPT_OUTPUT_RADIANCE_SH2: bdpt_output_kind = 3;

/// 4 planes: c_lm times pi, 2 pi / 3 for l = 0, 1: the irradiance of a surface with normal m is about SUM of these
/// times Y_lm(m)
pub const BDPT_OUTPUT_IRRADIANCE_SH1: bdpt_output_kind = 4;

/// 9 planes: and times pi / 4 for l = 2
pub const BDPT_OUTPUT_IRRADIANCE_SH2: bdpt_output_kind = 5;

/// 1 plane: INT L dw \[W/m²\]
pub const BDPT_OUTPUT_FLUENCE: bdpt_output_kind = 6;

/// 1 plane: 1 / pi INT V max(0, w·n) dw, in \[0,1\]: ambient occlusion is one less this
pub const BDPT_OUTPUT_OPENNESS: bdpt_output_kind = 7;

/// 1 plane: INT V w max(0, w·n) dw, x, y and z in place of colours; of any length
pub const BDPT_OUTPUT_BENT_NORMAL: bdpt_output_kind = 8;

/// 4 planes: INT V Y_lm(w) dw
pub const BDPT_OUTPUT_OPENNESS_SH1: bdpt_output_kind = 9;

/// 9 planes
pub const BDPT_OUTPUT_OPENNESS_SH2: bdpt_output_kind = 10;

/// 1 plane: the part of all rays that do not meet the back of a one-sided surface: near 0 inside of closed meshes
pub const BDPT_OUTPUT_FRONTS: bdpt_output_kind = 11;

/// size² planes: the mean of L over the texel's directions
pub const BDPT_OUTPUT_RADIANCE_OCTAHEDRAL: bdpt_output_kind = 12;

/// size² planes: INT L max(0, w·m) dw, m the direction of the middle
pub const BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL: bdpt_output_kind = 13;

/// size² planes; in place of colours the means of d, d² and 1 - V, d the distance of what is seen, or reach where that
/// is less
pub const BDPT_OUTPUT_DISTANCE_OCTAHEDRAL: bdpt_output_kind = 14;

/// 1 plane: the direct part of E as if nothing were in its way \[W/m²\], whatever paths says; of all kinds of lights,
/// by direct lighting alone, whatever techniques take part: it costs no ray. A shadow mask of group g is IRRADIANCE
/// with BDPT_LIGHT_PATHS_DIRECT over this, both of group g; 1 where both are 0
pub const BDPT_OUTPUT_UNSHADOWED: bdpt_output_kind = 15;

/// the part of the picture that paths and groups name. DIRECT is light of at most two edges: that of lights that are
/// seen, and that of one reflection
pub const BDPT_OUTPUT_RADIANCE: bdpt_output_kind = 16;

/// the part of light, in \[0,1\], that the surface sends on, reflected or transmitted, for the direction from which it
/// is seen: of a diffuse surface its reflectance
pub const BDPT_OUTPUT_ALBEDO: bdpt_output_kind = 17;

/// x, y, z: the shading normal, in the world, on the side that is seen
pub const BDPT_OUTPUT_NORMAL: bdpt_output_kind = 18;

/// in place of colours the means of d, d² and 1: d the distance from the camera along its axis; of fisheyes and
/// panoramas, the distance from the point. The first over the third is the mean of what is seen
pub const BDPT_OUTPUT_DEPTH: bdpt_output_kind = 19;

/// x, y, z in the world
pub const BDPT_OUTPUT_POSITION: bdpt_output_kind = 20;

/// no plane: whose surfaces the samples met, bdpt_instance_id; see bdpt_film_read_coverage
pub const BDPT_OUTPUT_INSTANCE_COVERAGE: bdpt_output_kind = 21;

/// the same, bdpt_material_id. Of each of these two a camera has one at most
pub const BDPT_OUTPUT_MATERIAL_COVERAGE: bdpt_output_kind = 22;

/// bdpt_plane_info: a camera's pixels, or a measurement of your own
pub const BDPT_OUTPUT_NONE: bdpt_output_kind = -1;

pub type bdpt_light_paths = i32;
pub const BDPT_LIGHT_PATHS_ALL: bdpt_light_paths = 0;

/// light that comes straight from where it is emitted to what is measured or seen
pub const BDPT_LIGHT_PATHS_DIRECT: bdpt_light_paths = 1;

/// all other
pub const BDPT_LIGHT_PATHS_INDIRECT: bdpt_light_paths = 2;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_output_desc {
    pub struct_size: u32,
    pub kind: bdpt_output_kind,
    pub paths: bdpt_light_paths,
    pub reach: f32,
    pub groups: u64,
    pub size: u32,
    pub unfiltered: u32,
}
sized!(bdpt_output_desc);

/// What a plane of the film measures.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_plane_info {
    pub struct_size: u32,
    pub kind: bdpt_output_kind,
    pub paths: bdpt_light_paths,
    pub reach: f32,
    pub groups: u64,
    pub output: u32,
    pub coefficient: u32,
    pub reserved: u64,
}
sized!(bdpt_plane_info);
