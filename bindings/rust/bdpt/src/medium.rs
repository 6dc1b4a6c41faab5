// SPDX-License-Identifier: Apache-2.0
//! What fills space: fog, milk, coloured glass.

use crate::plain::Plain;
use bdpt_sys as sys;

/// A homogeneous medium: what fills closed surfaces ([`Material::interior`](crate::Material::interior)), or the whole
/// scene ([`BuildOptions::medium`](crate::BuildOptions::medium)).
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Material, Medium};
/// let mut builder = Builder::new(&Context::new()?)?;
/// let green = builder.add_medium(&Medium::new([0.9, 0.1, 0.9], [0.0; 3]))?;
/// builder.add_material(Material::dielectric(1.5).interior(green))?;
/// builder.update_medium(green, &Medium::new([0.5, 0.1, 0.5], [0.1; 3]).mean_cosine(0.7))?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Medium {
    pub(crate) label: Option<String>,
    pub(crate) raw: Plain<sys::bdpt_medium_desc>,
}

impl Medium {
    /// Coefficients of absorption and of scattering, in \[0,1e9\], by 1 / world unit: light falls by exp(-sigma_a d).
    pub fn new(sigma_a: [f32; 3], sigma_s: [f32; 3]) -> Self {
        Self { label: None, raw: sys::bdpt_medium_desc { sigma_a, sigma_s, ..Default::default() }.into() }
    }
    labelled!();
    setters! {
        /// Of the angle by which light is turned, in \[-0.9999,0.9999\], as Henyey and Greenstein (1941) have it.
        mean_cosine: f32 => g;
    }
}
