// SPDX-License-Identifier: Apache-2.0
//! Collecting what a scene is made of.

use crate::cancel::{token_ptr, CancelToken};
use crate::context::Context;
use crate::error::{Result, Text};
use crate::flow::Flow;
use crate::handle::Handle;
use crate::host::{give_back, pointer, Host};
use crate::host_material::{self, BoxedMaterial};
use crate::id::{InstanceId, LightId, MaterialId, MediumId, ShapeId, TextureId};
use crate::instance::Instance;
use crate::light::{count, Light};
use crate::material::Material;
use crate::medium::Medium;
use crate::mesh::Mesh;
use crate::panics::{call, catch_here, make, Panics};
use crate::progress::Progress;
use crate::scene::Scene;
use crate::shapes::{self, Curves, Sphere, Subdivision};
use crate::texture::{self, BoxedTexture, HostTexture, Texture};
use bdpt_sys as sys;
use std::fmt;
use std::ops::ControlFlow;
use std::os::raw::c_void;
use std::ptr::null;

/// Collects shapes, textures, media, materials, lights and instances, and builds [`Scene`]s of them. It may be sent to
/// another thread, but not shared with one.
///
/// A call that fails has changed nothing. What one thing refers to is removed after it.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Instance, Light, Material, Sphere};
/// let mut builder = Builder::new(&Context::new()?)?;
/// let ball = builder.add_sphere(Sphere::new([0.0; 3], 1.0))?;
/// let clay = builder.add_material(Material::diffuse([0.6, 0.4, 0.3]))?;
/// builder.add_instance(&Instance::new(ball, clay))?;
/// builder.add_light(&Light::environment([1.0; 3]))?;
/// let scene = builder.build()?;
/// assert_eq!(scene.info()?.spheres, 1);
/// # Ok(()) }
/// ```
///
/// A builder cannot be used while it builds:
/// ```compile_fail,E0499
/// # fn f(mut builder: bdpt::Builder) -> bdpt::Result<()> {
/// use bdpt::{BuildOptions, Light};
/// builder.build_with(BuildOptions::new().progress(|_| {
///     let _ = builder.add_light(&Light::environment([1.0; 3]));
/// }))?;
/// # Ok(()) }
/// ```
/// nor be shared between threads:
/// ```compile_fail,E0277
/// # fn f(builder: bdpt::Builder) {
/// std::thread::scope(|scope| {
///     scope.spawn(|| println!("{builder:?}"));
/// });
/// # }
/// ```
pub struct Builder {
    raw: Handle<sys::bdpt_builder>,
    panics: Panics,
    context: Context,
}

impl Builder {
    /// An empty builder.
    pub fn new(context: &Context) -> Result<Self> {
        make(
            context.panics(),
            // SAFETY: the context is alive.
            |raw| unsafe { sys::bdpt_builder_create(context.as_ptr(), raw) },
            // SAFETY: the call gave the builder to us.
            |raw| Self {
                raw: unsafe { Handle::new(raw) },
                panics: context.panics().of_child(),
                context: context.clone(),
            },
        )
    }
    /// What it was made in.
    pub fn context(&self) -> &Context {
        &self.context
    }

    /// A call that adds something; `add` gets the builder and where the id goes.
    fn add<Id: Default>(
        &mut self,
        add: impl FnOnce(*mut sys::bdpt_builder, *mut Id) -> sys::bdpt_result,
    ) -> Result<Id> {
        let mut id = Id::default();
        call(&self.panics, || add(self.raw.as_ptr(), &mut id))?;
        Ok(id)
    }
    /// A call that changes or removes something.
    fn change(&mut self, change: impl FnOnce(*mut sys::bdpt_builder) -> sys::bdpt_result) -> Result<()> {
        call(&self.panics, || change(self.raw.as_ptr()))
    }

