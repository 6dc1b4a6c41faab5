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

mod color;
mod count;
mod custom;
mod denoise;
mod dilate;
mod display;
mod encode;
mod exposure;
mod exr;
mod lightmap;
mod points;
mod seams;
mod sky;
mod uv;
mod uv_check;
mod vertices;

pub use color::{Chromaticities, ColorInfo};
pub use custom::{Custom, Functions, Landed, Landing, Measurement, Place, Start};
pub use denoise::{has_denoiser, Denoise};
pub use dilate::{Dilate, DilateReport};
pub use display::Display;
pub use encode::{encode_half, encode_rgbd, encode_rgbm, Coefficients, Encoded, Sh};
pub use exposure::Exposure;
pub use exr::Exr;
pub use lightmap::{Lightmap, LightmapInfo, LightmapInstance, LightmapTexels};
pub use points::{Point, Points};
pub use seams::{AtlasImage, FixSeams, SeamsReport};
pub use sky::Sky;
pub use uv::UvInstance;
pub use uv_check::{UvCheck, UvMaps, UvReport};
pub use vertices::Vertices;
