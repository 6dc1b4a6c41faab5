// SPDX-License-Identifier: Apache-2.0
//! The library's objects: pointers that are released once.

use crate::panics::release;
use bdpt_sys as sys;
use std::ptr::NonNull;

/// An object of the library.
pub(crate) trait Object {
    /// Takes the reference that a `Handle` holds, or destroys the object.
    ///
    /// # Safety
    /// `raw` is an object, and the reference is the caller's to give.
    unsafe fn release(raw: *mut Self);
}

/// An object that is counted, and whose functions any thread may call at any time.
pub(crate) trait Shared: Object {
    /// Adds a reference.
    ///
    /// # Safety
    /// `raw` is an object.
    unsafe fn retain(raw: *mut Self);
}

/// One reference to an object.
pub(crate) struct Handle<T: Object>(NonNull<T>);

// SAFETY: no object is bound to a thread; calls on one must at most not overlap, which &mut and !Sync see to.
unsafe impl<T: Object> Send for Handle<T> {}
// SAFETY: any thread may call the functions of these objects at any time.
unsafe impl<T: Shared> Sync for Handle<T> {}

impl<T: Object> Handle<T> {
    /// # Safety
    /// `raw` came from a call that succeeded and gave the caller one reference, which goes to the handle.
    pub(crate) unsafe fn new(raw: *mut T) -> Self {
        // SAFETY: calls that succeed give no NULL.
        Self(unsafe { NonNull::new_unchecked(raw) })
    }
    /// Valid as long as `self`.
    pub(crate) fn as_ptr(&self) -> *mut T {
        self.0.as_ptr()
    }
}

impl<T: Shared> Clone for Handle<T> {
    fn clone(&self) -> Self {
        // SAFETY: the object is alive.
        unsafe { T::retain(self.as_ptr()) };
        Self(self.0)
    }
}

impl<T: Object> Drop for Handle<T> {
    fn drop(&mut self) {
        // SAFETY: the reference is this handle's, and goes with it.
        release(|| unsafe { T::release(self.as_ptr()) });
    }
}

macro_rules! object {
    ($name:ident, $release:ident) => {
        impl Object for sys::$name {
            unsafe fn release(raw: *mut Self) {
                unsafe { sys::$release(raw) };
            }
        }
    };
    ($name:ident, $release:ident, $retain:ident) => {
        object!($name, $release);
        impl Shared for sys::$name {
            unsafe fn retain(raw: *mut Self) {
                unsafe { sys::$retain(raw) };
            }
        }
    };
}

object!(bdpt_context, bdpt_context_release, bdpt_context_retain);
object!(bdpt_cancel, bdpt_cancel_release, bdpt_cancel_retain);
object!(bdpt_scene, bdpt_scene_release, bdpt_scene_retain);
object!(bdpt_sensor, bdpt_sensor_release, bdpt_sensor_retain);
object!(bdpt_film, bdpt_film_release);
object!(bdpt_builder, bdpt_builder_destroy);
object!(bdpt_render, bdpt_render_destroy);
