// SPDX-License-Identifier: Apache-2.0
//! Stopping a call from anywhere.

use crate::error::Result;
use crate::handle::Handle;
use crate::panics::{make, Panics};
use bdpt_sys as sys;
use std::fmt;

/// Stops the calls that it is passed to, from any thread. Clones are the same token. It may outlive everything else.
///
/// A call stops within one block of work per thread, and keeps what is finished; the next call goes on as if there had
/// been no cancel.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let token = bdpt::CancelToken::new()?;
/// let elsewhere = token.clone();
/// std::thread::spawn(move || elsewhere.cancel()).join().unwrap();
/// assert!(token.is_cancelled());
/// # Ok(()) }
/// ```
#[derive(Clone)]
pub struct CancelToken {
    raw: Handle<sys::bdpt_cancel>,
}

impl CancelToken {
    /// A fresh token.
    pub fn new() -> Result<Self> {
        // SAFETY: the pointer is writable; what comes back is one reference.
        make(
            &Panics::default(),
            |raw| unsafe { sys::bdpt_cancel_create(raw) },
            |raw| Self { raw: unsafe { Handle::new(raw) } },
        )
    }
    /// Asks the calls that have the token to stop.
    pub fn cancel(&self) {
        // SAFETY: the token is alive.
        unsafe { sys::bdpt_cancel_request(self.as_ptr()) }
    }
    /// Makes the token fresh again.
    pub fn reset(&self) {
        // SAFETY: the token is alive.
        unsafe { sys::bdpt_cancel_reset(self.as_ptr()) }
    }
    /// Whether a stop was asked for.
    pub fn is_cancelled(&self) -> bool {
        // SAFETY: the token is alive.
        unsafe { sys::bdpt_cancel_is_requested(self.as_ptr()) != 0 }
    }
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_cancel {
        self.raw.as_ptr()
    }
}

/// NULL where there is none.
pub(crate) fn token_ptr(token: &Option<CancelToken>) -> *mut sys::bdpt_cancel {
    token.as_ref().map_or(std::ptr::null_mut(), CancelToken::as_ptr)
}

impl fmt::Debug for CancelToken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CancelToken").field("cancelled", &self.is_cancelled()).finish()
    }
}
