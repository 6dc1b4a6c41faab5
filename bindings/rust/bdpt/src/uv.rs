// SPDX-License-Identifier: Apache-2.0
//! Meshes in an atlas, to look at their lightmap coordinates and at the seams between charts.

use crate::count::array;
use crate::mesh::Mesh;
use crate::transform::Transform;
use bdpt_sys as sys;
use std::marker::PhantomData;
use std::os::raw::c_void;

/// A mesh in the world and in an atlas: a [`Mesh`](crate::Mesh) that is not added yet, or arrays. None is copied.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let uv = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]];
/// let left_half = bdpt::UvInstance::new(&positions, &uv).rectangle([0.5, 1.0], [0.0, 0.0]);
///
/// let mesh = bdpt::Mesh::new(&positions).lightmap_uv(&uv);
/// let right_half = bdpt::UvInstance::from(&mesh).rectangle([0.5, 1.0], [0.5, 0.0]);
/// let report = bdpt::UvCheck::new(64, 64).run(&[left_half, right_half])?;
/// assert_eq!((report.charts, report.overlaps_between), (2, 0));
/// # Ok(()) }
/// ```
///
/// It must not outlive what it borrows:
///
/// ```compile_fail,E0597
/// let instance = {
///     let mesh = bdpt::Mesh::new(vec![[0.0; 3]; 3]);
///     bdpt::UvInstance::from(&mesh)
/// };
/// # bdpt::UvCheck::new(1, 1).run(&[instance]).ok();
/// ```
#[derive(Clone, Copy, Debug)]
pub struct UvInstance<'a> {
    /// Only looked at: the library copies nothing of it, and calls no release.
    mesh: sys::bdpt_mesh_desc,
    transform: Transform,
    scale: [f32; 2],
    offset: [f32; 2],
    atlas: u32,
    borrowed: PhantomData<(&'a Mesh, &'a [f32])>,
}

// SAFETY: `mesh` points into what is borrowed, which may be read from any thread.
unsafe impl Send for UvInstance<'_> {}
// SAFETY: as above.
unsafe impl Sync for UvInstance<'_> {}

/// By the mesh's lightmap coordinates.
impl<'a> From<&'a Mesh> for UvInstance<'a> {
    fn from(mesh: &'a Mesh) -> Self {
        Self::of(mesh.look())
    }
}

impl<'a> UvInstance<'a> {
    /// A mesh with lightmap coordinates, one for each position. Without triangles each three vertices are one.
    pub fn new(positions: &'a [[f32; 3]], uv: &'a [[f32; 2]]) -> Self {
        let positions = data(positions, sys::BDPT_FORMAT_FLOAT3);
        let uv = [sys::bdpt_data::default(), data(uv, sys::BDPT_FORMAT_FLOAT2)];
        Self::of(sys::bdpt_mesh_desc { positions, uv, ..Default::default() })
    }
    fn of(mesh: sys::bdpt_mesh_desc) -> Self {
        let (scale, offset) = ([0.0; 2], [0.0; 2]);
        Self { mesh, transform: Transform::IDENTITY, scale, offset, atlas: 0, borrowed: PhantomData }
    }
    /// Its triangles.
    pub fn triangles(mut self, triangles: &'a [[u32; 3]]) -> Self {
        self.mesh.indices = data(triangles, sys::BDPT_FORMAT_UINT32X3);
        self
    }
    /// Its triangles, by 16-bit indices.
    pub fn small_triangles(mut self, triangles: &'a [[u16; 3]]) -> Self {
        self.mesh.indices = data(triangles, sys::BDPT_FORMAT_UINT16X3);
        self
    }
    /// Its normals, one for each position, by which seams tell smooth edges from creases.
    pub fn normals(mut self, normals: &'a [[f32; 3]]) -> Self {
        self.mesh.normals = data(normals, sys::BDPT_FORMAT_FLOAT3);
        self
    }
    /// Object to world, invertible; the identity by default.
    pub fn transform(mut self, transform: Transform) -> Self {
        self.transform = transform;
        self
    }
    /// Its rectangle in the atlas: coordinates times `scale` plus `offset` are the place there. All of it by default.
    pub fn rectangle(mut self, scale: [f32; 2], offset: [f32; 2]) -> Self {
        self.scale = scale;
        self.offset = offset;
        self
    }
    /// Which atlas it is in, from 0.
    pub fn atlas(mut self, atlas: u32) -> Self {
        self.atlas = atlas;
        self
    }
    /// How many triangles it has.
    pub(crate) fn triangle_count(&self) -> u64 {
        match self.mesh.indices.count {
            0 => self.mesh.positions.count / 3,
            count => count,
        }
    }
}

/// Descriptions of instances, which point at the instances' meshes.
pub(crate) struct RawInstances<'a> {
    instances: Vec<sys::bdpt_uv_instance>,
    borrowed: PhantomData<&'a ()>,
}

impl<'a> RawInstances<'a> {
    pub(crate) fn new(instances: &'a [UvInstance<'_>]) -> Self {
        let instances = instances.iter().map(|one| sys::bdpt_uv_instance {
            mesh: &one.mesh,
            transform: one.transform.into(),
            uv_scale: one.scale,
            uv_offset: one.offset,
            atlas: one.atlas,
            reserved: 0,
        });
        Self { instances: instances.collect(), borrowed: PhantomData }
    }
    pub(crate) fn len(&self) -> usize {
        self.instances.len()
    }
    /// Valid as long as `self`.
    pub(crate) fn as_ptr(&self) -> *const sys::bdpt_uv_instance {
        array(&self.instances)
    }
}

fn data<T>(array: &[T], format: sys::bdpt_format) -> sys::bdpt_data {
    if array.is_empty() {
        return sys::bdpt_data::default();
    }
    let (data, count) = (array.as_ptr() as *const c_void, array.len() as u64);
    sys::bdpt_data { data, count, format, ..Default::default() }
}
