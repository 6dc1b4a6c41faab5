//! Declarations of `bdpt.h`, by hand. The header is the manual; the safe crate is `bdpt`.
#![allow(non_camel_case_types)]

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
                let mut desc: Self = unsafe { core::mem::zeroed() };
                desc.struct_size = core::mem::size_of::<Self>() as u32;
                desc
            }
        }
    };
}

mod cancel;
mod color;
mod context;
mod film;
mod image;
mod lightmap_buffers;
mod render;
mod result;
mod scene;
mod sensor;

pub use cancel::*;
pub use color::*;
pub use context::*;
pub use film::*;
pub use image::*;
pub use lightmap_buffers::*;
pub use render::*;
pub use result::*;
pub use scene::*;
pub use sensor::*;