    /// Adds a triangle mesh, which goes to the library. Triangles without area are dropped and counted.
    pub fn add_mesh(&mut self, mesh: Mesh) -> Result<ShapeId> {
        let label = mesh.label_text()?;
        let desc = mesh.lend(&label, &self.panics);
        // SAFETY: the arrays are the library's now, which gives them back by their callback, also when it fails.
        self.add(|builder, id| unsafe { sys::bdpt_mesh_add(builder, &desc, id) }).map(ShapeId)
    }
    /// Adds a sphere.
    pub fn add_sphere(&mut self, sphere: Sphere) -> Result<ShapeId> {
        let label = Text::new(&sphere.label)?;
        let desc = sys::bdpt_sphere_desc { label: label.as_ptr(), ..*sphere.raw };
        // SAFETY: the description lives until the call returns.
        self.add(|builder, id| unsafe { sys::bdpt_sphere_add(builder, &desc, id) }).map(ShapeId)
    }
    /// Adds curves. Segments that have no length, or no radius anywhere, are dropped and counted.
    pub fn add_curves(&mut self, curves: Curves) -> Result<ShapeId> {
        let label = Text::new(&curves.label)?;
        let desc = sys::bdpt_curves_desc { label: label.as_ptr(), ..curves.look() };
        // SAFETY: the description and its arrays live until the call returns; they are copied.
        self.add(|builder, id| unsafe { sys::bdpt_curves_add(builder, &desc, id) }).map(ShapeId)
    }
    /// Adds a subdivision surface. A panic in its displacement goes on from here.
    pub fn add_subdivision(&mut self, mut surface: Subdivision<'_>) -> Result<ShapeId> {
        let label = Text::new(&surface.label)?;
        let mut desc = sys::bdpt_subdivision_desc { label: label.as_ptr(), ..surface.look() };
        if let Some(displace) = &mut surface.displace {
            desc.displace = Some(shapes::displace);
            desc.user = (displace as *mut shapes::Displace<'_>).cast();
        }
        // SAFETY: the description, its arrays and the closure live until the call returns; all is copied.
        self.add(|builder, id| unsafe { sys::bdpt_subdivision_add(builder, &desc, id) }).map(ShapeId)
    }
    /// Removes a shape that no instance uses.
    pub fn remove_shape(&mut self, shape: ShapeId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_shape_remove(builder, shape.0) })
    }

    /// Adds an image.
    pub fn add_texture(&mut self, texture: Texture<'_>) -> Result<TextureId> {
        texture.with_desc(|desc| {
            // SAFETY: there are as many texels as the description says; they are copied.
            self.add(|builder, id| unsafe { sys::bdpt_texture_add(builder, desc, id) }).map(TextureId)
        })
    }
    /// Adds a texture of yours. It is dropped when the last builder or scene that has it is gone.
    pub fn add_host_texture(&mut self, texture: impl HostTexture + 'static) -> Result<TextureId> {
        let label = Text::new(&Some(texture.label()))?;
        let desc = sys::bdpt_host_texture_desc {
            maximum: texture.maximum(),
            label: label.as_ptr(),
            look_up: Some(texture::look_up),
            drop: Some(give_back::<BoxedTexture>),
            hash: texture.hash(),
            step: texture.bump_step(),
            ..Default::default()
        };
        let texture: BoxedTexture = Box::new(texture);
        let lent = Host::lend(texture, &self.panics);
        let desc = sys::bdpt_host_texture_desc { user: lent.user(), ..desc };
        // SAFETY: the texture is the library's now, which gives it back by its callback, also when it fails.
        let added = self.add(|builder, id| unsafe { sys::bdpt_host_texture_add(builder, &desc, id) });
        if added.is_err() {
            // SAFETY: the call has failed.
            unsafe { lent.call_failed(desc.user) };
        }
        added.map(TextureId)
    }
    /// Removes a texture that no material or light uses.
    pub fn remove_texture(&mut self, texture: TextureId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_texture_remove(builder, texture.0) })
    }

    /// Adds a medium.
    pub fn add_medium(&mut self, medium: &Medium) -> Result<MediumId> {
        let label = Text::new(&medium.label)?;
        let desc = sys::bdpt_medium_desc { label: label.as_ptr(), ..*medium.raw };
        // SAFETY: the description lives until the call returns.
        self.add(|builder, id| unsafe { sys::bdpt_medium_add(builder, &desc, id) }).map(MediumId)
    }
    /// Replaces a medium for scenes built from now on.
    pub fn update_medium(&mut self, id: MediumId, medium: &Medium) -> Result<()> {
        let label = Text::new(&medium.label)?;
        let desc = sys::bdpt_medium_desc { label: label.as_ptr(), ..*medium.raw };
        // SAFETY: as above.
        self.change(|builder| unsafe { sys::bdpt_medium_update(builder, id.0, &desc) })
    }
    /// Removes a medium that no material uses.
    pub fn remove_medium(&mut self, medium: MediumId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_medium_remove(builder, medium.0) })
    }

    /// Adds a material. A [host's](crate::HostMaterial) is dropped when the last builder or scene that has it is gone.
    pub fn add_material(&mut self, material: Material) -> Result<MaterialId> {
        self.with_material(material, |builder, desc| {
            // SAFETY: what the description points to lives until the call returns, but for what it takes.
            builder.add(|builder, id| unsafe { sys::bdpt_material_add(builder, desc, id) }).map(MaterialId)
        })
    }
    /// Replaces a material for scenes built from now on.
    pub fn update_material(&mut self, id: MaterialId, material: Material) -> Result<()> {
        self.with_material(material, |builder, desc| {
            // SAFETY: as above.
            builder.change(|builder| unsafe { sys::bdpt_material_update(builder, id.0, desc) })
        })
    }
    fn with_material<R>(
        &mut self,
        material: Material,
        add: impl FnOnce(&mut Self, &sys::bdpt_material_desc) -> Result<R>,
    ) -> Result<R> {
        let label = material.label_text()?;
        let textures: Vec<_> = material.textures.iter().map(|texture| texture.raw).collect();
        let lent = material.host.map(|host| (host.transmits(), host.hash(), Host::lend(host, &self.panics)));
        let host = lent.as_ref().map(|(transmits, hash, lent)| sys::bdpt_host_material {
            transmits: (*transmits).into(),
            hash: *hash,
            user: lent.user(),
            evaluate: Some(host_material::evaluate),
            sample: Some(host_material::sample),
            drop: Some(give_back::<BoxedMaterial>),
            ..Default::default()
        });
        let desc = sys::bdpt_material_desc {
            label: label.as_ptr(),
            textures: pointer(&textures),
            texture_count: count(textures.len()),
            host: host.as_ref().map_or(null(), |host| host),
            ..*material.raw
        };
        let done = add(self, &desc);
        if let (Err(_), Some((.., lent)), Some(host)) = (&done, lent, &host) {
            // SAFETY: the call has failed.
            unsafe { lent.call_failed(host.user) };
        }
        done
    }
    /// Removes a material that no instance and no mix uses.
    pub fn remove_material(&mut self, material: MaterialId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_material_remove(builder, material.0) })
    }

    /// Adds a light.
    pub fn add_light(&mut self, light: &Light) -> Result<LightId> {
        // SAFETY: the description lives until the call returns; all is copied.
        light.with_desc(|desc| self.add(|builder, id| unsafe { sys::bdpt_light_add(builder, desc, id) }).map(LightId))
    }
    /// Replaces a light for scenes built from now on.
    pub fn update_light(&mut self, id: LightId, light: &Light) -> Result<()> {
        // SAFETY: as above.
        light.with_desc(|desc| self.change(|builder| unsafe { sys::bdpt_light_update(builder, id.0, desc) }))
    }
    /// Removes a light.
    pub fn remove_light(&mut self, light: LightId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_light_remove(builder, light.0) })
    }

    /// Adds an instance.
    pub fn add_instance(&mut self, instance: &Instance) -> Result<InstanceId> {
        instance.with_desc(|desc| {
            // SAFETY: the description lives until the call returns.
            self.add(|builder, id| unsafe { sys::bdpt_instance_add(builder, desc, id) }).map(InstanceId)
        })
    }
    /// Replaces an instance for scenes built from now on.
    pub fn update_instance(&mut self, id: InstanceId, instance: &Instance) -> Result<()> {
        // SAFETY: as above.
        instance.with_desc(|desc| self.change(|builder| unsafe { sys::bdpt_instance_update(builder, id.0, desc) }))
    }
    /// Removes an instance.
    pub fn remove_instance(&mut self, instance: InstanceId) -> Result<()> {
        // SAFETY: the library checks ids.
        self.change(|builder| unsafe { sys::bdpt_instance_remove(builder, instance.0) })
    }

    /// Builds an immutable scene. The builder can go on and build others.
    pub fn build(&mut self) -> Result<Scene> {
        self.build_with(BuildOptions::new())
    }
    /// Builds a scene that can be cancelled, tells of its progress, or lies in a medium.
    pub fn build_with(&mut self, mut options: BuildOptions<'_>) -> Result<Scene> {
        let desc = sys::bdpt_build_desc {
            cancel: token_ptr(&options.cancel),
            progress: options.progress.is_some().then_some(report as _),
            user: options.progress.as_mut().map_or(std::ptr::null_mut(), |told| (told as *mut Told<'_>).cast()),
            medium: options.medium.map(|medium| medium.0).unwrap_or_default(),
            ..Default::default()
        };
        make(
            &self.panics,
            // SAFETY: builder, token and closure live until the call returns.
            |raw| unsafe { sys::bdpt_scene_build(self.raw.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Scene::new(raw, self.panics.clone(), self.context.clone()) },
        )
    }
}

impl fmt::Debug for Builder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Builder").finish_non_exhaustive()
    }
}

