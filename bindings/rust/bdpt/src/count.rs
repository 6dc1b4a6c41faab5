// SPDX-License-Identifier: Apache-2.0
//! Lengths of arrays as the library takes them.

use crate::error::{Error, Result};

/// A length as 32 bits. One that is larger must never be cut: the library would read another array.
pub(crate) fn count(length: usize, what: &str) -> Result<u32> {
    u32::try_from(length).map_err(|_| Error::refused(format!("{length} {what} are too many")))
}

/// A pointer to an array's elements; NULL where there are none.
pub(crate) fn array<T>(slice: &[T]) -> *const T {
    if slice.is_empty() {
        return std::ptr::null();
    }
    slice.as_ptr()
}

/// Bytes of an array.
pub(crate) fn bytes<T>(slice: &[T]) -> u64 {
    std::mem::size_of_val(slice) as u64
}

/// An array of so many equal values; an error when there is no memory for it.
pub(crate) fn zeros<T: Copy>(length: u64, zero: T, what: &str) -> Result<Vec<T>> {
    let mut vec = Vec::new();
    match usize::try_from(length).map(|length| (length, vec.try_reserve_exact(length))) {
        Ok((length, Ok(()))) => vec.resize(length, zero),
        _ => return Err(Error::out_of_memory(what)),
    }
    Ok(vec)
}
