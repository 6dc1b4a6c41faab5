// SPDX-License-Identifier: Apache-2.0
//! The host's threads in place of the library's.

use crate::host::host;
use crate::panics::{frame, Panics};
use std::os::raw::c_void;
use std::sync::atomic::{AtomicBool, Ordering};

/// The host's threads. With an executor the library starts none.
///
/// Whatever an implementation does is safe: an index that is given twice, or that there is none of, is passed over, and
/// bodies that were left out run on the calling thread after [`run`](Self::run) has returned, also when it panics.
///
/// ```
/// /// Everything on the calling thread.
/// struct Alone;
/// impl bdpt::Executor for Alone {
///     fn worker_count(&self) -> u32 {
///         1
///     }
///     fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
///         (0..n).for_each(body);
///     }
/// }
/// # fn main() -> bdpt::Result<()> {
/// let context = bdpt::ContextOptions::default().executor(Alone).create()?;
/// assert_eq!(context.info()?.threads, 1);
/// # Ok(()) }
/// ```
///
/// The bodies cannot be kept beyond the call:
/// ```compile_fail,E0521
/// # use std::sync::Mutex;
/// type Body = &'static (dyn Fn(u32) + Sync);
/// struct Keeps(Mutex<Option<Body>>);
/// impl bdpt::Executor for Keeps {
///     fn worker_count(&self) -> u32 {
///         1
///     }
///     fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
///         *self.0.lock().unwrap() = Some(body);
///     }
/// }
/// ```
pub trait Executor: Send + Sync {
    /// How many bodies may run at once, 1 to 4096.
    fn worker_count(&self) -> u32;
    /// Calls `body(i)` once for each `i` in `0..n`, on any threads, and returns when all have returned.
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync));
}

pub(crate) type BoxedExecutor = Box<dyn Executor>;
type Body = unsafe extern "C" fn(*mut c_void, u32);

/// The library's body, with what makes it safe to call from anywhere and with anything.
struct Bodies {
    body: Body,
    user: *mut c_void,
    started: Vec<AtomicBool>,
    /// Of callbacks that ran in bodies, on whatever thread.
    panics: Panics,
}

// SAFETY: the library's body may be called from several threads at once, and takes its `user` there.
unsafe impl Sync for Bodies {}

impl Bodies {
    fn run(&self, i: u32) {
        let started = self.started.get(i as usize);
        if started.map_or(true, |started| started.swap(true, Ordering::AcqRel)) {
            return;
        }
        // SAFETY: i < n, and this is the first call with it; `run` below has not returned, for `self` is borrowed.
        let ((), payload) = frame(|| unsafe { (self.body)(self.user, i) });
        if let Some(payload) = payload {
            self.panics.keep_there(payload);
        }
    }
}

pub(crate) unsafe extern "C" fn run(user: *mut c_void, n: u32, body: Option<Body>, body_user: *mut c_void) {
    // SAFETY: `user` is that of a context that lives.
    let executor = unsafe { host::<BoxedExecutor>(user) };
    if let Some(body) = body {
        let bodies = Bodies {
            body,
            user: body_user,
            started: (0..n).map(|_| AtomicBool::new(false)).collect(),
            panics: Panics::default(),
        };
        executor.panics.catch(|| executor.value.run(n, &|i| bodies.run(i)));
        (0..n).for_each(|i| bodies.run(i));
        if let Some(payload) = bodies.panics.take() {
            executor.panics.keep(payload);
        }
    }
}
