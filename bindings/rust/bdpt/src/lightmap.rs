// SPDX-License-Identifier: Apache-2.0
//! Lightmaps: what arrives at surfaces, texel by texel of an atlas.

use crate::cancel::{token_ptr, CancelToken};
use crate::count::{array, count, zeros};
use crate::error::Result;
use crate::film_options::{FilmOptions, MemoryEstimate};
use crate::id::InstanceId;
use crate::output::Output;
use crate::panics::{call, make};
use crate::rect::Rect;
use crate::scene::Scene;
use crate::sensor::Sensor;
use bdpt_sys as sys;

/// An instance and its place in an atlas.
#[derive(Clone, Copy, Debug)]
pub struct LightmapInstance {
    raw: sys::bdpt_lightmap_instance,
}

/// By uv set 1, in all of the first atlas.
impl From<InstanceId> for LightmapInstance {
    fn from(instance: InstanceId) -> Self {
        Self { raw: sys::bdpt_lightmap_instance { instance: instance.0, ..Default::default() } }
    }
}

impl LightmapInstance {
    /// An instance of a mesh, by its uv set 1, in all of the first atlas.
    pub fn new(instance: InstanceId) -> Self {
        instance.into()
    }
    /// Its rectangle: coordinates times `scale` plus `offset` are the place in the atlas, which is \[0, 1\]², with v = 1
    /// its top row.
    pub fn rectangle(mut self, scale: [f32; 2], offset: [f32; 2]) -> Self {
        self.raw.scale = scale;
        self.raw.offset = offset;
        self
    }
    /// Its atlas, from 0.
    pub fn atlas(mut self, atlas: u32) -> Self {
        self.raw.atlas = atlas;
        self
    }
    /// By uv set 0, that of textures, instead of set 1.
    pub fn by_texture_coordinates(mut self, yes: bool) -> Self {
        self.raw.uv_set = yes.into();
        self
    }
    /// The back receives, not the front.
    pub fn flip(mut self, flip: bool) -> Self {
        self.raw.flip = flip.into();
        self
    }
}

/// Lightmaps to be created. A texel measures the mean over all of the surface that it covers.
///
/// The film has atlas a in rows `a * height` to `(a + 1) * height`, and a plane for each plane of its outputs.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Instance, Lightmap, Material, Mesh, Output, OutputKind};
/// let context = Context::new()?;
/// let mut builder = Builder::new(&context)?;
/// let square = Mesh::new(vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]])
///     .indices(vec![[0_u32, 1, 2], [0, 2, 3]])
///     .lightmap_uv(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
/// let square = builder.add_mesh(square)?;
/// let grey = builder.add_material(Material::diffuse([0.5; 3]))?;
/// let floor = builder.add_instance(&Instance::new(square, grey))?;
/// let scene = builder.build()?;
/// let sensor = Lightmap::new(8, 8).instance(floor).output(Output::new(OutputKind::Openness)).create(&scene)?;
/// let info = sensor.lightmap_info()?;
/// assert_eq!((info.texels, info.area), (64, 4.0));
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Lightmap {
    width: u32,
    height: u32,
    atlases: u32,
    instances: Vec<sys::bdpt_lightmap_instance>,
    outputs: Vec<sys::bdpt_output_desc>,
    rect: Rect,
    geometric_normals: bool,
    buried_rays: u32,
    backface_tolerance: f32,
    all_backs: bool,
    film_of_rect: bool,
    cancel: Option<CancelToken>,
}

