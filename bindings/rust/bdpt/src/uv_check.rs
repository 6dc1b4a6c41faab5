// SPDX-License-Identifier: Apache-2.0
//! What is wrong with lightmap coordinates, and what they are like.

use crate::count::{bytes, count, zeros};
use crate::error::{check, Result};
use crate::uv::{RawInstances, UvInstance};
use bdpt_sys as sys;
use std::ptr::null;

/// Looks at the lightmap coordinates of an atlas.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Transform, UvCheck, UvInstance};
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let uv = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]];
/// let square = UvInstance::new(&positions, &uv).small_triangles(&[[0, 1, 2], [0, 2, 3]]);
/// let report = UvCheck::new(64, 64).run(&[square])?;
/// assert_eq!((report.charts, report.overlaps_within, report.texels_shared), (1, 0, 0));
/// assert!((report.density_mean - 0.8 * 64.0).abs() < 1e-2);
/// // The same place twice: the two instances overlap.
/// let there = square.transform(Transform::translate([5.0, 0.0, 0.0]));
/// assert!(UvCheck::new(64, 64).run(&[square, there])?.overlaps_between >= 2);
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct UvCheck {
    width: u32,
    height: u32,
    atlas: u32,
    padding_reach: u32,
    max_overlaps: u64,
}

/// What [`UvCheck`] found.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvReport {
    /// Fewest free texels between two charts, along rows, columns or diagonals; 0 if charts touch or share a texel;
    /// `None` when no two charts are within reach.
    pub padding: Option<u32>,
    /// Triangles in this atlas.
    pub triangles: u64,
    /// Triangles of an instance are of one chart if they share a vertex: the same point in the world and in the atlas.
    pub charts: u64,
    /// Triangles that leave their instance's rectangle by more than 1/1000 texel.
    pub outside_rectangle: u64,
    /// Triangles that leave the atlas by more than 1/1000 texel.
    pub outside_atlas: u64,
    /// Triangles of less than a millionth of a texel.
    pub zero_area_uv: u64,
    /// Triangles without area in the world, but for rounding.
    pub zero_area_world: u64,
    /// Triangles that show the atlas mirrored when seen from the front.
    pub mirrored: u64,
    /// Texels that a chart touches, further in than 1/1000 texel.
    pub texels_claimed: u64,
    /// Texels that two charts or more touch: light leaks from one to the other.
    pub texels_shared: u64,
    /// Pairs of triangles of one chart that overlap: a chart that folds over.
    pub overlaps_within: u64,
    /// Pairs of triangles of two charts that overlap.
    pub overlaps_between: u64,
    /// What triangles of one chart share, in texels, added up over the pairs.
    pub overlap_area_within: f64,
    /// What triangles of two charts share, in texels, added up over the pairs.
    pub overlap_area_between: f64,
    /// Texels per world unit where there are fewest; 0 where no triangle has an area in both.
    pub density_min: f32,
    /// Texels per world unit: root of the ratio of the sums of both areas.
    pub density_mean: f32,
    /// Texels per world unit where there are most.
    pub density_max: f32,
    /// There are more pairs that overlap than were looked for.
    pub overlaps_cut: bool,
}

/// Maps that [`UvCheck::run_with_maps`] makes. Those of texels are in rows.
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct UvMaps {
    /// Chart of each triangle, from 1, instance after instance; 0 in other atlases.
    pub triangle_charts: Vec<u32>,
    /// The chart with the largest part of the texel; 0 = none.
    pub texel_charts: Vec<u32>,
    /// How many charts touch the texel.
    pub texel_claims: Vec<u32>,
    /// How many pairs of triangles overlap in the texel.
    pub texel_overlaps: Vec<u32>,
}

