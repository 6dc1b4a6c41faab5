// SPDX-License-Identifier: Apache-2.0
//! Bidirectional path tracing, as a library.
#![deny(missing_docs, unsafe_op_in_unsafe_fn)]
#![warn(missing_debug_implementations)]

#[macro_use]
mod set;

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

mod advance;
mod builder;
mod camera;
mod cancel;
mod context;
mod data;
mod error;
mod executor;
mod film;
mod film_options;
mod flow;
mod handle;
mod host;
mod host_material;
mod id;
mod image;
mod instance;
mod light;
mod material;
mod medium;
mod mesh;
mod output;
mod panics;
mod plain;
mod progress;
mod read;
mod rect;
mod render;
mod render_options;
mod scene;
mod sensor;
mod shapes;
mod sink;
mod stats;
mod texture;
mod texture_use;
mod transform;

pub use advance::{Advance, AdvanceReport, Running, StopReason};
pub use builder::{BuildOptions, Builder};
pub use camera::{Camera, LensSurface};
pub use cancel::CancelToken;
pub use context::{version, Context, ContextInfo, ContextOptions, Isa, LogLevel};
pub use data::{Data, Element};
pub use error::{Error, ErrorCode, Result};
pub use executor::Executor;
pub use film::{Film, FilmInfo};
pub use film_options::{FilmOptions, Filter, MemoryEstimate, Normalization};
pub use flow::Flow;
pub use host_material::{HostMaterial, Scattering, ScatteringPlace};
pub use id::{InstanceId, LightId, MaterialId, MediumId, ShapeId, TextureId};
pub use image::{Image, TileView};
pub use instance::Instance;
pub use light::{Light, Photometry, Portal};
pub use material::{Material, Metal};
pub use medium::Medium;
pub use mesh::{Colors, Indices, Mesh};
pub use output::{LightPaths, Output, OutputKind};
pub use progress::Progress;
pub use read::{Coverage, CoverageEntry, CoverageOptions, Layer, ReadOptions};
pub use rect::Rect;
pub use render::{Render, RenderError};
pub use render_options::{
    plans, Adaptive, Heuristic, LightSelection, LightStart, MatrixKind, Order, Partners, Plan, PoolSelection,
    RenderOptions, Sampler, ShadowRoulette, Techniques,
};
pub use scene::{Scene, SceneInfo, SceneLight};
pub use sensor::{PlaneInfo, Sensor};
pub use shapes::{Boundary, CurveBasis, Curves, Sphere, Subdivision, SurfacePlace};
pub use sink::{Sink, Tile};
pub use stats::{RenderStats, TechniqueStats};
pub use texture::{Half, HostTexture, Texel, Texture, TexturePlace};
pub use texture_use::{Lookup, Slot, TextureUse, Wrap};
pub use transform::Transform;
