// SPDX-License-Identifier: Apache-2.0
//! Texels of lightmaps in fewer bits, or as what shaders take.

use crate::count::{bytes, zeros};
use crate::error::{check, Error, Result};
use bdpt_sys as sys;
use std::os::raw::c_void;

/// Texels as they are to be stored.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Encoded<T> {
    /// The texels, in order.
    pub texels: Vec<T>,
    /// Texels with a value that was clipped.
    pub clipped: u64,
    /// Texels with a value that is not finite: encoded as 0 in all channels.
    pub not_finite: u64,
}

/// Encodes numbers as 16-bit floats, rounded to nearest and clipped to ±65504; `channels` to a texel, 1 to 4096, which
/// only the counts depend on.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let encoded = bdpt::encode_half(&[1.0, -2.0, 1e9], 3)?;
/// assert_eq!(encoded.texels, [0x3c00, 0xc000, 0x7bff]);
/// assert_eq!(encoded.clipped, 1);
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) when there are no texels, or a part of one.
pub fn encode_half(pixels: &[f32], channels: u32) -> Result<Encoded<u16>> {
    let texels = whole(pixels.len(), channels as usize)?;
    let desc =
        sys::bdpt_lightmap_encode_desc { encoding: sys::BDPT_LIGHTMAP_ENCODING_HALF, channels, ..Default::default() };
    run(desc, pixels, texels, pixels.len() as u64)
}

/// Encodes colours as R, G, B and M: range M/255 (R, G, B)/255, clipped to [0, range]. A range of 0 stands for 8.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let encoded = bdpt::encode_rgbm(&[[8.0, 4.0, 0.0]], 8.0)?;
/// assert_eq!(encoded.texels, [[255, 128, 0, 255]]);
/// # Ok(()) }
/// ```
///
/// # Errors
/// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) when there are no texels, and for the range.
pub fn encode_rgbm(colors: &[[f32; 3]], range: f32) -> Result<Encoded<[u8; 4]>> {
    encode_colors(sys::BDPT_LIGHTMAP_ENCODING_RGBM, colors, range)
}

/// Encodes colours as R, G, B and D: range/D (R, G, B)/255, clipped to [0, range]. A range of 0 stands for 255.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// let encoded = bdpt::encode_rgbd(&[[0.5, 1.0, 0.0]], 255.0)?;
/// let [r, g, b, d] = encoded.texels[0].map(f32::from);
/// assert!((255.0 / d * r / 255.0 - 0.5).abs() < 0.003 && g == 255.0 && b == 0.0);
/// # Ok(()) }
/// ```
///
/// # Errors
/// As for [`encode_rgbm`].
pub fn encode_rgbd(colors: &[[f32; 3]], range: f32) -> Result<Encoded<[u8; 4]>> {
    encode_colors(sys::BDPT_LIGHTMAP_ENCODING_RGBD, colors, range)
}

fn encode_colors(encoding: i32, colors: &[[f32; 3]], range: f32) -> Result<Encoded<[u8; 4]>> {
    let desc = sys::bdpt_lightmap_encode_desc { encoding, range, ..Default::default() };
    run(desc, crate::image::floats(colors), colors.len() as u64, colors.len() as u64)
}

/// What coefficients of spherical harmonics are.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sh {
    /// Of radiance, as [`OutputKind::RadianceSh1`](crate::OutputKind::RadianceSh1) has them.
    Radiance,
    /// Of irradiance, as [`OutputKind::IrradianceSh1`](crate::OutputKind::IrradianceSh1) has them.
    Irradiance,
}

/// Coefficients of spherical harmonics of texels, RGB each.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Coefficients, Sh};
/// // One texel whose light is even: of 4 coefficients only the first is not zero.
/// let mut texel = [[0.0; 3]; 4];
/// texel[0] = [1.0, 2.0, 3.0];
/// let encoded = Coefficients::packed(Sh::Irradiance, &texel, 4)?.encode_dominant()?;
/// let [r, g, b, x, y, z, strength] = encoded.texels[0];
/// assert!((g - 2.0 * r).abs() < 1e-6 && (b - 3.0 * r).abs() < 1e-6);
/// assert_eq!((x, y, z, strength), (0.0, 0.0, 0.0, 0.0));
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Coefficients<'a> {
    sh: Sh,
    values: &'a [[f32; 3]],
    texels: u64,
    /// Of a texel.
    count: usize,
    /// One image behind the other, each of one coefficient.
    planes: bool,
}

