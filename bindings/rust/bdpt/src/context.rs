// SPDX-License-Identifier: Apache-2.0
//! Threads, memory limit, log.

use crate::error::{owned, Result, Text};
use crate::executor::{self, BoxedExecutor, Executor};
use crate::handle::Handle;
use crate::host::{give_back, host, Host};
use crate::panics::{call, make, Panics};
use bdpt_sys as sys;
use std::fmt;
use std::os::raw::{c_char, c_void};
use std::path::PathBuf;
use std::ptr::null;

/// What all objects are made in: threads, a memory limit, a log, a rendering space. Clones are the same context, which
/// lives as long as any object made in it.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let context = bdpt::Context::new()?;
/// assert!(context.info()?.threads >= 1);
/// # Ok(()) }
/// ```
#[derive(Clone)]
pub struct Context {
    raw: Handle<sys::bdpt_context>,
    panics: Panics,
}

impl Context {
    /// A context of one thread per core, without memory limit, silent.
    pub fn new() -> Result<Self> {
        ContextOptions::default().create()
    }
    /// What the context is made of and what it uses.
    pub fn info(&self) -> Result<ContextInfo> {
        let mut info = sys::bdpt_context_info::default();
        // SAFETY: the context is alive, and the struct has its size set.
        call(&self.panics, || unsafe { sys::bdpt_context_get_info(self.as_ptr(), &mut info) })?;
        Ok(ContextInfo {
            threads: info.threads,
            isa: Isa::new(info.isa),
            embree: info.embree,
            memory: info.memory,
            memory_peak: info.memory_peak,
        })
    }
    pub(crate) fn as_ptr(&self) -> *mut sys::bdpt_context {
        self.raw.as_ptr()
    }
    pub(crate) fn panics(&self) -> &Panics {
        &self.panics
    }
}

impl fmt::Debug for Context {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Context").field("info", &self.info()).finish()
    }
}

/// An instruction set of the ray queries.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Isa {
    /// The widest that this machine has.
    Best,
    /// SSE 4.2.
    Sse42,
    /// AVX2.
    Avx2,
    /// AVX-512.
    Avx512,
    /// One that this version of the crate does not know.
    Other(i32),
}

impl Isa {
    fn new(isa: sys::bdpt_isa) -> Self {
        match isa {
            sys::BDPT_ISA_BEST => Self::Best,
            sys::BDPT_ISA_SSE42 => Self::Sse42,
            sys::BDPT_ISA_AVX2 => Self::Avx2,
            sys::BDPT_ISA_AVX512 => Self::Avx512,
            other => Self::Other(other),
        }
    }
    fn raw(self) -> sys::bdpt_isa {
        match self {
            Self::Best => sys::BDPT_ISA_BEST,
            Self::Sse42 => sys::BDPT_ISA_SSE42,
            Self::Avx2 => sys::BDPT_ISA_AVX2,
            Self::Avx512 => sys::BDPT_ISA_AVX512,
            Self::Other(other) => other,
        }
    }
}

/// What a [`Context`] is made of and what it uses.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContextInfo {
    /// Bodies that may run at once.
    pub threads: u32,
    /// Of the ray queries, never [`Isa::Best`].
    pub isa: Isa,
    /// Version of Embree, as 10000 major + 100 minor + patch.
    pub embree: u32,
    /// Bytes in use by scenes (Embree's included), films and blocks.
    pub memory: u64,
    /// The most that was in use.
    pub memory_peak: u64,
}

/// How much a line of the log matters.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LogLevel {
    /// Worth telling.
    Info,
    /// Probably not what was meant.
    Warning,
    /// One that this version of the crate does not know.
    Other(i32),
}

type Log = Box<dyn Fn(LogLevel, &str) + Send + Sync>;

/// What a [`Context`] is to be made of.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let context = bdpt::ContextOptions::default()
///     .threads(2)
///     .memory_limit(1 << 30)
///     .log(|level, text| eprintln!("{level:?}: {text}"))
///     .create()?;
/// assert!(context.info()?.threads <= 2);
/// # Ok(()) }
/// ```
#[derive(Default)]
pub struct ContextOptions {
    threads: u32,
    executor: Option<BoxedExecutor>,
    log: Option<Log>,
    memory_limit: u64,
    isa: Option<Isa>,
    color_config: Option<PathBuf>,
    rendering_space: Option<String>,
}

