// SPDX-License-Identifier: Apache-2.0
//! Textures: images, and functions of the host's.

use crate::error::{Error, Result, Text};
use crate::host::{host, pointer, slice, slice_mut};
use crate::id::InstanceId;
use crate::plain::Plain;
use bdpt_sys as sys;
use std::fmt;
use std::mem::size_of;
use std::os::raw::c_void;

mod sealed {
    pub trait Sealed {}
}

/// What the channels of a [`Texture`] are made of: `u8` (255 is 1), `u16` (65535 is 1), `f32`, or [`Half`].
pub trait Texel: sealed::Sealed + Copy {
    #[doc(hidden)]
    const TEXEL: i32;
}
macro_rules! texel {
    ($type:ty, $texel:ident) => {
        impl sealed::Sealed for $type {}
        impl Texel for $type {
            const TEXEL: i32 = sys::$texel;
        }
    };
}
texel!(u8, BDPT_TEXEL_UINT8);
texel!(u16, BDPT_TEXEL_UINT16);
texel!(f32, BDPT_TEXEL_FLOAT);
texel!(Half, BDPT_TEXEL_HALF);

/// The bits of a 16-bit float.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Half(pub u16);

/// An image, which the library copies. How it is looked up is said where it is used
/// ([`TextureUse`](crate::TextureUse)).
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let checker = [255_u8, 255, 255, 20, 20, 20, 20, 20, 20, 255, 255, 255];
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_texture(bdpt::Texture::srgb(2, 2, 3, &checker).label("checker"))?;
/// # Ok(()) }
/// ```
#[derive(Clone)]
pub struct Texture<'a> {
    label: Option<String>,
    pixels: &'a [u8],
    texel_size: usize,
    row_stride: usize,
    color_space: Option<String>,
    raw: Plain<sys::bdpt_texture_desc>,
}

impl<'a> Texture<'a> {
    /// Colours that the sRGB curve encodes; alpha is linear. 1 to 4 channels: grey; grey, alpha; red, green, blue; red,
    /// green, blue, alpha. The top row comes first.
    pub fn srgb<T: Texel>(width: u32, height: u32, channels: u32, pixels: &'a [T]) -> Self {
        Self::new(width, height, channels, pixels, sys::BDPT_ENCODING_SRGB)
    }
    /// Numbers: data, or colours in the rendering space. Channels as in [`srgb`](Self::srgb).
    pub fn linear<T: Texel>(width: u32, height: u32, channels: u32, pixels: &'a [T]) -> Self {
        Self::new(width, height, channels, pixels, sys::BDPT_ENCODING_LINEAR)
    }
    /// Colours of a space by its name, which are converted to the rendering space. Channels as in [`srgb`](Self::srgb).
    pub fn in_space<T: Texel>(
        space: impl Into<String>,
        width: u32,
        height: u32,
        channels: u32,
        pixels: &'a [T],
    ) -> Self {
        Self { color_space: Some(space.into()), ..Self::new(width, height, channels, pixels, 0) }
    }
    fn new<T: Texel>(width: u32, height: u32, channels: u32, pixels: &'a [T], encoding: sys::bdpt_encoding) -> Self {
        // SAFETY: texels are numbers without padding, so that all their bytes can be read.
        let bytes = unsafe { std::slice::from_raw_parts(pixels.as_ptr().cast::<u8>(), std::mem::size_of_val(pixels)) };
        Self {
            label: None,
            pixels: bytes,
            texel_size: size_of::<T>(),
            row_stride: 0,
            color_space: None,
            raw: sys::bdpt_texture_desc { width, height, channels, texel: T::TEXEL, encoding, ..Default::default() }
                .into(),
        }
    }
    labelled!();
    /// Numbers from row to row; 0 = packed.
    pub fn row_stride(mut self, numbers: usize) -> Self {
        self.row_stride = numbers;
        self
    }
    setters! {
        /// At most so many levels, up to 17, the image being one; each halves the one before. 0 = 1.
        mip_levels: u32 => mip_levels;
    }

    /// Checks that there are as many texels as the description says, and makes the call.
    pub(crate) fn with_desc<R>(&self, call: impl FnOnce(&sys::bdpt_texture_desc) -> Result<R>) -> Result<R> {
        let sys::bdpt_texture_desc { width, height, channels, .. } = *self.raw;
        let packed = u128::from(width) * u128::from(channels);
        let stride = if self.row_stride == 0 { packed } else { self.row_stride as u128 };
        let needed = if height == 0 { 0 } else { u128::from(height - 1) * stride + packed };
        let given = self.pixels.len() / self.texel_size;
        if needed > given as u128 {
            return Err(Error::refused(format!(
                "a texture of {width} x {height} pixels, {channels} channels each, takes {needed} numbers, not {given}"
            )));
        }
        let (label, color_space) = (Text::new(&self.label)?, Text::new(&self.color_space)?);
        call(&sys::bdpt_texture_desc {
            label: label.as_ptr(),
            pixels: pointer(self.pixels).cast(),
            row_stride: (self.row_stride as u64).saturating_mul(self.texel_size as u64),
            color_space: color_space.as_ptr(),
            ..*self.raw
        })
    }
}

