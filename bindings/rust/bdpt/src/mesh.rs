// SPDX-License-Identifier: Apache-2.0
//! Triangle meshes.

use crate::data::Data;
use crate::error::{Result, Text};
use crate::panics::Panics;
use bdpt_sys as sys;

/// A triangle mesh. Its front is the side from which its vertices turn counter-clockwise; where vertex normals are
/// given, the side they point to.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
/// let square = bdpt::Mesh::new(corners).indices(vec![[0_u32, 1, 2], [0, 2, 3]]).label("square");
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_mesh(square)?;
/// # Ok(()) }
/// ```
#[derive(Debug, Default)]
pub struct Mesh {
    label: Option<String>,
    positions: Data<[f32; 3]>,
    indices: Indices,
    normals: Data<[f32; 3]>,
    uv: [Data<[f32; 2]>; 2],
    colors: Colors,
    tangents: Data<[f32; 4]>,
}

/// Three vertices for each triangle of a [`Mesh`], as 16 or 32 bits.
#[non_exhaustive]
#[derive(Debug)]
pub enum Indices {
    /// Of meshes of at most 65536 vertices.
    U16(Data<[u16; 3]>),
    /// Of all meshes.
    U32(Data<[u32; 3]>),
}

impl Default for Indices {
    fn default() -> Self {
        Self::U32(Data::default())
    }
}
macro_rules! indices {
    ($($from:ty => $kind:ident),*) => {
        $(impl From<$from> for Indices {
            fn from(indices: $from) -> Self {
                Self::$kind(indices.into())
            }
        })*
    };
}
indices!(Vec<[u32; 3]> => U32, std::sync::Arc<[[u32; 3]]> => U32, &[[u32; 3]] => U32, Data<[u32; 3]> => U32);
indices!(Vec<[u16; 3]> => U16, std::sync::Arc<[[u16; 3]]> => U16, &[[u16; 3]] => U16, Data<[u16; 3]> => U16);

/// A colour for each vertex of a [`Mesh`], with or without opacity.
#[non_exhaustive]
#[derive(Debug)]
pub enum Colors {
    /// Red, green, blue.
    Rgb(Data<[f32; 3]>),
    /// And opacity.
    Rgba(Data<[f32; 4]>),
}

impl Default for Colors {
    fn default() -> Self {
        Self::Rgb(Data::default())
    }
}
macro_rules! colors {
    ($($from:ty => $kind:ident),*) => {
        $(impl From<$from> for Colors {
            fn from(colors: $from) -> Self {
                Self::$kind(colors.into())
            }
        })*
    };
}
colors!(Vec<[f32; 3]> => Rgb, std::sync::Arc<[[f32; 3]]> => Rgb, &[[f32; 3]] => Rgb, Data<[f32; 3]> => Rgb);
colors!(Vec<[f32; 4]> => Rgba, std::sync::Arc<[[f32; 4]]> => Rgba, &[[f32; 4]] => Rgba, Data<[f32; 4]> => Rgba);

impl Mesh {
    /// A mesh whose triangles are vertices 3i, 3i + 1, 3i + 2 until [`indices`](Self::indices) are given.
    pub fn new(positions: impl Into<Data<[f32; 3]>>) -> Self {
        Self { positions: positions.into(), ..Default::default() }
    }
    labelled!();
    /// Three vertices for each triangle.
    pub fn indices(mut self, indices: impl Into<Indices>) -> Self {
        self.indices = indices.into();
        self
    }
    /// A normal for each vertex, of any length but zero; without them the mesh is flat.
    pub fn normals(mut self, normals: impl Into<Data<[f32; 3]>>) -> Self {
        self.normals = normals.into();
        self
    }
    /// Set 0 of texture coordinates: what textures and the anisotropic direction take by default.
    pub fn uv(mut self, uv: impl Into<Data<[f32; 2]>>) -> Self {
        self.uv[0] = uv.into();
        self
    }
    /// Set 1 of texture coordinates: what lightmaps take by default.
    pub fn lightmap_uv(mut self, uv: impl Into<Data<[f32; 2]>>) -> Self {
        self.uv[1] = uv.into();
        self
    }
    /// A colour for each vertex, in \[0,1\], linear: multiplies the reflectance of the instance's material, and the
    /// fourth number its opacity.
    pub fn colors(mut self, colors: impl Into<Colors>) -> Self {
        self.colors = colors.into();
        self
    }
    /// For each vertex where x of normal maps points, and the sign of y: y = sign * normal x tangent. Without them it
    /// is along u.
    pub fn tangents(mut self, tangents: impl Into<Data<[f32; 4]>>) -> Self {
        self.tangents = tangents.into();
        self
    }

    pub(crate) fn label_text(&self) -> Result<Text> {
        Text::new(&self.label)
    }

    /// For calls that read a mesh and keep nothing of it: valid as long as `self`.
    pub(crate) fn look(&self) -> sys::bdpt_mesh_desc {
        sys::bdpt_mesh_desc {
            positions: self.positions.look(),
            indices: match &self.indices {
                Indices::U16(indices) => indices.look(),
                Indices::U32(indices) => indices.look(),
            },
            normals: self.normals.look(),
            uv: [self.uv[0].look(), self.uv[1].look()],
            colors: match &self.colors {
                Colors::Rgb(colors) => colors.look(),
                Colors::Rgba(colors) => colors.look(),
            },
            tangents: self.tangents.look(),
            ..Default::default()
        }
    }

    /// For the one call that takes it.
    pub(crate) fn lend(self, label: &Text, panics: &Panics) -> sys::bdpt_mesh_desc {
        let [uv, lightmap_uv] = self.uv;
        sys::bdpt_mesh_desc {
            label: label.as_ptr(),
            positions: self.positions.lend_with_slack(panics),
            indices: match self.indices {
                Indices::U16(indices) => indices.lend(panics),
                Indices::U32(indices) => indices.lend_with_slack(panics),
            },
            normals: self.normals.lend(panics),
            uv: [uv.lend(panics), lightmap_uv.lend(panics)],
            colors: match self.colors {
                Colors::Rgb(colors) => colors.lend(panics),
                Colors::Rgba(colors) => colors.lend(panics),
            },
            tangents: self.tangents.lend(panics),
            ..Default::default()
        }
    }
}
