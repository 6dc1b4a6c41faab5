// SPDX-License-Identifier: Apache-2.0
//! Arrays of a mesh, given to the library without a copy.

use crate::error::{Error, Result};
use crate::panics::Panics;
use bdpt_sys as sys;
use std::fmt;
use std::marker::PhantomData;
use std::mem::size_of;
use std::ops::Range;
use std::os::raw::c_void;
use std::sync::Arc;

mod sealed {
    pub trait Sealed {}
}

/// What arrays are made of: `[f32; 3]` for positions and normals, `[u32; 3]` or `[u16; 3]` for triangles, and so on.
pub trait Element: sealed::Sealed + Copy + Send + Sync + 'static {
    /// What it consists of: `f32`, `u32` or `u16`.
    type Number: Copy + Send + Sync + 'static;
    #[doc(hidden)]
    const FORMAT: i32;
}

macro_rules! element {
    ($type:ty, $number:ty, $format:ident) => {
        impl sealed::Sealed for $type {}
        impl Element for $type {
            type Number = $number;
            const FORMAT: i32 = sys::$format;
        }
    };
}

element!(f32, f32, BDPT_FORMAT_FLOAT1);
element!([f32; 2], f32, BDPT_FORMAT_FLOAT2);
element!([f32; 3], f32, BDPT_FORMAT_FLOAT3);
element!([f32; 4], f32, BDPT_FORMAT_FLOAT4);
element!(u32, u32, BDPT_FORMAT_UINT32);
element!([u32; 3], u32, BDPT_FORMAT_UINT32X3);
element!([u16; 3], u16, BDPT_FORMAT_UINT16X3);

/// Readable bytes behind the last element, with which the library needs no copy of positions and indices.
const SLACK: usize = 16;

/// An array for the library, which owns it from then on: it is dropped with the last builder or scene that needs it.
///
/// A `Vec`, an `Arc<[T]>` or any other [owner](Self::from_owner) is kept, not copied; a slice is copied.
///
/// Of positions and indices, up to 16 bytes behind the last element are read. A `Vec` gets room for them, which moves
/// it unless it has capacity for two elements more. What is shared has no room, unless it is a [`range`](Self::range)
/// of something larger: without it the library copies indices, and positions for the ray queries.
///
/// The library also makes its own of 16-bit indices, of indices when it drops triangles without area, of normals that
/// are not unit, and of colours without opacity. Curves and subdivision surfaces are made into something else, and
/// their arrays are dropped when they are added.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::Data;
/// use std::sync::Arc;
/// let owned = Data::from(vec![[0.0_f32; 3]; 100]);
/// let shared: Arc<[[f32; 3]]> = vec![[0.0; 3]; 200].into();
/// let half = Data::range(shared, 0..100)?;
/// // A vertex buffer of 8 floats to a vertex: position, normal, uv.
/// let buffer: Arc<[f32]> = vec![0.0; 8 * 100].into();
/// let positions = Data::<[f32; 3]>::interleaved(buffer.clone(), 0, 8)?;
/// let normals = Data::<[f32; 3]>::interleaved(buffer, 3, 8)?;
/// assert_eq!([owned.len(), half.len(), positions.len(), normals.len()], [100; 4]);
/// # Ok(()) }
/// ```
///
/// What is kept cannot be borrowed:
/// ```compile_fail,E0597
/// let positions = vec![[0.0_f32; 3]; 100];
/// let mesh = bdpt::Mesh::new(bdpt::Data::from_owner(&positions));
/// # drop(mesh);
/// ```
pub struct Data<T: Element> {
    storage: Storage<T>,
}

enum Storage<T: Element> {
    Vec(Vec<T>),
    Owner(View<T>),
}

/// Elements in memory that an owner keeps.
struct View<T: Element> {
    _owner: Owner,
    first: *const T::Number,
    count: usize,
    /// In bytes; 0 = packed.
    stride: usize,
    slack: usize,
    element: PhantomData<T>,
}

