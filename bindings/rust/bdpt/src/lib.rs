// SPDX-License-Identifier: Apache-2.0
//! Bidirectional path tracing, as a library.
#![deny(missing_docs, unsafe_op_in_unsafe_fn)]
#![warn(missing_debug_implementations)]

#[macro_use]
mod set;

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