impl Lightmap {
    /// Of atlases of so many texels, 1 to 65536 along each side.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            atlases: 0,
            instances: Vec::new(),
            outputs: Vec::new(),
            rect: Rect::default(),
            geometric_normals: false,
            buried_rays: 0,
            backface_tolerance: 0.0,
            all_backs: false,
            film_of_rect: false,
            cancel: None,
        }
    }
    /// So many atlases; 1 by default.
    pub fn atlases(mut self, count: u32) -> Self {
        self.atlases = count;
        self
    }
    /// One more instance, by its id or with its place in an atlas; each once.
    pub fn instance(mut self, instance: impl Into<LightmapInstance>) -> Self {
        self.instances.push(instance.into().raw);
        self
    }
    /// One more output; irradiance alone where none is asked for.
    pub fn output(mut self, output: Output) -> Self {
        self.outputs.push(output.raw());
        self
    }
    /// Only these texels of the film are baked.
    pub fn rect(mut self, rect: Rect) -> Self {
        self.rect = rect;
        self
    }
    /// Film and sensor hold the texels of [`rect`](Self::rect) alone: to bake a map in bands, with the same bits.
    pub fn film_of_rect(mut self, yes: bool) -> Self {
        self.film_of_rect = yes;
        self
    }
    /// Normals are the triangles', not the vertices'.
    pub fn geometric_normals(mut self, yes: bool) -> Self {
        self.geometric_normals = yes;
        self
    }
    /// So many rays from each of 8 x 8 cells of each texel find what is buried inside of geometry, and is not measured
    /// at all, so that floors that run on under walls are not darkened there; 16 will do. 0 = off.
    pub fn buried_rays(mut self, rays: u32) -> Self {
        self.buried_rays = rays;
        self
    }
    /// A cell is buried where more than this part of its rays meets a back first; 0.5 by default.
    pub fn backface_tolerance(mut self, part: f32) -> Self {
        self.backface_tolerance = part;
        self
    }
    /// The backs of all but dielectrics count, not of one-sided surfaces alone.
    pub fn all_backs(mut self, yes: bool) -> Self {
        self.all_backs = yes;
        self
    }
    /// Stops the search for what is buried, which takes long for large maps.
    pub fn cancel(mut self, token: &CancelToken) -> Self {
        self.cancel = Some(token.clone());
        self
    }

    /// The sensor. A render takes it with this scene only, which it keeps alive.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for what is no mesh, a mesh without these coordinates, an
    /// instance twice, or when no texel is covered, or all are buried; [`InvalidId`](crate::ErrorCode::InvalidId);
    /// [`Cancelled`](crate::ErrorCode::Cancelled).
    pub fn create(&self, scene: &Scene) -> Result<Sensor> {
        let desc = self.desc()?;
        make(
            scene.panics(),
            // SAFETY: what desc points to is borrowed from self, and copied by the call.
            |raw| unsafe { sys::bdpt_lightmap_create(scene.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Sensor::new(raw, scene.panics().clone(), scene.context().clone()) },
        )
    }

    /// What the sensor, a film and its render will take, before there is one. With
    /// [`band_rows`](MemoryEstimate::band_rows): bake the map in bands of so many rows of [`rect`](Self::rect), each a
    /// lightmap with [`film_of_rect`](Self::film_of_rect), and none needs more than `budget` bytes. A budget of 0 is what
    /// is left of the context's memory limit.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument), [`InvalidId`](crate::ErrorCode::InvalidId).
    pub fn estimate(&self, scene: &Scene, film: &FilmOptions, budget: u64) -> Result<MemoryEstimate> {
        let desc = self.desc()?;
        let mut raw = sys::bdpt_memory_estimate::default();
        call(scene.panics(), || {
            // SAFETY: the scene is alive, what desc points to is borrowed from self, the structs have their sizes set.
            unsafe { sys::bdpt_lightmap_estimate(scene.as_ptr(), &desc, &film.raw, budget, &mut raw) }
        })?;
        Ok(MemoryEstimate::new(&raw))
    }

    /// Points into `self`.
    fn desc(&self) -> Result<sys::bdpt_lightmap_desc> {
        Ok(sys::bdpt_lightmap_desc {
            width: self.width,
            height: self.height,
            atlas_count: self.atlases,
            instance_count: count(self.instances.len(), "instances")?,
            instances: array(&self.instances),
            output_count: count(self.outputs.len(), "outputs")?,
            outputs: array(&self.outputs),
            rect: self.rect.raw(),
            geometric_normals: self.geometric_normals.into(),
            buried_rays: self.buried_rays,
            backface_tolerance: self.backface_tolerance,
            all_backs: self.all_backs.into(),
            cancel: token_ptr(&self.cancel),
            film_of_rect: self.film_of_rect.into(),
            ..Default::default()
        })
    }
}