impl ContextOptions {
    /// Threads that render, the caller's included, and never more than the machine has cores; 0 = one per core. Not
    /// together with an executor.
    pub fn threads(mut self, threads: u32) -> Self {
        self.threads = threads;
        self
    }
    /// The host's threads instead of the library's.
    pub fn executor(mut self, executor: impl Executor + 'static) -> Self {
        self.executor = Some(Box::new(executor));
        self
    }
    /// Receives what is worth telling and is no error, such as triangles dropped. Called from any thread, also at the
    /// same time. A panic in it goes on where the call that wrote returns, or the next of an object of this context.
    pub fn log(mut self, log: impl Fn(LogLevel, &str) + Send + Sync + 'static) -> Self {
        self.log = Some(Box::new(log));
        self
    }
    /// Bytes for scenes, films and blocks together; 0 = no limit.
    pub fn memory_limit(mut self, bytes: u64) -> Self {
        self.memory_limit = bytes;
        self
    }
    /// The instruction set of the ray queries. Films are the same, bit for bit, only with the same one.
    pub fn isa(mut self, isa: Isa) -> Self {
        self.isa = Some(isa);
        self
    }
    /// An OpenColorIO configuration.
    pub fn color_config(mut self, path: impl Into<PathBuf>) -> Self {
        self.color_config = Some(path.into());
        self
    }
    /// A linear colour space, in which all colours of materials, lights and films are; linear Rec. 709 by default.
    pub fn rendering_space(mut self, name: impl Into<String>) -> Self {
        self.rendering_space = Some(name.into());
        self
    }
    /// Creates the context.
    pub fn create(self) -> Result<Context> {
        let panics = Panics::default();
        let config = self.color_config.map(|path| Text::path(&path)).transpose()?;
        let space = Text::new(&self.rendering_space)?;
        let executor = self.executor.map(|executor| (executor.worker_count(), Host::lend(executor, &panics)));
        let log = self.log.map(|log| Host::lend(log, &panics));
        let raw_executor = executor.as_ref().map(|(worker_count, lent)| sys::bdpt_executor {
            worker_count: *worker_count,
            run: Some(executor::run),
            user: lent.user(),
            drop: Some(give_back::<BoxedExecutor>),
            ..Default::default()
        });
        let raw_log = log.as_ref().map(|lent| sys::bdpt_log {
            write: Some(write),
            user: lent.user(),
            drop: Some(give_back::<Log>),
            ..Default::default()
        });
        let desc = sys::bdpt_context_desc {
            threads: self.threads,
            executor: raw_executor.as_ref().map_or(null(), |executor| executor),
            log: raw_log.as_ref().map_or(null(), |log| log),
            memory_limit: self.memory_limit,
            isa: self.isa.map_or(sys::BDPT_ISA_BEST, Isa::raw),
            color_config: config.as_ref().map_or(null(), Text::as_ptr),
            rendering_space: space.as_ptr(),
            ..Default::default()
        };
        let made = make(
            &panics,
            // SAFETY: all that desc points to lives until the call returns, but for the values lent, which it takes.
            |raw| unsafe { sys::bdpt_context_create(sys::BDPT_ABI, &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| Context { raw: unsafe { Handle::new(raw) }, panics: panics.clone() },
        );
        if made.is_err() {
            // SAFETY: the call has failed; these are the pointers that it was given.
            unsafe {
                if let (Some((_, lent)), Some(raw)) = (executor, &raw_executor) {
                    lent.call_failed(raw.user);
                }
                if let (Some(lent), Some(raw)) = (log, &raw_log) {
                    lent.call_failed(raw.user);
                }
            }
        }
        made
    }
}

impl fmt::Debug for ContextOptions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ContextOptions")
            .field("threads", &self.threads)
            .field("executor", &self.executor.is_some())
            .field("log", &self.log.is_some())
            .field("memory_limit", &self.memory_limit)
            .field("isa", &self.isa)
            .field("color_config", &self.color_config)
            .field("rendering_space", &self.rendering_space)
            .finish()
    }
}

unsafe extern "C" fn write(user: *mut c_void, level: sys::bdpt_log_level, text: *const c_char) {
    // SAFETY: `user` is that of a context that lives.
    let log = unsafe { host::<Log>(user) };
    log.panics.catch(|| {
        // SAFETY: a text of the library's, valid during the call.
        let text = unsafe { owned(text) };
        let level = match level {
            sys::BDPT_LOG_INFO => LogLevel::Info,
            sys::BDPT_LOG_WARNING => LogLevel::Warning,
            other => LogLevel::Other(other),
        };
        (log.value)(level, &text);
    });
}

/// The library's version: major, minor, patch.
pub fn version() -> (u32, u32, u32) {
    // SAFETY: no conditions.
    let packed = unsafe { sys::bdpt_version() };
    (packed >> 16, packed >> 8 & 0xff, packed & 0xff)
}
