// SPDX-License-Identifier: Apache-2.0
//! Bidirectional path tracing, as a library.
#![deny(missing_docs, unsafe_op_in_unsafe_fn)]
#![warn(missing_debug_implementations)]

mod cancel;
mod context;
mod data;
mod error;
mod executor;
mod handle;
mod host;
mod id;
mod image;
mod output;
mod panics;
mod rect;
mod scene;
mod sensor;

pub use cancel::CancelToken;
pub use context::{version, Context, ContextInfo, ContextOptions, Isa, LogLevel};
pub use data::{Data, Element};
pub use error::{Error, ErrorCode, Result};
pub use executor::Executor;
pub use id::{InstanceId, LightId, MaterialId, MediumId, ShapeId, TextureId};
pub use image::{Image, TileView};
pub use output::{LightPaths, Output, OutputKind};
pub use rect::Rect;
pub use scene::Scene;
pub use sensor::Sensor;