/// What a lightmap covers.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightmapInfo {
    /// Columns of the film: of all atlases together, or of the rectangle with `film_of_rect`.
    pub width: u32,
    /// Rows of the film.
    pub height: u32,
    /// Texels that cover some surface: samples of a pass.
    pub texels: u64,
    /// Of these, by more than one instance.
    pub texels_shared: u64,
    /// Triangles without area in the atlas.
    pub triangles_unmapped: u64,
    /// Triangles that reach out of the atlas.
    pub triangles_outside: u64,
    /// Of the surface measured, in the world.
    pub area: f64,
    /// Of what lies outside of the atlas.
    pub area_outside: f64,
    /// Texels that cover surface, but all of it buried: not among `texels`.
    pub texels_buried: u64,
    /// Of what is left out for being buried, in the world.
    pub area_buried: f64,
}

/// What [`Sensor::lightmap_texels`] tells of each texel, in rows.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq)]
pub struct LightmapTexels {
    /// The part of it that its surfaces cover, by area in the atlas: above 1 where they overlap, 0 where nothing is
    /// measured.
    pub coverage: Vec<f32>,
    /// The area of these surfaces in the world.
    pub area: Vec<f32>,
}

impl LightmapTexels {
    /// A byte to a texel, 1 where something is measured: as [`Dilate`](crate::Dilate) takes it.
    pub fn mask(&self) -> Vec<u8> {
        self.coverage.iter().map(|part| (*part > 0.0).into()).collect()
    }
}

/// Of lightmaps; other sensors give [`InvalidArgument`](crate::ErrorCode::InvalidArgument).
impl Sensor {
    /// What a lightmap covers.
    pub fn lightmap_info(&self) -> Result<LightmapInfo> {
        let mut raw = sys::bdpt_lightmap_info::default();
        // SAFETY: the sensor is alive, and the struct has its size set.
        call(self.panics(), || unsafe { sys::bdpt_lightmap_get_info(self.as_ptr(), &mut raw) })?;
        Ok(LightmapInfo {
            width: raw.width,
            height: raw.height,
            texels: raw.texels,
            texels_shared: raw.texels_shared,
            triangles_unmapped: raw.triangles_unmapped,
            triangles_outside: raw.triangles_outside,
            area: raw.area,
            area_outside: raw.area_outside,
            texels_buried: raw.texels_buried,
            area_buried: raw.area_buried,
        })
    }
    /// How much of each texel of a lightmap is measured.
    pub fn lightmap_texels(&self) -> Result<LightmapTexels> {
        let (mut coverage, mut area) = (self.of_texels()?, self.of_texels()?);
        call(self.panics(), || {
            let (coverage, area, capacity) = (coverage.as_mut_ptr(), area.as_mut_ptr(), coverage.len() as u64);
            // SAFETY: both have room for so many floats.
            unsafe { sys::bdpt_lightmap_read_texels(self.as_ptr(), coverage, area, capacity) }
        })?;
        Ok(LightmapTexels { coverage, area })
    }
    /// The part of each texel of a lightmap whose surfaces are buried, by area in the atlas, in rows.
    pub fn lightmap_buried(&self) -> Result<Vec<f32>> {
        let mut buried = self.of_texels()?;
        call(self.panics(), || {
            // SAFETY: there is room for so many floats.
            unsafe { sys::bdpt_lightmap_read_buried(self.as_ptr(), buried.as_mut_ptr(), buried.len() as u64) }
        })?;
        Ok(buried)
    }
    fn of_texels(&self) -> Result<Vec<f32>> {
        let info = self.lightmap_info()?;
        zeros(u64::from(info.width) * u64::from(info.height), 0.0, "texels of a lightmap")
    }
}
