// SPDX-License-Identifier: Apache-2.0
//! Bidirectional path tracing, as a library: scenes, cameras, lightmaps and films, without `unsafe` for who uses it.
//!
//! ```text
//! context ─▶ builder ─▶ scene ─┐
//!                   sensor ────┼─▶ render ─▶ advance, advance, ... ─▶ film ─▶ read, save, write
//!                     film ────┘
//! ```
//! A [`Builder`] collects shapes, textures, materials, lights and instances and builds an immutable [`Scene`]. A
//! [`Sensor`] says what is measured, a [`Film`] holds the measurements, a [`Render`] joins the three and samples them,
//! pass by pass. One pass is one sample per measurement (per pixel, for a camera).
//!
//! ```
//! use bdpt::*;
//!
//! fn main() -> bdpt::Result<()> {
//!     let context = Context::new()?;
//!     let mut builder = Builder::new(&context)?;
//!     let ball = builder.add_sphere(Sphere::new([0.0; 3], 1.0))?;
//!     let gold = builder.add_material(Material::metal(Metal::Gold)?.roughness([0.2, 0.2]))?;
//!     builder.add_instance(&Instance::new(ball, gold))?;
//!     builder.add_light(&Light::environment([1.0; 3]))?;
//!     let scene = builder.build()?;
//!
//!     let sensor = Camera::perspective(64, 64).transform(Transform::translate([0.0, 0.0, 4.0])).create(&context)?;
//!     let film = Film::new(&sensor, &FilmOptions::default())?;
//!     let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new().seed(1))?;
//!     render.advance(Advance::passes(16).progress(|now| println!("{:.0} %", 100.0 * now.progress.fraction)))?;
//!     let image = render.film().read(Layer::Color)?;
//!     assert!(image.pixel(32, 32).unwrap()[0] > 0.5);
//!     Ok(())
//! }
//! ```
//!
//! # Conventions
//! Lengths are the scene's own unit. Radiance is in W/(m² sr), intensity in W/sr, with m that unit; angles are in
//! degrees. Colours are linear RGB in the context's rendering space. Row 0 of an image is the top row. A path of k
//! edges is made of a light subpath of s vertices and an eye subpath of t vertices: (s,t) is the technique that made
//! it, after Veach (1997). Zero, where nothing else is said, is the default of a number. The header `bdpt.h` is the
//! manual of all numbers.
//!
//! # Objects
//! | | `Send` | `Sync` | `Clone` |
//! |---|---|---|---|
//! | [`Context`], [`Scene`], [`Sensor`], [`CancelToken`] | yes | yes | the same object |
//! | [`Builder`], [`Film`], [`Render`] | yes | no | no |
//! | descriptions without closures | yes | yes | mostly |
//!
//! An object keeps alive what it needs, so that all may be dropped in any order. Shapes, textures, materials, lights
//! and instances are ids of one builder; one that was removed stays invalid.
//!
//! # Callbacks and panics
//! Closures passed to a call run during this call, on the calling thread, one at a time. Logs, executors, and textures,
//! materials and measurements of the host's run on any thread; that is why they are `Send + Sync`. A panic in any of
//! them never unwinds through the library: it stops the call, and goes on in the caller with its payload when the call
//! has returned; the objects can be used after it. Everything captured is dropped once.
//!
//! A panic on a thread of the library's own goes on in the call that this thread works for; where two calls work on one
//! scene at the same time, in one of them. The other then fails with [`ErrorCode::CallbackFailed`].
//!
//! # Determinism
//! The same library, instruction set, scene, options, seed and passes give the same film, bit for bit, whatever the
//! number of threads, the executor, interruptions, or the ranges that were merged.
//!
//! # Features
//! `ndarray`: films and images as arrays.
#![deny(missing_docs, unsafe_op_in_unsafe_fn)]
#![warn(missing_debug_implementations)]
#![cfg_attr(docsrs, feature(doc_cfg))]

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