// SAFETY: the owner is Send + Sync, `first` points to what it gave by a shared reference, and it is only read.
unsafe impl<T: Element> Send for View<T> {}
// SAFETY: as above.
unsafe impl<T: Element> Sync for View<T> {}

trait Anything: Send + Sync {}
impl<T: Send + Sync> Anything for T {}

/// A box seen as a pointer, so that moving it does not touch what is borrowed from it.
struct Owner(*mut dyn Anything);

impl Owner {
    fn new<O: Send + Sync + 'static>(owner: O) -> (Self, *const O) {
        let owner = Box::into_raw(Box::new(owner));
        (Self(owner), owner)
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        // SAFETY: from Box::into_raw, and dropped once.
        drop(unsafe { Box::from_raw(self.0) });
    }
}

// SAFETY: the box's content is.
unsafe impl Send for Owner {}
// SAFETY: as above.
unsafe impl Sync for Owner {}

/// The slice of an owner.
///
/// # Safety
/// `owner` is valid for 'a, and only shared references to it are made meanwhile.
unsafe fn content<'a, O: AsRef<[N]> + 'a, N: 'a>(owner: *const O) -> &'a [N] {
    // SAFETY: as the caller says.
    unsafe { &*owner }.as_ref()
}

impl<T: Element> Data<T> {
    /// All that an owner has, such as a memory-mapped file. It is kept, and asked once.
    pub fn from_owner(owner: impl AsRef<[T]> + Send + Sync + 'static) -> Self {
        let (owner, pointer) = Owner::new(owner);
        // SAFETY: the view keeps the owner as long as it uses what it borrows.
        let elements: &[T] = unsafe { content(pointer) };
        Self::view(owner, elements.as_ptr().cast(), elements.len(), 0, 0)
    }

    /// A part of what an owner has, such as a `Vec` or an `Arc<[T]>`. What lies behind it may save a copy.
    ///
    /// # Errors
    /// When the range is not within it.
    pub fn range(owner: impl AsRef<[T]> + Send + Sync + 'static, range: Range<usize>) -> Result<Self> {
        let (owner, pointer) = Owner::new(owner);
        // SAFETY: the view keeps the owner as long as it uses what it borrows.
        let all: &[T] = unsafe { content(pointer) };
        let part = all.get(range.clone()).ok_or_else(|| {
            Error::refused(format!(
                "elements {}..{} of an array of {}: give a range within it",
                range.start,
                range.end,
                all.len()
            ))
        })?;
        let slack = (all.len() - range.end) * size_of::<T>();
        Ok(Self::view(owner, part.as_ptr().cast(), part.len(), 0, slack))
    }

    /// Every `stride` numbers of what an owner has, beginning with number `offset`: a part of each vertex of a vertex
    /// buffer. There are as many as fit.
    ///
    /// # Errors
    /// When the stride is smaller than the element.
    pub fn interleaved(
        owner: impl AsRef<[T::Number]> + Send + Sync + 'static,
        offset: usize,
        stride: usize,
    ) -> Result<Self> {
        let (owner, pointer) = Owner::new(owner);
        // SAFETY: the view keeps the owner as long as it uses what it borrows.
        let all: &[T::Number] = unsafe { content(pointer) };
        let numbers = size_of::<T>() / size_of::<T::Number>();
        if stride < numbers {
            return Err(Error::refused(format!("stride is {stride}, but an element has {numbers} numbers")));
        }
        let from_first = all.get(offset..).unwrap_or_default();
        let count = if from_first.len() < numbers { 0 } else { (from_first.len() - numbers) / stride + 1 };
        let end = if count == 0 { 0 } else { (count - 1) * stride + numbers };
        let slack = (from_first.len() - end) * size_of::<T::Number>();
        let stride = stride.checked_mul(size_of::<T::Number>()).filter(|_| count > 1).unwrap_or(0);
        Ok(Self::view(owner, from_first.as_ptr(), count, stride, slack))
    }

