// SPDX-License-Identifier: Apache-2.0
//! What sensors measure: outputs of cameras, lightmaps and points.

use bdpt_sys as sys;

/// What an [`Output`] measures. `bdpt.h` defines each.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OutputKind {
    /// 1 plane: W/m². Of surfaces and points with a normal.
    Irradiance,
    /// 1 plane: what a diffuse surface of albedo 1 would emit.
    IrradianceOverPi,
    /// 4 planes.
    RadianceSh1,
    /// 9 planes.
    RadianceSh2,
    /// 4 planes.
    IrradianceSh1,
    /// 9 planes.
    IrradianceSh2,
    /// 1 plane: radiance over all directions, W/m².
    Fluence,
    /// 1 plane: 1 less ambient occlusion.
    Openness,
    /// 1 plane: x, y and z in place of colours.
    BentNormal,
    /// 4 planes.
    OpennessSh1,
    /// 9 planes.
    OpennessSh2,
    /// 1 plane: near 0 inside of closed meshes.
    Fronts,
    /// size² planes: the mean radiance over a texel's directions.
    RadianceOctahedral,
    /// size² planes.
    IrradianceOctahedral,
    /// size² planes: the means of the distance and its square, and how much is within reach.
    DistanceOctahedral,
    /// 1 plane: direct irradiance as if nothing were in its way.
    Unshadowed,
    /// Of cameras, 1 plane: the part of the picture that paths and groups name.
    Radiance,
    /// Of cameras, 1 plane: how much of light the surface seen sends on.
    Albedo,
    /// Of cameras, 1 plane: the shading normal in the world.
    Normal,
    /// Of cameras, 1 plane: the means of the distance d, of d² and of 1.
    Depth,
    /// Of cameras, 1 plane: the place seen, in the world.
    Position,
    /// Of cameras, no plane: see [`Film::read_coverage`](crate::Film::read_coverage).
    InstanceCoverage,
    /// Of cameras, no plane: see [`Film::read_coverage`](crate::Film::read_coverage).
    MaterialCoverage,
    /// A camera's picture, or a measurement of your own. Not to be asked for.
    None,
    /// One that this version of the crate does not know.
    Other(i32),
}

macro_rules! kinds {
    ($($kind:ident = $raw:ident),* $(,)?) => {
        impl OutputKind {
            pub(crate) fn new(raw: sys::bdpt_output_kind) -> Self {
                match raw {
                    $(sys::$raw => Self::$kind,)*
                    other => Self::Other(other),
                }
            }
            pub(crate) fn raw(self) -> sys::bdpt_output_kind {
                match self {
                    $(Self::$kind => sys::$raw,)*
                    Self::Other(other) => other,
                }
            }
        }
    };
}

kinds!(
    Irradiance = BDPT_OUTPUT_IRRADIANCE,
    IrradianceOverPi = BDPT_OUTPUT_IRRADIANCE_OVER_PI,
    RadianceSh1 = BDPT_OUTPUT_RADIANCE_SH1,
    RadianceSh2 = BDPT_OUTPUT_RADIANCE_SH2,
    IrradianceSh1 = BDPT_OUTPUT_IRRADIANCE_SH1,
    IrradianceSh2 = BDPT_OUTPUT_IRRADIANCE_SH2,
    Fluence = BDPT_OUTPUT_FLUENCE,
    Openness = BDPT_OUTPUT_OPENNESS,
    BentNormal = BDPT_OUTPUT_BENT_NORMAL,
    OpennessSh1 = BDPT_OUTPUT_OPENNESS_SH1,
    OpennessSh2 = BDPT_OUTPUT_OPENNESS_SH2,
    Fronts = BDPT_OUTPUT_FRONTS,
    RadianceOctahedral = BDPT_OUTPUT_RADIANCE_OCTAHEDRAL,
    IrradianceOctahedral = BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL,
    DistanceOctahedral = BDPT_OUTPUT_DISTANCE_OCTAHEDRAL,
    Unshadowed = BDPT_OUTPUT_UNSHADOWED,
    Radiance = BDPT_OUTPUT_RADIANCE,
    Albedo = BDPT_OUTPUT_ALBEDO,
    Normal = BDPT_OUTPUT_NORMAL,
    Depth = BDPT_OUTPUT_DEPTH,
    Position = BDPT_OUTPUT_POSITION,
    InstanceCoverage = BDPT_OUTPUT_INSTANCE_COVERAGE,
    MaterialCoverage = BDPT_OUTPUT_MATERIAL_COVERAGE,
    None = BDPT_OUTPUT_NONE,
);

/// Which light counts, by its way.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LightPaths {
    /// All.
    All,
    /// Straight from where it is emitted to what is measured or seen.
    Direct,
    /// All other.
    Indirect,
    /// One that this version of the crate does not know.
    Other(i32),
}

impl LightPaths {
    pub(crate) fn new(raw: sys::bdpt_light_paths) -> Self {
        match raw {
            sys::BDPT_LIGHT_PATHS_ALL => Self::All,
            sys::BDPT_LIGHT_PATHS_DIRECT => Self::Direct,
            sys::BDPT_LIGHT_PATHS_INDIRECT => Self::Indirect,
            other => Self::Other(other),
        }
    }
    pub(crate) fn raw(self) -> sys::bdpt_light_paths {
        match self {
            Self::All => sys::BDPT_LIGHT_PATHS_ALL,
            Self::Direct => sys::BDPT_LIGHT_PATHS_DIRECT,
            Self::Indirect => sys::BDPT_LIGHT_PATHS_INDIRECT,
            Self::Other(other) => other,
        }
    }
}

/// One thing that a sensor measures beside others, of the same samples.
///
/// ```
/// use bdpt::{LightPaths, Output, OutputKind};
/// let shadows = Output::new(OutputKind::Irradiance).paths(LightPaths::Direct).groups(1 << 3);
/// let open = Output::new(OutputKind::Openness).reach(2.5);
/// # let _ = (shadows, open);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Output {
    raw: sys::bdpt_output_desc,
}

impl Output {
    /// An output of all light.
    pub fn new(kind: OutputKind) -> Self {
        Self { raw: sys::bdpt_output_desc { kind: kind.raw(), ..Default::default() } }
    }
    /// Which light counts, by its way.
    pub fn paths(mut self, paths: LightPaths) -> Self {
        self.raw.paths = paths.raw();
        self
    }
    /// Of openness: beyond this nothing counts; 0 = without end. Of distances: the largest, above 0.
    pub fn reach(mut self, reach: f32) -> Self {
        self.raw.reach = reach;
        self
    }
    /// Which light counts, by its group: bit g for group g; 0 = all.
    pub fn groups(mut self, groups: u64) -> Self {
        self.raw.groups = groups;
        self
    }
    /// Of octahedral outputs: texels along a side, 1 to 32; 8 by default.
    pub fn size(mut self, size: u32) -> Self {
        self.raw.size = size;
        self
    }
    /// Of cameras: a sample counts for its own pixel alone, whatever the film's filter, as denoisers need it.
    pub fn unfiltered(mut self, unfiltered: bool) -> Self {
        self.raw.unfiltered = unfiltered.into();
        self
    }
    pub(crate) fn raw(&self) -> sys::bdpt_output_desc {
        self.raw
    }
}
