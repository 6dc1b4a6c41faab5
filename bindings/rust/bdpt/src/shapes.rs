// SPDX-License-Identifier: Apache-2.0
//! Spheres, curves and subdivision surfaces.

use crate::data::Data;
use crate::host::slice;
use crate::panics::catch_here;
use crate::plain::Plain;
use bdpt_sys as sys;
use std::fmt;
use std::os::raw::c_void;

/// An exact sphere. Instances of it may be rotated, moved and scaled alike in all directions.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_sphere(bdpt::Sphere::new([0.0, 1.0, 0.0], 0.5).label("ball"))?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Sphere {
    pub(crate) label: Option<String>,
    pub(crate) raw: Plain<sys::bdpt_sphere_desc>,
}

impl Sphere {
    /// A sphere round `center`, in the object's own frame. The radius is above 0.
    pub fn new(center: [f32; 3], radius: f32) -> Self {
        Self { label: None, raw: sys::bdpt_sphere_desc { center, radius, ..Default::default() }.into() }
    }
    labelled!();
}

enumeration!(
    /// How control points make [`Curves`].
    CurveBasis: bdpt_curve_basis {
        /// Cones that touch spheres round the control points: 2 points, and 1 for each further segment. Closed.
        Linear = BDPT_CURVE_LINEAR,
        /// Cubic: 4 points, and 3 for each further segment.
        Bezier = BDPT_CURVE_BEZIER,
        /// Cubic, uniform: 4 points, and 1 for each further segment.
        BSpline = BDPT_CURVE_BSPLINE,
        /// Cubic: 4 points, and 1 for each further segment; through all but a strand's ends.
        CatmullRom = BDPT_CURVE_CATMULL_ROM,
    }
);

/// Round curves, such as hair, as a set: one for all hair of a head is better than one for each. Texture coordinate u
/// goes along the strand from 0 to 1, v is 0.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{CurveBasis, Curves};
/// let points = vec![[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
/// let two_strands = Curves::new(CurveBasis::Linear, points, vec![0.01]).counts(vec![2, 2]);
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_curves(two_strands)?;
/// # Ok(()) }
/// ```
#[derive(Debug)]
pub struct Curves {
    pub(crate) label: Option<String>,
    basis: CurveBasis,
    positions: Data<[f32; 3]>,
    radii: Data<f32>,
    counts: Data<u32>,
}

impl Curves {
    /// Strands from control points, one strand after the other, and their radii: one for each point, or one for all.
    pub fn new(basis: CurveBasis, positions: impl Into<Data<[f32; 3]>>, radii: impl Into<Data<f32>>) -> Self {
        Self { label: None, basis, positions: positions.into(), radii: radii.into(), counts: Data::default() }
    }
    labelled!();
    /// Control points of each strand; without them there is one strand.
    pub fn counts(mut self, counts: impl Into<Data<u32>>) -> Self {
        self.counts = counts.into();
        self
    }
    pub(crate) fn look(&self) -> sys::bdpt_curves_desc {
        sys::bdpt_curves_desc {
            basis: self.basis.raw(),
            positions: self.positions.look(),
            radii: self.radii.look(),
            counts: self.counts.look(),
            ..Default::default()
        }
    }
}

enumeration!(
    /// What the boundary of a [`Subdivision`] surface does.
    Boundary: bdpt_boundary {
        /// Smooth curves, round at their corners.
        Smooth = BDPT_BOUNDARY_SMOOTH,
        /// Smooth, but for corners of one face, which stay where they are.
        PinCorners = BDPT_BOUNDARY_PIN_CORNERS,
        /// All of it stays where it is.
        Pin = BDPT_BOUNDARY_PIN,
    }
);

/// A place of a [`Subdivision`] surface that is to be displaced.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePlace {
    /// In the object's own frame.
    pub position: [f32; 3],
    /// Unit.
    pub normal: [f32; 3],
    /// Texture coordinates, set 0.
    pub uv: [f32; 2],
}

pub(crate) type Displace<'a> = Box<dyn FnMut(&SurfacePlace) -> [f32; 3] + 'a>;

/// A Catmull-Clark surface, which becomes a mesh of points of its limit. Its front is the side from which faces turn
/// counter-clockwise.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let leaf = bdpt::Subdivision::new(corners, vec![0, 1, 2, 3])
///     .level(4)
///     .creases(&[([0, 1], 2.0)])
///     .displace(|place| {
///         let [x, y, z] = place.position;
///         [x, y, z + 0.1 * (9.0 * x).sin()]
///     });
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_subdivision(leaf)?;
/// # Ok(()) }
/// ```
pub struct Subdivision<'a> {
    pub(crate) label: Option<String>,
    level: u32,
    positions: Data<[f32; 3]>,
    face_counts: Data<u32>,
    indices: Data<u32>,
    uv: Data<[f32; 2]>,
    uv_indices: Data<u32>,
    crease_edges: Data<u32>,
    crease_weights: Data<f32>,
    corners: Data<u32>,
    corner_weights: Data<f32>,
    boundary: Boundary,
    pub(crate) displace: Option<Displace<'a>>,
}

