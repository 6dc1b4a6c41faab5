// SPDX-License-Identifier: Apache-2.0
//! What a builder has built.

use crate::context::Context;
use crate::handle::Handle;
use crate::panics::Panics;
use bdpt_sys as sys;
use std::fmt;

/// An immutable scene. Clones are the same scene; builders go on without it.
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
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_scene {
        self.raw.as_ptr()
    }
    pub(crate) fn panics(&self) -> &Panics {
        &self.panics
    }
}

impl fmt::Debug for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scene").finish_non_exhaustive()
    }
}