impl UvCheck {
    /// Of an atlas of so many texels, 1 to 65536 along each side, and at most 2^28 together.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, atlas: 0, padding_reach: 0, max_overlaps: 0 }
    }
    /// The atlas to look at: instances in others are passed over.
    pub fn atlas(mut self, atlas: u32) -> Self {
        self.atlas = atlas;
        self
    }
    /// Looks for charts that are so many texels apart, 1 to 1024; 16 by default.
    pub fn padding_reach(mut self, texels: u32) -> Self {
        self.padding_reach = texels;
        self
    }
    /// Stops looking after so many pairs of triangles that overlap; a million by default.
    pub fn max_overlaps(mut self, pairs: u64) -> Self {
        self.max_overlaps = pairs;
        self
    }
    /// Looks at the instances.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) also for triangles that cover the atlas more than 256
    /// times: coordinates that are not for lightmaps.
    pub fn run(&self, instances: &[UvInstance<'_>]) -> Result<UvReport> {
        self.run_into(instances, None)
    }
    /// Looks at the instances, and tells where.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    pub fn run_with_maps(&self, instances: &[UvInstance<'_>]) -> Result<(UvReport, UvMaps)> {
        // A size out of range is refused before there is memory for it.
        let texels = u64::from(self.width) * u64::from(self.height);
        let texels = if texels > 1 << 28 { 0 } else { texels };
        let triangles = instances.iter().map(|one| one.triangle_count()).sum();
        let mut maps = UvMaps {
            triangle_charts: zeros(triangles, 0, "charts of triangles")?,
            texel_charts: zeros(texels, 0, "charts of texels")?,
            texel_claims: zeros(texels, 0, "claims of texels")?,
            texel_overlaps: zeros(texels, 0, "overlaps of texels")?,
        };
        let report = self.run_into(instances, Some(&mut maps))?;
        Ok((report, maps))
    }

    fn run_into(&self, instances: &[UvInstance<'_>], maps: Option<&mut UvMaps>) -> Result<UvReport> {
        let instances = RawInstances::new(instances);
        let desc = sys::bdpt_uv_check_desc {
            instance_count: count(instances.len(), "instances")?,
            instances: instances.as_ptr(),
            atlas: self.atlas,
            width: self.width,
            height: self.height,
            padding_reach: self.padding_reach,
            max_overlaps: self.max_overlaps,
            ..Default::default()
        };
        let maps = maps.map(|maps| sys::bdpt_uv_maps {
            triangle_charts_capacity: bytes(&maps.triangle_charts),
            triangle_charts: maps.triangle_charts.as_mut_ptr(),
            texel_charts_capacity: bytes(&maps.texel_charts),
            texel_charts: maps.texel_charts.as_mut_ptr(),
            texel_claims_capacity: bytes(&maps.texel_claims),
            texel_claims: maps.texel_claims.as_mut_ptr(),
            texel_overlaps_capacity: bytes(&maps.texel_overlaps),
            texel_overlaps: maps.texel_overlaps.as_mut_ptr(),
            ..Default::default()
        });
        let mut raw = sys::bdpt_uv_report::default();
        let maps = maps.as_ref().map_or(null(), |maps| maps);
        // SAFETY: what the descriptions point to lives until the call returns; each capacity is that of its buffer.
        check(unsafe { sys::bdpt_uv_check(&desc, maps, &mut raw) })?;
        Ok(UvReport {
            padding: u32::try_from(raw.padding).ok(),
            triangles: raw.triangles,
            charts: raw.charts,
            outside_rectangle: raw.outside_rect,
            outside_atlas: raw.outside_atlas,
            zero_area_uv: raw.zero_area_uv,
            zero_area_world: raw.zero_area_world,
            mirrored: raw.mirrored,
            texels_claimed: raw.texels_claimed,
            texels_shared: raw.texels_shared,
            overlaps_within: raw.overlaps_within,
            overlaps_between: raw.overlaps_between,
            overlap_area_within: raw.overlap_area_within,
            overlap_area_between: raw.overlap_area_between,
            density_min: raw.density_min,
            density_mean: raw.density_mean,
            density_max: raw.density_max,
            overlaps_cut: raw.overlaps_cut != 0,
        })
    }
}
