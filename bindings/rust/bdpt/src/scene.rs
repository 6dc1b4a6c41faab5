// SPDX-License-Identifier: Apache-2.0
//! What a builder has built.

use crate::context::Context;
use crate::error::{owned, Result};
use crate::handle::Handle;
use crate::id::{InstanceId, LightId};
use crate::panics::{call, Panics};
use bdpt_sys as sys;
use std::fmt;

/// An immutable scene. Clones are the same scene, which any thread may use; builders go on without it.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_light(&bdpt::Light::environment([1.0; 3]).label("sky"))?;
/// let scene = builder.build()?;
/// let labels: Vec<_> = scene.lights()?.into_iter().map(|light| light.label).collect();
/// assert_eq!(labels, ["sky"]);
/// # Ok(()) }
/// ```
#[derive(Clone)]
pub struct Scene {
    raw: Handle<sys::bdpt_scene>,
    panics: Panics,
    context: Context,
}

impl Scene {
    /// # Safety
    /// `raw` came from a call that gave one reference.
    pub(crate) unsafe fn new(raw: *mut sys::bdpt_scene, panics: Panics, context: Context) -> Self {
        // SAFETY: as the caller says.
        Self { raw: unsafe { Handle::new(raw) }, panics, context }
    }
    /// What it was made in.
    pub fn context(&self) -> &Context {
        &self.context
    }
    /// What the scene holds.
    pub fn info(&self) -> Result<SceneInfo> {
        let mut info = sys::bdpt_scene_info::default();
        // SAFETY: the scene is alive, and the struct has its size set.
        call(&self.panics, || unsafe { sys::bdpt_scene_get_info(self.as_ptr(), &mut info) })?;
        Ok(SceneInfo {
            lights: info.lights,
            instances: info.instances,
            triangles: info.triangles,
            spheres: info.spheres,
            curves: info.curves,
            degenerate_triangles: info.degenerate_triangles,
            memory: info.memory,
            memory_embree: info.memory_embree,
            hash: info.hash,
            bounds_min: info.bounds_min,
            bounds_max: info.bounds_max,
        })
    }
    /// The scene's lights: those added as lights first, then instances that emit, each in the order of adding.
    pub fn lights(&self) -> Result<Vec<SceneLight>> {
        (0..self.info()?.lights).map(|index| self.light(index)).collect()
    }
    fn light(&self, index: u32) -> Result<SceneLight> {
        let mut light = sys::bdpt_scene_light::default();
        // SAFETY: the scene is alive, and the struct has its size set.
        call(&self.panics, || unsafe { sys::bdpt_scene_get_light(self.as_ptr(), index, &mut light) })?;
        Ok(SceneLight {
            group: light.group,
            light: (light.light.id != 0).then_some(LightId(light.light)),
            instance: (light.instance.id != 0).then_some(InstanceId(light.instance)),
            // SAFETY: the scene's, which is alive.
            label: unsafe { owned(light.label) },
        })
    }
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_scene {
        self.raw.as_ptr()
    }
    pub(crate) fn panics(&self) -> &Panics {
        &self.panics
    }
}

/// What a [`Scene`] holds.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneInfo {
    /// Emitting instances, and all that was added as a light.
    pub lights: u32,
    /// Instances.
    pub instances: u64,
    /// Instanced ones counted once for each instance.
    pub triangles: u64,
    /// Once for each instance.
    pub spheres: u64,
    /// Segments of curves, as they were cut, once for each instance.
    pub curves: u64,
    /// Dropped, for having no area, once for each instance; segments of curves, too.
    pub degenerate_triangles: u64,
    /// Bytes, Embree's structures included.
    pub memory: u64,
    /// Bytes of Embree's structures.
    pub memory_embree: u64,
    /// Of all that decides the picture.
    pub hash: u64,
    /// Of the geometry; both bounds are zero when there is none.
    pub bounds_min: [f32; 3],
    /// Of the geometry.
    pub bounds_max: [f32; 3],
}

/// One of a scene's lights.
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneLight {
    /// Of the light, or of the material's emission.
    pub group: u32,
    /// `None` for an instance.
    pub light: Option<LightId>,
    /// `None` for a light.
    pub instance: Option<InstanceId>,
    /// Empty where it has none.
    pub label: String,
}

impl fmt::Debug for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scene").finish_non_exhaustive()
    }
}
