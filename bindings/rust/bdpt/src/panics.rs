// SPDX-License-Identifier: Apache-2.0
//! Panics in callbacks: they end at the library's edge, and go on when its call has returned.
//!
//! Every callback runs inside [`Panics::catch`], so that nothing unwinds through the library. The payload is kept in
//! the frame of the call that this thread is in the middle of, or, on a thread of the library's own, in the slot of the
//! object whose callback it is. When the call returns, [`call`] and [`make`] resume what they find in either.

use crate::error::{check, Result};
use bdpt_sys as sys;
use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::ptr::{null, null_mut};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

pub(crate) type Payload = Box<dyn Any + Send>;

/// A call into the library that this thread is in the middle of.
struct Frame {
    outer: *const Frame,
    payload: RefCell<Option<Payload>>,
}

thread_local! {
    static INNERMOST: Cell<*const Frame> = const { Cell::new(null()) };
}

/// Runs a call into the library and gives what a callback of it panicked with on this thread.
pub(crate) fn frame<R>(call: impl FnOnce() -> R) -> (R, Option<Payload>) {
    struct Restore(*const Frame);
    impl Drop for Restore {
        fn drop(&mut self) {
            INNERMOST.with(|innermost| innermost.set(self.0));
        }
    }
    let frame = Frame { outer: INNERMOST.with(Cell::get), payload: RefCell::new(None) };
    let restore = Restore(frame.outer);
    INNERMOST.with(|innermost| innermost.set(&frame));
    let result = call();
    drop(restore);
    (result, frame.payload.into_inner())
}

/// Keeps a payload for the call that this thread is in the middle of; gives it back where there is none.
fn keep_here(payload: Payload) -> Option<Payload> {
    let frame = INNERMOST.with(Cell::get);
    if frame.is_null() {
        return Some(payload);
    }
    // SAFETY: `frame` resets INNERMOST before its Frame goes, so this is one that lives further down this stack.
    let mut kept = unsafe { &*frame }.payload.borrow_mut();
    if kept.is_none() {
        *kept = Some(payload);
    } else {
        discard(payload);
    }
    None
}

/// Runs the host's code inside a callback of the call that this thread is in the middle of; `None` if it panicked.
pub(crate) fn catch_here<R>(code: impl FnOnce() -> R) -> Option<R> {
    match catch_unwind(AssertUnwindSafe(code)) {
        Ok(result) => Some(result),
        Err(payload) => {
            if let Some(payload) = keep_here(payload) {
                discard(payload);
            }
            None
        }
    }
}

/// Whether a callback of the call that this thread is in the middle of panicked.
pub(crate) fn is_set_here() -> bool {
    let frame = INNERMOST.with(Cell::get);
    // SAFETY: as in keep_here.
    !frame.is_null() && unsafe { &*frame }.payload.borrow().is_some()
}

/// Drops a payload whose own drop may panic, again and again.
pub(crate) fn discard(mut payload: Payload) {
    for _ in 0..16 {
        match catch_unwind(AssertUnwindSafe(|| drop(payload))) {
            Ok(()) => return,
            Err(again) => payload = again,
        }
    }
    // One that never ends is left where it is.
    std::mem::forget(payload);
}

/// The first payload of an object's callbacks on threads of the library's own. Copies share it.
#[derive(Clone, Default)]
pub(crate) struct Panics(Arc<Slot>);

#[derive(Default)]
struct Slot {
    payload: Mutex<Option<Payload>>,
    /// Of what the object was made in or of: what is resumed for it includes these.
    outer: [Option<Panics>; 2],
}

impl Panics {
    /// Those of an object made in a context.
    pub(crate) fn of_child(&self) -> Self {
        Self(Arc::new(Slot { payload: Mutex::default(), outer: [Some(self.clone()), None] }))
    }
    /// Those of two objects.
    pub(crate) fn and(&self, other: &Self) -> Self {
        Self(Arc::new(Slot { payload: Mutex::default(), outer: [Some(self.clone()), Some(other.clone())] }))
    }

    fn slot(&self) -> MutexGuard<'_, Option<Payload>> {
        self.0.payload.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Runs the host's code inside of a callback; `None` if it panicked, which is kept.
    pub(crate) fn catch<R>(&self, code: impl FnOnce() -> R) -> Option<R> {
        match catch_unwind(AssertUnwindSafe(code)) {
            Ok(result) => Some(result),
            Err(payload) => {
                self.keep(payload);
                None
            }
        }
    }

    /// Keeps a payload unless there is one.
    pub(crate) fn keep(&self, payload: Payload) {
        if let Some(payload) = keep_here(payload) {
            self.keep_there(payload);
        }
    }

    /// Keeps a payload in this slot, whatever call this thread is in, unless there is one.
    pub(crate) fn keep_there(&self, payload: Payload) {
        let mut slot = self.slot();
        if slot.is_none() {
            *slot = Some(payload);
        } else {
            drop(slot);
            discard(payload);
        }
    }

    /// Whether a callback on another thread panicked.
    pub(crate) fn is_set(&self) -> bool {
        self.slot().is_some() || self.0.outer.iter().flatten().any(Panics::is_set)
    }

    pub(crate) fn take(&self) -> Option<Payload> {
        let own = self.slot().take();
        own.or_else(|| self.0.outer.iter().flatten().find_map(Panics::take))
    }

    /// Goes on with a panic that was kept: that of this thread's call, or one of another thread. No other is left for
    /// the next call, which would have nothing to do with it.
    pub(crate) fn resume(&self, here: Option<Payload>) {
        let mut first = here;
        while let Some(payload) = self.take() {
            if first.is_none() {
                first = Some(payload);
            } else {
                discard(payload);
            }
        }
        if let Some(payload) = first {
            resume_unwind(payload);
        }
    }
}

/// Makes a call into the library; a panic in one of its callbacks goes on from here.
pub(crate) fn call(panics: &Panics, call: impl FnOnce() -> sys::bdpt_result) -> Result<()> {
    let (result, payload) = frame(|| check(call()));
    panics.resume(payload);
    result
}

/// Makes a call that gives a handle. `wrap` comes before a panic goes on, so that the handle is released then, too.
pub(crate) fn make<Raw, T>(
    panics: &Panics,
    call: impl FnOnce(*mut *mut Raw) -> sys::bdpt_result,
    wrap: impl FnOnce(*mut Raw) -> T,
) -> Result<T> {
    let mut raw = null_mut();
    let (result, payload) = frame(|| check(call(&mut raw)));
    let made = result.map(|()| wrap(raw));
    panics.resume(payload);
    made
}

/// Makes a call that lets go of something, and with it perhaps of values of the host's, whose drops may panic.
pub(crate) fn release(call: impl FnOnce()) {
    let ((), payload) = frame(call);
    match payload {
        Some(payload) if std::thread::panicking() => discard(payload),
        Some(payload) => resume_unwind(payload),
        None => {}
    }
}