    fn view(owner: Owner, first: *const T::Number, count: usize, stride: usize, slack: usize) -> Self {
        Self { storage: Storage::Owner(View { _owner: owner, first, count, stride, slack, element: PhantomData }) }
    }

    /// How many elements there are.
    pub fn len(&self) -> usize {
        match &self.storage {
            Storage::Vec(vec) => vec.len(),
            Storage::Owner(view) => view.count,
        }
    }
    /// Whether there is none. An array without elements is as one that was not given.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// For a call that copies: valid as long as `self`.
    pub(crate) fn look(&self) -> sys::bdpt_data {
        if self.is_empty() {
            return sys::bdpt_data::default();
        }
        let (data, stride, slack_bytes): (*const c_void, usize, usize) = match &self.storage {
            Storage::Vec(vec) => (vec.as_ptr().cast(), 0, 0),
            Storage::Owner(view) => (view.first.cast(), view.stride, view.slack),
        };
        sys::bdpt_data {
            data,
            count: self.len() as u64,
            stride: stride as u64,
            format: T::FORMAT,
            slack_bytes: slack_bytes as u64,
            ..Default::default()
        }
    }

    /// Gives the array to the library: to be passed to one call, which gives it back when it fails.
    pub(crate) fn lend(self, panics: &Panics) -> sys::bdpt_data {
        if self.is_empty() {
            return sys::bdpt_data::default();
        }
        let view = self.look();
        let lease = Box::new(Lease { _data: Box::new(self), panics: panics.clone() });
        sys::bdpt_data {
            ownership: sys::BDPT_OWNERSHIP_BORROW,
            release: Some(release),
            user: Box::into_raw(lease).cast(),
            ..view
        }
    }

    /// As `lend`, of what is read beyond its end: with room there, where there can be.
    pub(crate) fn lend_with_slack(mut self, panics: &Panics) -> sys::bdpt_data {
        let mut made = 0;
        if let Storage::Vec(vec) = &mut self.storage {
            let extra = (SLACK + size_of::<T>() - 1) / size_of::<T>();
            if let (Some(last), Ok(())) = (vec.last().copied(), vec.try_reserve_exact(extra)) {
                for slot in vec.spare_capacity_mut().iter_mut().take(extra) {
                    slot.write(last);
                    made += size_of::<T>();
                }
            }
        }
        let lent = self.lend(panics);
        sys::bdpt_data { slack_bytes: lent.slack_bytes.max(made as u64), ..lent }
    }
}

/// What the library has of an array.
struct Lease {
    _data: Box<dyn Anything>,
    panics: Panics,
}

unsafe extern "C" fn release(user: *mut c_void, _data: *const c_void) {
    // SAFETY: `user` is from Data::lend, and the library calls this once.
    let Lease { _data, panics } = *unsafe { Box::from_raw(user.cast::<Lease>()) };
    panics.catch(|| drop(_data));
}

impl<T: Element> Default for Data<T> {
    fn default() -> Self {
        Vec::new().into()
    }
}
impl<T: Element> From<Vec<T>> for Data<T> {
    fn from(vec: Vec<T>) -> Self {
        Self { storage: Storage::Vec(vec) }
    }
}
impl<T: Element> From<Arc<[T]>> for Data<T> {
    fn from(arc: Arc<[T]>) -> Self {
        Self::from_owner(arc)
    }
}
impl<T: Element> From<&[T]> for Data<T> {
    fn from(slice: &[T]) -> Self {
        slice.to_vec().into()
    }
}
impl<T: Element, const N: usize> From<&[T; N]> for Data<T> {
    fn from(array: &[T; N]) -> Self {
        array.to_vec().into()
    }
}
impl<T: Element, const N: usize> From<[T; N]> for Data<T> {
    fn from(array: [T; N]) -> Self {
        array.to_vec().into()
    }
}

impl<T: Element> fmt::Debug for Data<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Data").field("len", &self.len()).finish()
    }
}
