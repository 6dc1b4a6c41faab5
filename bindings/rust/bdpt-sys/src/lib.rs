// SPDX-License-Identifier: Apache-2.0

//! Declarations of `bdpt.h`, by hand. The header is the manual: shapes, units, ranges, errors, threads and ownership are
//! said there. The safe crate is `bdpt`; how this one finds the library is said in its readme.
//!
//! Names are those of C, but for fields named `type`, which are `type_` here. Enumerations are integers with constants,
//! as in C: values that a newer library gives must not be undefined behaviour. `Default` gives what C gives by
//! `{.struct_size = sizeof d}`.
//!
//! ```
//! use bdpt_sys::*;
//! let mut context = std::ptr::null_mut();
//! let result = unsafe { bdpt_context_create(BDPT_ABI, std::ptr::null(), &mut context) };
//! assert_eq!(result, BDPT_OK);
//! unsafe { bdpt_context_release(context) };
//! ```
#![allow(non_camel_case_types)]

/// Whether a library of ABI `abi`, as [`bdpt_abi_version`] tells it, has what is declared here.
/// [`bdpt_context_create`] refuses any other with [`BDPT_ERROR_ABI`].
pub const fn is_compatible(abi: u32) -> bool {
    abi == BDPT_ABI
}

/// A handle of the library, seen from outside only as a pointer.
macro_rules! opaque {
    ($name:ident) => {
        #[repr(C)]
        pub struct $name {
            _data: [u8; 0],
            _marker: core::marker::PhantomData<(*mut u8, core::marker::PhantomPinned)>,
        }
    };
}

/// Zero is the default of every field.
macro_rules! zeroed {
    ($name:ident) => {
        impl Default for $name {
            fn default() -> Self {
                // Numbers, nullable pointers and optional functions: zeros are a value of each.
                unsafe { core::mem::zeroed() }
            }
        }
    };
}

/// As `zeroed`, with struct_size set.
macro_rules! sized {
    ($name:ident) => {
        impl Default for $name {
            fn default() -> Self {
                // As for `zeroed`.
                let mut desc: Self = unsafe { core::mem::zeroed() };
                desc.struct_size = core::mem::size_of::<Self>() as u32;
                desc
            }
        }
    };
}

mod camera;
mod cancel;
mod color;
mod context;
mod curves;
mod custom;
mod data;
mod film;
mod host_material;
mod host_texture;
mod id;
mod image;
mod instance;
mod light;
mod lightmap;
mod lightmap_buffers;
mod material;
mod material_texture;
mod medium;
mod mesh;
mod output;
mod points;
mod render;
mod result;
mod scene;
mod sensor;
mod shape;
mod sky;
mod subdivision;
mod texture;
mod vertices;

pub use camera::*;
pub use cancel::*;
pub use color::*;
pub use context::*;
pub use curves::*;
pub use custom::*;
pub use data::*;
pub use film::*;
pub use host_material::*;
pub use host_texture::*;
pub use id::*;
pub use image::*;
pub use instance::*;
pub use light::*;
pub use lightmap::*;
pub use lightmap_buffers::*;
pub use material::*;
pub use material_texture::*;
pub use medium::*;
pub use mesh::*;
pub use output::*;
pub use points::*;
pub use render::*;
pub use result::*;
pub use scene::*;
pub use sensor::*;
pub use shape::*;
pub use sky::*;
pub use subdivision::*;
pub use texture::*;
pub use vertices::*;
