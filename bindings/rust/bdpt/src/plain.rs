// SPDX-License-Identifier: Apache-2.0
//! Descriptions of the library's that are being filled in.

use std::ops::{Deref, DerefMut};

/// A description whose pointers are NULL until it is passed to a call: numbers alone.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Plain<T>(T);

// SAFETY: descriptions hold numbers and NULLs; what the pointers shall point to is added to a copy, for the call.
unsafe impl<T> Send for Plain<T> {}
// SAFETY: as above.
unsafe impl<T> Sync for Plain<T> {}

impl<T> From<T> for Plain<T> {
    fn from(description: T) -> Self {
        Self(description)
    }
}

impl<T> Deref for Plain<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> DerefMut for Plain<T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}