impl<'a> Coefficients<'a> {
    /// All coefficients of the first texel, then of the next; `count` to a texel, 4 or 9.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) when there are no texels, or a part of one.
    pub fn packed(sh: Sh, values: &'a [[f32; 3]], count: usize) -> Result<Self> {
        Ok(Self { sh, values, texels: whole(values.len(), count)?, count, planes: false })
    }
    /// The first coefficient of all texels, then the next, as films have them, plane by plane; `count` planes, 4 or 9.
    ///
    /// # Errors
    /// As for [`packed`](Self::packed).
    pub fn planes(sh: Sh, values: &'a [[f32; 3]], count: usize) -> Result<Self> {
        Ok(Self { planes: true, ..Self::packed(sh, values, count)? })
    }
    /// Of the first 4: irradiance from the dominant direction as RGB; this direction; and how much of the light comes from
    /// there, 0 to 1.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) when there are fewer coefficients than that.
    pub fn encode_dominant(&self) -> Result<Encoded<[f32; 7]>> {
        self.encode(sys::BDPT_LIGHTMAP_ENCODING_DOMINANT, 4)
    }
    /// Of the first 4: E_0 as RGB and a vector v: the irradiance of normal n is E_0 (1 + 2 v·n).
    ///
    /// # Errors
    /// As for [`encode_dominant`](Self::encode_dominant).
    pub fn encode_mono_sh(&self) -> Result<Encoded<[f32; 6]>> {
        self.encode(sys::BDPT_LIGHTMAP_ENCODING_MONO_SH, 4)
    }
    /// Of 9, in the surface's own frame: 4 RGB coefficients of the basis of Habel and Wimmer (2010).
    ///
    /// # Errors
    /// As for [`encode_dominant`](Self::encode_dominant).
    pub fn encode_h4(&self) -> Result<Encoded<[[f32; 3]; 4]>> {
        self.encode(sys::BDPT_LIGHTMAP_ENCODING_H4, 9)
    }
    /// Of 9, in the surface's own frame: 6 RGB coefficients of the basis of Habel and Wimmer (2010).
    ///
    /// # Errors
    /// As for [`encode_dominant`](Self::encode_dominant).
    pub fn encode_h6(&self) -> Result<Encoded<[[f32; 3]; 6]>> {
        self.encode(sys::BDPT_LIGHTMAP_ENCODING_H6, 9)
    }

    fn encode<T: Texel>(&self, encoding: sys::bdpt_lightmap_encoding, needed: usize) -> Result<Encoded<T>> {
        if self.count < needed {
            return Err(Error::refused(format!("{} coefficients to a texel, and {needed} are needed", self.count)));
        }
        let desc = sys::bdpt_lightmap_encode_desc {
            encoding,
            sh: match self.sh {
                Sh::Radiance => sys::BDPT_SH_RADIANCE,
                Sh::Irradiance => sys::BDPT_SH_IRRADIANCE,
            },
            texel_stride: if self.planes { 3 } else { 3 * self.count as u64 },
            plane_stride: if self.planes { 3 * self.texels } else { 3 },
            ..Default::default()
        };
        run(desc, crate::image::floats(self.values), self.texels, self.texels)
    }
}

/// How many texels `length` numbers or colours are.
fn whole(length: usize, of_a_texel: usize) -> Result<u64> {
    match (length.checked_div(of_a_texel), length.checked_rem(of_a_texel)) {
        (Some(texels), Some(0)) => Ok(texels as u64),
        _ => Err(Error::refused(format!("{length} are no whole number of texels of {of_a_texel}"))),
    }
}

/// What the library may write: numbers of any bits, without padding.
///
/// # Safety
/// Every pattern of bits is a value.
unsafe trait Texel: Copy {
    const ZERO: Self;
}
// SAFETY: integers and floats, and arrays of floats.
unsafe impl Texel for u16 {
    const ZERO: Self = 0;
}
// SAFETY: as above.
unsafe impl Texel for [u8; 4] {
    const ZERO: Self = [0; 4];
}
// SAFETY: as above.
unsafe impl<const N: usize> Texel for [f32; N] {
    const ZERO: Self = [0.0; N];
}
// SAFETY: as above.
unsafe impl<const N: usize> Texel for [[f32; 3]; N] {
    const ZERO: Self = [[0.0; 3]; N];
}

fn run<T: Texel>(desc: sys::bdpt_lightmap_encode_desc, pixels: &[f32], texels: u64, length: u64) -> Result<Encoded<T>> {
    let mut encoded = zeros(length, T::ZERO, "encoded texels")?;
    let desc = sys::bdpt_lightmap_encode_desc {
        texels,
        pixels: pixels.as_ptr(),
        pixels_capacity: bytes(pixels),
        encoded_capacity: bytes(&encoded),
        encoded: encoded.as_mut_ptr() as *mut c_void,
        ..desc
    };
    let mut report = sys::bdpt_lightmap_encode_report::default();
    // SAFETY: each capacity is that of its buffer, and the library refuses one that is too small.
    check(unsafe { sys::bdpt_lightmap_encode(&desc, &mut report) })?;
    Ok(Encoded { texels: encoded, clipped: report.clipped, not_finite: report.not_finite })
}
