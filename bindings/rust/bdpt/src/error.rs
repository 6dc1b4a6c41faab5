// SPDX-License-Identifier: Apache-2.0
//! What can go wrong, as a code and a sentence.

use bdpt_sys as sys;
use std::ffi::{CStr, CString};
use std::fmt;
use std::path::Path;

/// The kind of an [`Error`].
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ErrorCode {
    /// Stopped by a [`CancelToken`](crate::CancelToken), before there was a result.
    Cancelled,
    /// An argument is out of range, not finite or unknown.
    InvalidArgument,
    /// An id was removed, or is of another builder.
    InvalidId,
    /// The system has no memory left.
    OutOfMemory,
    /// The context's memory limit would be exceeded.
    MemoryLimit,
    /// Not in this build of the library, or not on this machine.
    Unsupported,
    /// The library is of another ABI version than this crate.
    Abi,
    /// A file could not be opened, read or written.
    Io,
    /// A file is damaged or of another kind.
    Format,
    /// Two objects do not fit: other scene, options, size, or overlapping passes.
    Mismatch,
    /// The object is still referred to by another.
    InUse,
    /// Called from inside a callback that does not allow it.
    Reentrant,
    /// A callback asked to stop.
    CallbackFailed,
    /// A fault of the library: please report it.
    Internal,
    /// A code that this version of the crate does not know.
    Other(i32),
}

impl ErrorCode {
    fn new(code: sys::bdpt_result) -> Self {
        match code {
            sys::BDPT_CANCELLED => Self::Cancelled,
            sys::BDPT_ERROR_INVALID_ARGUMENT => Self::InvalidArgument,
            sys::BDPT_ERROR_INVALID_ID => Self::InvalidId,
            sys::BDPT_ERROR_OUT_OF_MEMORY => Self::OutOfMemory,
            sys::BDPT_ERROR_MEMORY_LIMIT => Self::MemoryLimit,
            sys::BDPT_ERROR_UNSUPPORTED => Self::Unsupported,
            sys::BDPT_ERROR_ABI => Self::Abi,
            sys::BDPT_ERROR_IO => Self::Io,
            sys::BDPT_ERROR_FORMAT => Self::Format,
            sys::BDPT_ERROR_MISMATCH => Self::Mismatch,
            sys::BDPT_ERROR_IN_USE => Self::InUse,
            sys::BDPT_ERROR_REENTRANT => Self::Reentrant,
            sys::BDPT_ERROR_CALLBACK_FAILED => Self::CallbackFailed,
            sys::BDPT_ERROR_INTERNAL => Self::Internal,
            other => Self::Other(other),
        }
    }
}

/// Why a call failed. A call that fails has changed nothing.
///
/// ```
/// let error = bdpt::ContextOptions::default().threads(1_000_000).create().err().unwrap();
/// assert_eq!(error.code(), bdpt::ErrorCode::InvalidArgument);
/// assert!(error.to_string().contains("1000000"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    code: ErrorCode,
    text: String,
}

impl Error {
    /// The kind, to branch on.
    pub fn code(&self) -> ErrorCode {
        self.code
    }
    /// What went wrong: function, field, object and value, in one sentence.
    pub fn text(&self) -> &str {
        &self.text
    }
    pub(crate) fn out_of_memory(what: impl fmt::Display) -> Self {
        Self { code: ErrorCode::OutOfMemory, text: format!("no memory for {what}") }
    }
    /// An error that is found before the library is asked.
    pub(crate) fn refused(text: impl Into<String>) -> Self {
        Self { code: ErrorCode::InvalidArgument, text: text.into() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl std::error::Error for Error {}

/// The result of all that can fail.
pub type Result<T> = std::result::Result<T, Error>;

/// Success, or the error of the call that this thread has just made.
pub(crate) fn check(result: sys::bdpt_result) -> Result<()> {
    match result {
        sys::BDPT_OK => Ok(()),
        sys::BDPT_CANCELLED => Err(Error { code: ErrorCode::Cancelled, text: "cancelled".to_string() }),
        code => {
            // SAFETY: the text is never NULL, and valid until this thread's next call into the library.
            let text = unsafe { owned(sys::bdpt_last_error()) };
            Err(Error { code: ErrorCode::new(code), text })
        }
    }
}

/// A copy of a text of the library; empty for NULL.
///
/// # Safety
/// `text` is NULL, or ends with a zero byte and is valid during the call.
pub(crate) unsafe fn owned(text: *const std::os::raw::c_char) -> String {
    if text.is_null() {
        return String::new();
    }
    // SAFETY: not NULL; the caller vouches for the rest.
    unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
}

fn c_string(bytes: &[u8]) -> Result<CString> {
    CString::new(bytes).map_err(|error| {
        let text = String::from_utf8_lossy(bytes);
        Error::refused(format!("{text:?} has a zero byte at position {}", error.nul_position()))
    })
}

/// A text for the library; NULL where there is none.
pub(crate) struct Text(Option<CString>);

impl Text {
    pub(crate) fn new(text: &Option<String>) -> Result<Self> {
        Ok(Self(text.as_deref().map(|text| c_string(text.as_bytes())).transpose()?))
    }
    /// A path as the system has it, so that names which are no UTF-8 work, too.
    pub(crate) fn path(path: &Path) -> Result<Self> {
        #[cfg(unix)]
        let bytes = std::os::unix::ffi::OsStrExt::as_bytes(path.as_os_str());
        #[cfg(not(unix))]
        let bytes = path.to_str().ok_or_else(|| Error::refused("a path is no Unicode text"))?.as_bytes();
        Ok(Self(Some(c_string(bytes)?)))
    }
    /// Valid as long as `self`.
    pub(crate) fn as_ptr(&self) -> *const std::os::raw::c_char {
        self.0.as_ref().map_or(std::ptr::null(), |text| text.as_ptr())
    }
}
