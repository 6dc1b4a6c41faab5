// SPDX-License-Identifier: Apache-2.0
//! What is measured: cameras, lightmaps, points, and measurements of your own.

use crate::context::Context;
use crate::handle::Handle;
use crate::panics::Panics;
use bdpt_sys as sys;
use std::fmt;

/// A camera, lightmap, or another measurement. Clones are the same sensor.
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
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_sensor {
        self.raw.as_ptr()
    }
    pub(crate) fn panics(&self) -> &Panics {
        &self.panics
    }
}

impl fmt::Debug for Sensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sensor").finish_non_exhaustive()
    }
}
