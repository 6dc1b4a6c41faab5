// SPDX-License-Identifier: Apache-2.0
//! Values of the host's that the library keeps and gives back by a callback.

use crate::panics::Panics;
use std::os::raw::c_void;
use std::sync::Arc;

/// A value that the library holds, with the slot of its panics.
pub(crate) struct Host<T> {
    pub(crate) value: T,
    pub(crate) panics: Panics,
}

impl<T: Send + Sync + 'static> Host<T> {
    /// What the library gets as `user`.
    pub(crate) fn lend(value: T, panics: &Panics) -> Lent<T> {
        Lent(Arc::new(Self { value, panics: panics.clone() }))
    }
}

/// A value on its way to the library.
pub(crate) struct Lent<T>(Arc<Host<T>>);

impl<T: Send + Sync + 'static> Lent<T> {
    /// A reference for the library, to be given back by [`give_back`].
    pub(crate) fn user(&self) -> *mut c_void {
        Arc::into_raw(self.0.clone()) as *mut c_void
    }

    /// After a call that failed: takes the reference back if the library refused the description before it read it.
    ///
    /// # Safety
    /// `user` is from `self.user()`, and the call that was given it has failed.
    pub(crate) unsafe fn call_failed(self, user: *mut c_void) {
        if Arc::strong_count(&self.0) > 1 {
            // SAFETY: the library holds nothing after a call that failed, and has not called drop: there are two still.
            drop(unsafe { Arc::from_raw(user as *const Host<T>) });
        }
    }
}

/// The callback `drop` of a value lent.
pub(crate) unsafe extern "C" fn give_back<T: Send + Sync + 'static>(user: *mut c_void) {
    // SAFETY: `user` is from Lent::user, and the library calls this once.
    let host = unsafe { Arc::from_raw(user as *const Host<T>) };
    let panics = host.panics.clone();
    panics.catch(|| drop(host));
}

/// The value behind `user` in a callback.
///
/// # Safety
/// `user` is from `Lent<T>::user`, and was not given back.
pub(crate) unsafe fn host<'a, T>(user: *mut c_void) -> &'a Host<T> {
    // SAFETY: the library holds a reference as long as it calls back.
    unsafe { &*(user as *const Host<T>) }
}

/// An array of the library's as a slice; empty for NULL.
///
/// # Safety
/// `data` is NULL or points to `count` values that live as long as 'a, unchanged.
pub(crate) unsafe fn slice<'a, T>(data: *const T, count: usize) -> &'a [T] {
    if data.is_null() {
        return &[];
    }
    // SAFETY: as the caller says.
    unsafe { std::slice::from_raw_parts(data, count) }
}

/// As `slice`, to be written.
///
/// # Safety
/// As for `slice`; nothing else reads or writes them meanwhile.
pub(crate) unsafe fn slice_mut<'a, T>(data: *mut T, count: usize) -> &'a mut [T] {
    if data.is_null() {
        return &mut [];
    }
    // SAFETY: as the caller says.
    unsafe { std::slice::from_raw_parts_mut(data, count) }
}

/// The pointer of a slice for the library; NULL where it is empty.
pub(crate) fn pointer<T>(slice: &[T]) -> *const T {
    if slice.is_empty() {
        std::ptr::null()
    } else {
        slice.as_ptr()
    }
}