impl fmt::Debug for Texture<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sys::bdpt_texture_desc { width, height, channels, .. } = *self.raw;
        f.debug_struct("Texture")
            .field("label", &self.label)
            .field("size", &[width, height, channels])
            .finish_non_exhaustive()
    }
}

/// Where a [`HostTexture`] is looked up.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexturePlace(sys::bdpt_texture_place);

impl TexturePlace {
    /// Texture coordinates of the use: by its uv set and its transform, not wrapped.
    pub fn uv(&self) -> [f32; 2] {
        self.0.uv
    }
    /// In the world.
    pub fn position(&self) -> [f32; 3] {
        self.0.position
    }
    /// Whose surface it is.
    pub fn instance(&self) -> InstanceId {
        InstanceId(self.0.instance)
    }
}

/// A texture of yours: a function that computes colours, for patterns and noise. It is used like an image, but not for
/// opacity and emission, nor by lights.
///
/// It must depend on nothing but the place: else techniques disagree, and no two renders are the same. It is called on
/// any thread that renders, several at a time. A panic in it stops the render, and goes on where
/// [`Render::advance`](crate::Render::advance) returns.
///
/// ```
/// struct Stripes;
/// impl bdpt::HostTexture for Stripes {
///     fn look_up(&self, places: &[bdpt::TexturePlace], colors: &mut [[f32; 4]]) {
///         for (place, color) in places.iter().zip(colors) {
///             *color = if (8.0 * place.uv()[0]).fract() < 0.5 { [0.1, 0.1, 0.1, 1.0] } else { [0.9, 0.9, 0.9, 1.0] };
///         }
///     }
///     fn hash(&self) -> u64 {
///         1
///     }
/// }
/// # fn main() -> bdpt::Result<()> {
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// let stripes = builder.add_host_texture(Stripes)?;
/// builder.add_material(bdpt::Material::diffuse([1.0; 3]).reflectance_texture(stripes))?;
/// # Ok(()) }
/// ```
///
/// What it has may be used by several threads:
/// ```compile_fail,E0277
/// struct Counts(std::cell::Cell<u32>);
/// impl bdpt::HostTexture for Counts {
///     fn look_up(&self, _: &[bdpt::TexturePlace], _: &mut [[f32; 4]]) {
///         self.0.set(self.0.get() + 1);
///     }
///     fn hash(&self) -> u64 {
///         1
///     }
/// }
/// ```
pub trait HostTexture: Send + Sync {
    /// Fills red, green, blue and alpha of each place; linear, in the rendering space. A colour that is negative, above
    /// [`maximum`](Self::maximum), not finite, or left as it came, ends the subpath there: it is counted as rejected.
    fn look_up(&self, places: &[TexturePlace], colors: &mut [[f32; 4]]);
    /// Of all that decides the colours: films of other scenes do not merge. Asked once.
    fn hash(&self) -> u64;
    /// The largest number of all four channels. Slots that take at most 1 refuse more. Asked once.
    fn maximum(&self) -> f32 {
        1.0
    }
    /// As a bump map: heights are compared so far to both sides in u and v. Asked once.
    fn bump_step(&self) -> [f32; 2] {
        [1.0 / 1024.0; 2]
    }
    /// Names the texture in error texts. Asked once.
    fn label(&self) -> String {
        String::new()
    }
}

pub(crate) type BoxedTexture = Box<dyn HostTexture>;

/// The callback of `bdpt_host_texture_desc`.
pub(crate) unsafe extern "C" fn look_up(
    user: *mut c_void,
    count: u32,
    places: *const sys::bdpt_texture_place,
    colors: *mut [f32; 4],
) -> i32 {
    // SAFETY: `user` is that of a texture that lives.
    let texture = unsafe { host::<BoxedTexture>(user) };
    // SAFETY: arrays of `count`, which live during the call; TexturePlace is transparent. Colours come as NaN.
    let (places, colors) =
        unsafe { (slice(places.cast::<TexturePlace>(), count as usize), slice_mut(colors, count as usize)) };
    i32::from(texture.panics.catch(|| texture.value.look_up(places, colors)).is_none())
}
