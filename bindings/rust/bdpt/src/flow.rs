// SPDX-License-Identifier: Apache-2.0
//! What callbacks return.

use std::ops::ControlFlow;

mod sealed {
    pub trait Sealed {}
    impl Sealed for () {}
    impl Sealed for std::ops::ControlFlow<()> {}
}

/// What a callback returns: nothing, to go on, or a [`ControlFlow`], whose `Break` stops the call.
pub trait Flow: sealed::Sealed + 'static {
    #[doc(hidden)]
    fn flow(self) -> ControlFlow<()>;
}

impl Flow for () {
    fn flow(self) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

impl Flow for ControlFlow<()> {
    fn flow(self) -> ControlFlow<()> {
        self
    }
}
