// SPDX-License-Identifier: Apache-2.0
//! Lights that are no surfaces.

use crate::error::{Error, Result, Text};
use crate::host::pointer;
use crate::id::TextureId;
use crate::plain::Plain;
use crate::transform::Transform;
use bdpt_sys as sys;
use std::ptr::null;

/// What a luminaire sends into each direction, as measured: the table of an IES file of type C. Linear between angles.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Light, Photometry};
/// let downlight = Photometry::new(vec![0.0, 30.0, 60.0], vec![0.0], vec![1.0, 0.8, 0.0])?;
/// let mut builder = Builder::new(&Context::new()?)?;
/// builder.add_light(&Light::point([0.0, 2.0, 0.0], [100.0; 3]).photometry(downlight).direction([0.0, -1.0, 0.0]))?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Photometry {
    vertical_angles: Vec<f32>,
    horizontal_angles: Vec<f32>,
    intensities: Vec<f32>,
}

impl Photometry {
    /// Vertical angles are from the light's direction, ascending, in \[0,180\] degrees. Horizontal angles go round it,
    /// ascending: 0 alone, or from 0 to 90, 180 or 360 degrees. Intensities: all vertical angles of the first
    /// horizontal one, then of the next.
    ///
    /// # Errors
    /// When there is not an intensity for each pair of angles.
    pub fn new(vertical_angles: Vec<f32>, horizontal_angles: Vec<f32>, intensities: Vec<f32>) -> Result<Self> {
        let (vertical, horizontal) = (vertical_angles.len(), horizontal_angles.len());
        if vertical.checked_mul(horizontal) != Some(intensities.len()) {
            return Err(Error::refused(format!(
                "photometry of {vertical} vertical and {horizontal} horizontal angles has {} intensities",
                intensities.len()
            )));
        }
        Ok(Self { vertical_angles, horizontal_angles, intensities })
    }
    fn look(&self) -> sys::bdpt_photometry {
        sys::bdpt_photometry {
            vertical_count: count(self.vertical_angles.len()),
            horizontal_count: count(self.horizontal_angles.len()),
            vertical_angles: pointer(&self.vertical_angles),
            horizontal_angles: pointer(&self.horizontal_angles),
            intensities: pointer(&self.intensities),
            ..Default::default()
        }
    }
}

/// More than the library takes where there are more than it can count.
pub(crate) fn count(len: usize) -> u32 {
    u32::try_from(len).unwrap_or(u32::MAX)
}

/// A rectangle through which light comes from infinitely far: a window, seen from either side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Portal {
    /// One of its corners.
    pub corner: [f32; 3],
    /// From the corner, of any length but zero.
    pub edge_u: [f32; 3],
    /// From the corner, at right angles to `edge_u`.
    pub edge_v: [f32; 3],
}

/// A light that is no surface. Area lights are instances whose material emits.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Light};
/// let mut builder = Builder::new(&Context::new()?)?;
/// builder.add_light(&Light::spot([0.0, 3.0, 0.0], [0.0, -1.0, 0.0], [50.0; 3], 30.0).cone_falloff(5.0).group(2))?;
/// let sun = builder.add_light(&Light::directional([1.0, -2.0, 0.5], [900.0; 3]).angular_radius(0.2665))?;
/// builder.remove_light(sun)?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Light {
    label: Option<String>,
    photometry: Option<Photometry>,
    portals: Vec<sys::bdpt_portal>,
    raw: Plain<sys::bdpt_light_desc>,
}

impl Light {
    fn new(kind: sys::bdpt_light_type) -> Self {
        let raw = sys::bdpt_light_desc { type_: kind, ..Default::default() };
        Self { label: None, photometry: None, portals: Vec::new(), raw: raw.into() }
    }
    /// A point; intensity in W/sr.
    pub fn point(position: [f32; 3], intensity: [f32; 3]) -> Self {
        let mut light = Self::new(sys::BDPT_LIGHT_POINT);
        (light.raw.position, light.raw.intensity) = (position, intensity);
        light
    }
    /// A point that shines into a cone; intensity on the axis in W/sr; `cone_angle` from axis to the dark, in degrees.
    pub fn spot(position: [f32; 3], direction: [f32; 3], intensity: [f32; 3], cone_angle: f32) -> Self {
        let mut light = Self::new(sys::BDPT_LIGHT_SPOT).direction(direction);
        (light.raw.position, light.raw.intensity, light.raw.cone_angle) = (position, intensity, cone_angle);
        light
    }
    /// Radiance from all directions, W/(m² sr), times the [`texture`](Self::texture) if there is one.
    pub fn environment(radiance: [f32; 3]) -> Self {
        let mut light = Self::new(sys::BDPT_LIGHT_ENVIRONMENT);
        light.raw.radiance = radiance;
        light
    }
    /// Light from far away, which goes along `direction`; irradiance of a surface that faces it, in W/m².
    pub fn directional(direction: [f32; 3], irradiance: [f32; 3]) -> Self {
        let mut light = Self::new(sys::BDPT_LIGHT_DIRECTIONAL).direction(direction);
        light.raw.irradiance = irradiance;
        light
    }
    labelled!();
    /// Environment: its picture, by longitude and latitude. Spot: its picture, thrown onto the square round the cone.
    pub fn texture(mut self, texture: TextureId) -> Self {
        self.raw.texture = texture.0;
        self
    }
    /// Point: multiplies the intensity.
    pub fn photometry(mut self, photometry: Photometry) -> Self {
        self.photometry = Some(photometry);
        self
    }
    /// Environment, directional: where light finds a way in, at most 64. Hints: one too many, too few or out of place
    /// costs time, and never changes what the picture converges to.
    pub fn portals(mut self, portals: &[Portal]) -> Self {
        let raw = |p: &Portal| sys::bdpt_portal { corner: p.corner, edge_u: p.edge_u, edge_v: p.edge_v };
        self.portals = portals.iter().map(raw).collect();
        self
    }
    setters! {
        /// Spot, photometry: the axis.
        direction: [f32; 3] => direction;
        /// Spot: width of the edge inside the cone, in degrees.
        cone_falloff: f32 => cone_falloff;
        /// A number of your own, in \[0,63\]: outputs of sensors may ask for some groups' light alone.
        group: u32 => group;
        /// Environment: turns the picture.
        transform: Transform => transform;
        /// Directional: of the disc, in \[0,80\] degrees; the sun's is 0.2665.
        angular_radius: f32 => angular_radius;
        /// Spot with a texture: where the picture's top is. Photometry: where horizontal angles begin.
        up: [f32; 3] => up;
    }

    pub(crate) fn with_desc<R>(&self, call: impl FnOnce(&sys::bdpt_light_desc) -> Result<R>) -> Result<R> {
        let label = Text::new(&self.label)?;
        let photometry = self.photometry.as_ref().map(Photometry::look);
        call(&sys::bdpt_light_desc {
            label: label.as_ptr(),
            photometry: photometry.as_ref().map_or(null(), |photometry| photometry),
            portals: pointer(&self.portals),
            portal_count: count(self.portals.len()),
            ..*self.raw
        })
    }
}
