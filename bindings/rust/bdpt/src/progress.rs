// SPDX-License-Identifier: Apache-2.0
//! How far a call is.

use bdpt_sys as sys;

/// How far a call is.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Work done over work asked for, in \[0,1\], never falling; by a time or noise limit, an estimate.
    pub fraction: f64,
    /// Since the call began.
    pub seconds: f64,
    /// Whole passes done by this call.
    pub passes: u64,
    /// Samples (pairs of subpaths) done by this call.
    pub samples: u64,
}

impl Progress {
    pub(crate) fn new(raw: &sys::bdpt_progress) -> Self {
        Self { fraction: raw.fraction, seconds: raw.seconds, passes: raw.passes, samples: raw.samples }
    }
}
