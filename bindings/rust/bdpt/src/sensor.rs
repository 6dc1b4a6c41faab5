// SPDX-License-Identifier: Apache-2.0
//! What is measured: cameras, lightmaps, points, and measurements of your own.

use crate::context::Context;
use crate::error::Result;
use crate::handle::Handle;
use crate::output::{LightPaths, OutputKind};
use crate::panics::{call, Panics};
use bdpt_sys as sys;
use std::fmt;

/// A camera, lightmap, or another measurement. Clones are the same sensor, which any thread may use.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let sensor = bdpt::Camera::perspective(64, 48).create(&bdpt::Context::new()?)?;
/// assert_eq!(sensor.plane(0)?.kind, bdpt::OutputKind::None);
/// # Ok(()) }
/// ```
#[derive(Clone)]
pub struct Sensor {
    raw: Handle<sys::bdpt_sensor>,
    panics: Panics,
    context: Context,
}

impl Sensor {
    /// `panics` is `context.panics().of_child()` for a sensor with callbacks, the scene's or the context's otherwise.
    ///
    /// # Safety
    /// `raw` came from a call that gave one reference.
    pub(crate) unsafe fn new(raw: *mut sys::bdpt_sensor, panics: Panics, context: Context) -> Self {
        // SAFETY: as the caller says.
        Self { raw: unsafe { Handle::new(raw) }, panics, context }
    }
    /// What it was made in.
    pub fn context(&self) -> &Context {
        &self.context
    }
    /// What a plane of the sensor's films measures.
    pub fn plane(&self, plane: u32) -> Result<PlaneInfo> {
        let mut info = sys::bdpt_plane_info::default();
        // SAFETY: the sensor is alive, and the struct has its size set.
        call(&self.panics, || unsafe { sys::bdpt_sensor_get_plane(self.as_ptr(), plane, &mut info) })?;
        Ok(PlaneInfo {
            kind: OutputKind::new(info.kind),
            paths: LightPaths::new(info.paths),
            reach: info.reach,
            groups: info.groups,
            output: info.output,
            coefficient: info.coefficient,
        })
    }
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_sensor {
        self.raw.as_ptr()
    }
    pub(crate) fn panics(&self) -> &Panics {
        &self.panics
    }
}

/// What a plane of a film measures.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneInfo {
    /// [`OutputKind::None`] for a camera's picture, and for sensors without outputs.
    pub kind: OutputKind,
    /// Which light, by its way.
    pub paths: LightPaths,
    /// Of openness; 0 = without end.
    pub reach: f32,
    /// Bit g: light of group g; 0: of none, as for openness.
    pub groups: u64,
    /// Of those asked for; 0 for a camera's picture, too.
    pub output: u32,
    /// Plane within the output, as of spherical harmonics.
    pub coefficient: u32,
}

impl fmt::Debug for Sensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sensor").finish_non_exhaustive()
    }
}