impl<'a> Subdivision<'a> {
    /// A surface of quadrilaterals, until [`face_counts`](Self::face_counts) are given: `indices` has the position of
    /// each corner, face after face. 8 segments to an edge.
    pub fn new(positions: impl Into<Data<[f32; 3]>>, indices: impl Into<Data<u32>>) -> Self {
        Self {
            label: None,
            level: 8,
            positions: positions.into(),
            face_counts: Data::default(),
            indices: indices.into(),
            uv: Data::default(),
            uv_indices: Data::default(),
            crease_edges: Data::default(),
            crease_weights: Data::default(),
            corners: Data::default(),
            corner_weights: Data::default(),
            boundary: Boundary::Smooth,
            displace: None,
        }
    }
    labelled!();
    /// Segments of each edge of a face, 1 to 64; even where a face has other than 4 corners.
    pub fn level(mut self, level: u32) -> Self {
        self.level = level;
        self
    }
    /// Corners of each face, 3 to 15.
    pub fn face_counts(mut self, counts: impl Into<Data<u32>>) -> Self {
        self.face_counts = counts.into();
        self
    }
    /// Texture coordinates, set 0: of the positions, until [`uv_indices`](Self::uv_indices) are given.
    pub fn uv(mut self, uv: impl Into<Data<[f32; 2]>>) -> Self {
        self.uv = uv.into();
        self
    }
    /// The texture coordinates of each corner, as many as indices.
    pub fn uv_indices(mut self, indices: impl Into<Data<u32>>) -> Self {
        self.uv_indices = indices.into();
        self
    }
    /// Edges, by two positions each, that so many steps of subdivision keep sharp; infinity = all.
    pub fn creases(mut self, creases: &[([u32; 2], f32)]) -> Self {
        self.crease_edges = creases.iter().flat_map(|(edge, _)| *edge).collect::<Vec<_>>().into();
        self.crease_weights = creases.iter().map(|(_, weight)| *weight).collect::<Vec<_>>().into();
        self
    }
    /// Positions that so many steps of subdivision keep sharp; infinity = all.
    pub fn corners(mut self, corners: &[(u32, f32)]) -> Self {
        self.corners = corners.iter().map(|(corner, _)| *corner).collect::<Vec<_>>().into();
        self.corner_weights = corners.iter().map(|(_, weight)| *weight).collect::<Vec<_>>().into();
        self
    }
    /// What the boundary does.
    pub fn boundary(mut self, boundary: Boundary) -> Self {
        self.boundary = boundary;
        self
    }
    /// Moves the surface's points: gives the new position of each, once, while the surface is added, on this thread.
    pub fn displace(mut self, displace: impl FnMut(&SurfacePlace) -> [f32; 3] + 'a) -> Self {
        self.displace = Some(Box::new(displace));
        self
    }
    /// `user` is `&mut self.displace`, where there is one.
    pub(crate) fn look(&self) -> sys::bdpt_subdivision_desc {
        sys::bdpt_subdivision_desc {
            level: self.level,
            positions: self.positions.look(),
            face_counts: self.face_counts.look(),
            indices: self.indices.look(),
            uv: self.uv.look(),
            uv_indices: self.uv_indices.look(),
            crease_edges: self.crease_edges.look(),
            crease_weights: self.crease_weights.look(),
            corners: self.corners.look(),
            corner_weights: self.corner_weights.look(),
            boundary: self.boundary.raw(),
            ..Default::default()
        }
    }
}

impl fmt::Debug for Subdivision<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Subdivision").field("label", &self.label).field("level", &self.level).finish_non_exhaustive()
    }
}

/// The callback of `bdpt_subdivision_desc`.
pub(crate) unsafe extern "C" fn displace(
    user: *mut c_void,
    count: u64,
    positions: *const f32,
    normals: *const f32,
    uv: *const f32,
    displaced: *mut f32,
) -> i32 {
    // SAFETY: the call that was given `user` is running, and calls back on its own thread, one call at a time.
    let function = unsafe { &mut *user.cast::<Displace<'_>>() };
    let count = count as usize;
    // SAFETY: packed arrays of `count` places, of floats, which live during the call; uv may be absent.
    let (positions, normals, uv, displaced) = unsafe {
        let positions = slice(positions.cast::<[f32; 3]>(), count);
        let normals = slice(normals.cast::<[f32; 3]>(), count);
        (
            positions,
            normals,
            slice(uv.cast::<[f32; 2]>(), count),
            crate::host::slice_mut(displaced.cast::<[f32; 3]>(), count),
        )
    };
    let done = catch_here(|| {
        for (i, ((position, normal), displaced)) in positions.iter().zip(normals).zip(displaced).enumerate() {
            let uv = uv.get(i).copied().unwrap_or_default();
            *displaced = function(&SurfacePlace { position: *position, normal: *normal, uv });
        }
    });
    i32::from(done.is_none())
}
