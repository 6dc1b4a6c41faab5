// SPDX-License-Identifier: Apache-2.0
//! Meshes in an atlas, to look at their lightmap coordinates and at the seams between charts.

use crate::count::array;
use crate::transform::Transform;
use bdpt_sys as sys;
use std::os::raw::c_void;

/// A mesh in the world and in an atlas. It borrows the mesh's arrays; none is copied.
///
/// ```
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let uv = [[0.1, 0.1], [0.9, 0.1], [0.1, 0.9]];
/// let left_half = bdpt::UvInstance::new(&positions, &uv).rectangle([0.5, 1.0], [0.0, 0.0]);
/// # let _ = left_half;
/// ```
#[derive(Clone, Copy, Debug)]
pub struct UvInstance<'a> {
    positions: &'a [[f32; 3]],
    uv: &'a [[f32; 2]],
    triangles: Triangles<'a>,
    normals: &'a [[f32; 3]],
    transform: Transform,
    scale: [f32; 2],
    offset: [f32; 2],
    atlas: u32,
}

#[derive(Clone, Copy, Debug)]
enum Triangles<'a> {
    /// Vertices 3i, 3i+1, 3i+2.
    InOrder,
    Small(&'a [[u16; 3]]),
    Large(&'a [[u32; 3]]),
}

impl<'a> UvInstance<'a> {
    /// A mesh with lightmap coordinates, one for each position. Without triangles each three vertices are one.
    pub fn new(positions: &'a [[f32; 3]], uv: &'a [[f32; 2]]) -> Self {
        Self {
            positions,
            uv,
            triangles: Triangles::InOrder,
            normals: &[],
            transform: Transform::IDENTITY,
            scale: [0.0; 2],
            offset: [0.0; 2],
            atlas: 0,
        }
    }
    /// Its triangles.
    pub fn triangles(mut self, triangles: &'a [[u32; 3]]) -> Self {
        self.triangles = Triangles::Large(triangles);
        self
    }
    /// Its triangles, by 16-bit indices.
    pub fn small_triangles(mut self, triangles: &'a [[u16; 3]]) -> Self {
        self.triangles = Triangles::Small(triangles);
        self
    }
    /// Its normals, one for each position, by which seams tell smooth edges from creases.
    pub fn normals(mut self, normals: &'a [[f32; 3]]) -> Self {
        self.normals = normals;
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
    pub(crate) fn triangle_count(&self) -> usize {
        match self.triangles {
            Triangles::InOrder => self.positions.len() / 3,
            Triangles::Small(triangles) => triangles.len(),
            Triangles::Large(triangles) => triangles.len(),
        }
    }
}

/// Descriptions of instances. They point at one another and at what the instances borrow.
pub(crate) struct RawInstances<'a> {
    // Behind a Vec, so that the addresses in `instances` stay when this moves.
    _meshes: Vec<sys::bdpt_mesh_desc>,
    instances: Vec<sys::bdpt_uv_instance>,
    _borrowed: std::marker::PhantomData<&'a ()>,
}

impl<'a> RawInstances<'a> {
    pub(crate) fn new(instances: &[UvInstance<'a>]) -> Self {
        let meshes: Vec<_> = instances.iter().map(mesh).collect();
        let instances = (instances.iter().zip(&meshes)).map(|(one, mesh)| sys::bdpt_uv_instance {
            mesh,
            transform: one.transform.into(),
            uv_scale: one.scale,
            uv_offset: one.offset,
            atlas: one.atlas,
            reserved: 0,
        });
        Self { instances: instances.collect(), _meshes: meshes, _borrowed: std::marker::PhantomData }
    }
    pub(crate) fn len(&self) -> usize {
        self.instances.len()
    }
    /// Valid as long as `self`, and what the instances borrow.
    pub(crate) fn as_ptr(&self) -> *const sys::bdpt_uv_instance {
        array(&self.instances)
    }
}

/// Only looked at: the library copies nothing and calls no release.
fn mesh(one: &UvInstance<'_>) -> sys::bdpt_mesh_desc {
    let mut desc = sys::bdpt_mesh_desc {
        positions: data(one.positions, sys::BDPT_FORMAT_FLOAT3),
        indices: match one.triangles {
            Triangles::InOrder => sys::bdpt_data::default(),
            Triangles::Small(triangles) => data(triangles, sys::BDPT_FORMAT_UINT16X3),
            Triangles::Large(triangles) => data(triangles, sys::BDPT_FORMAT_UINT32X3),
        },
        normals: data(one.normals, sys::BDPT_FORMAT_FLOAT3),
        ..Default::default()
    };
    desc.uv[1] = data(one.uv, sys::BDPT_FORMAT_FLOAT2);
    desc
}

fn data<T>(array: &[T], format: sys::bdpt_format) -> sys::bdpt_data {
    if array.is_empty() {
        return sys::bdpt_data::default();
    }
    let (data, count) = (array.as_ptr() as *const c_void, array.len() as u64);
    sys::bdpt_data { data, count, format, ..Default::default() }
}
