// SPDX-License-Identifier: Apache-2.0

//! Compares the declarations of `bdpt-sys` with `bdpt.h` as the C compiler sees it; see the tests.
//!
//! [`rust`] reads the declarations, [`mirror`] writes them as C that only compiles if the header says the same, [`header`]
//! lists what the header has, and [`names`] what one has and the other lacks.

pub mod compiler;
pub mod header;
pub mod mirror;
pub mod names;
pub mod rust;
pub mod token;

use std::path::PathBuf;

/// What docs/rust.md shows is run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/rust.md")]
pub struct Guide;

/// As above.
#[cfg(doctest)]
#[doc = include_str!("../../bdpt/README.md")]
pub struct Readme;

/// The folder of the declarations.
pub fn declarations() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../bdpt-sys/src"))
}

/// The folder of the header.
pub fn include() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../bdpt-sys/bdpt/include"))
}