type Told<'a> = Box<dyn FnMut(&Progress) -> ControlFlow<()> + 'a>;

/// How a scene is built.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{BuildOptions, Builder, CancelToken, Context, Light};
/// let mut builder = Builder::new(&Context::new()?)?;
/// builder.add_light(&Light::environment([1.0; 3]))?;
/// let token = CancelToken::new()?;
/// let mut told = 0;
/// builder.build_with(BuildOptions::new().cancel(&token).progress(|progress| {
///     assert!(progress.fraction <= 1.0);
///     told += 1;
/// }))?;
/// assert!(told > 0);
/// # Ok(()) }
/// ```
#[derive(Default)]
pub struct BuildOptions<'a> {
    cancel: Option<CancelToken>,
    progress: Option<Told<'a>>,
    medium: Option<MediumId>,
}

impl<'a> BuildOptions<'a> {
    /// The default.
    pub fn new() -> Self {
        Self::default()
    }
    /// Stops the build, which then fails with [`ErrorCode::Cancelled`](crate::ErrorCode::Cancelled).
    pub fn cancel(mut self, token: &CancelToken) -> Self {
        self.cancel = Some(token.clone());
        self
    }
    /// Called about ten times a second, on this thread. [`ControlFlow::Break`] stops the build, which then fails with
    /// [`ErrorCode::CallbackFailed`](crate::ErrorCode::CallbackFailed).
    pub fn progress<R: Flow>(mut self, mut progress: impl FnMut(&Progress) -> R + 'a) -> Self {
        self.progress = Some(Box::new(move |now| progress(now).flow()));
        self
    }
    /// What fills the scene outside of all that encloses something.
    pub fn medium(mut self, medium: MediumId) -> Self {
        self.medium = Some(medium);
        self
    }
}

impl fmt::Debug for BuildOptions<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cancel, medium, .. } = self;
        f.debug_struct("BuildOptions").field("cancel", cancel).field("medium", medium).finish_non_exhaustive()
    }
}

unsafe extern "C" fn report(user: *mut c_void, progress: *const sys::bdpt_progress) -> i32 {
    // SAFETY: build_with is running, and calls back on its own thread, one call at a time; progress is valid meanwhile.
    let (told, progress) = unsafe { (&mut *user.cast::<Told<'_>>(), Progress::new(&*progress)) };
    i32::from(catch_here(|| told(&progress)) != Some(ControlFlow::Continue(())))
}
