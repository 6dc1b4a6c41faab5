// SPDX-License-Identifier: Apache-2.0
//! How surfaces scatter and emit light.

use crate::error::{check, Result, Text};
use crate::host_material::{BoxedMaterial, HostMaterial};
use crate::id::{MaterialId, MediumId, TextureId};
use crate::plain::Plain;
use crate::texture_use::TextureUse;
use bdpt_sys as sys;
use std::fmt;

/// A measured metal.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metal {
    /// Ag.
    Silver,
    /// Al.
    Aluminium,
    /// Au.
    Gold,
    /// Cu.
    Copper,
}

impl Metal {
    /// The complex index, real part and imaginary part, in linear Rec. 709. Source: refractiveindex.info.
    pub fn index(self) -> Result<([f32; 3], [f32; 3])> {
        let name: &[u8; 3] = match self {
            Self::Silver => b"Ag\0",
            Self::Aluminium => b"Al\0",
            Self::Gold => b"Au\0",
            Self::Copper => b"Cu\0",
        };
        let (mut eta, mut k) = ([0.0; 3], [0.0; 3]);
        // SAFETY: a text that ends with zero, and room for three floats each.
        check(unsafe { sys::bdpt_metal_find(name.as_ptr().cast(), eta.as_mut_ptr(), k.as_mut_ptr()) })?;
        Ok((eta, k))
    }
}

/// How a surface scatters and emits light. `bdpt.h` defines each number and its range.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Material, Metal};
/// let mut builder = Builder::new(&Context::new()?)?;
/// builder.add_material(Material::diffuse([0.8; 3]).one_sided(true).label("wall"))?;
/// builder.add_material(Material::metal(Metal::Gold)?.roughness([0.1, 0.1]))?;
/// let lamp = builder.add_material(Material::diffuse([0.0; 3]).emission([17.0, 12.0, 4.0]))?;
/// builder.update_material(lamp, Material::diffuse([0.0; 3]).emission([1.0; 3]))?;
/// # Ok(()) }
/// ```
pub struct Material {
    pub(crate) label: Option<String>,
    pub(crate) textures: Vec<TextureUse>,
    pub(crate) host: Option<BoxedMaterial>,
    pub(crate) raw: Plain<sys::bdpt_material_desc>,
}

impl Material {
    fn new(kind: sys::bdpt_material_type) -> Self {
        let raw = sys::bdpt_material_desc { type_: kind, ..Default::default() };
        Self { label: None, textures: Vec::new(), host: None, raw: raw.into() }
    }
    /// f = reflectance / pi; Oren-Nayar with a [`diffuse_roughness`](Self::diffuse_roughness).
    pub fn diffuse(reflectance: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_DIFFUSE).reflectance(reflectance)
    }
    /// Perfect reflection, times reflectance.
    pub fn mirror(reflectance: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_MIRROR).reflectance(reflectance)
    }
    /// Fresnel reflection by a complex index; smooth, or GGX with a [`roughness`](Self::roughness).
    pub fn conductor(eta: [f32; 3], k: [f32; 3]) -> Self {
        let mut material = Self::new(sys::BDPT_MATERIAL_CONDUCTOR);
        (material.raw.eta, material.raw.k) = (eta, k);
        material
    }
    /// A conductor of a measured metal.
    pub fn metal(metal: Metal) -> Result<Self> {
        metal.index().map(|(eta, k)| Self::conductor(eta, k))
    }
    /// Fresnel reflection and refraction; smooth, or GGX with a [`roughness`](Self::roughness). The index is that
    /// inside over that outside.
    pub fn dielectric(ior: f32) -> Self {
        Self::new(sys::BDPT_MATERIAL_DIELECTRIC).ior(ior)
    }
    /// The boundary of a medium, which nothing else shows.
    pub fn interface(interior: MediumId) -> Self {
        Self::new(sys::BDPT_MATERIAL_INTERFACE).interior(interior)
    }
    /// reflectance / pi, and transmittance / pi through to the other side.
    pub fn diffuse_transmission(reflectance: [f32; 3], transmittance: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_DIFFUSE_TRANSMISSION).reflectance(reflectance).transmittance(transmittance)
    }
    /// Plastic: a dielectric coat with [`ior`](Self::ior) and [`roughness`](Self::roughness) over diffuse.
    pub fn coated_diffuse(reflectance: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_COATED_DIFFUSE).reflectance(reflectance)
    }
    /// A conductor below a dielectric coat with [`coat_ior`](Self::coat_ior) and
    /// [`coat_roughness`](Self::coat_roughness).
    pub fn coated_conductor(eta: [f32; 3], k: [f32; 3]) -> Self {
        let mut material = Self::conductor(eta, k);
        material.raw.type_ = sys::BDPT_MATERIAL_COATED_CONDUCTOR;
        material
    }
    /// That of glTF 2.0 with its extensions.
    pub fn principled(base_color: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_PRINCIPLED).reflectance(base_color)
    }
    /// Two others: `second` with the weight, `first` with the rest.
    pub fn mix(first: MaterialId, second: MaterialId, weight: f32) -> Self {
        let mut material = Self::new(sys::BDPT_MATERIAL_MIX);
        material.raw.parts = [first.0, second.0];
        material.raw.mix = weight;
        material
    }
    /// Functions of yours.
    pub fn host(host: impl HostMaterial + 'static, reflectance: [f32; 3]) -> Self {
        Self { host: Some(Box::new(host)), ..Self::new(sys::BDPT_MATERIAL_HOST).reflectance(reflectance) }
    }
    /// Perfectly anisotropic reflection by grooves along u, times reflectance.
    pub fn brushed(reflectance: [f32; 3]) -> Self {
        Self::new(sys::BDPT_MATERIAL_BRUSHED).reflectance(reflectance)
    }
    labelled!();

    /// Varies a number over the surface; each slot once.
    pub fn texture(mut self, texture: TextureUse) -> Self {
        self.textures.push(texture);
        self
    }
    /// An image in place of the reflectance, over uv set 0.
    pub fn reflectance_texture(mut self, texture: TextureId) -> Self {
        self.raw.reflectance_texture = texture.0;
        self
    }
    /// What fills the closed surface. Of dielectrics, interfaces, and principled that refracts.
    pub fn interior(mut self, medium: MediumId) -> Self {
        self.raw.interior = medium.0;
        self
    }
    /// There where the opacity is at least the cutoff; a cutoff of 0 is 0.5.
    pub fn opacity_mask(mut self, opacity: f32, cutoff: f32) -> Self {
        self.raw.opacity_mode = sys::BDPT_OPACITY_MASK;
        (self.raw.opacity, self.raw.opacity_cutoff) = (opacity, cutoff);
        self
    }
    /// There with the probability of the opacity.
    pub fn opacity_blend(mut self, opacity: f32) -> Self {
        self.raw.opacity_mode = sys::BDPT_OPACITY_BLEND;
        self.raw.opacity = opacity;
        self
    }
    /// Principled: weight of the dielectric's gloss, in \[0,1\]; 1 by default.
    pub fn specular(mut self, weight: f32) -> Self {
        self.raw.specular = if weight == 0.0 { -1.0 } else { weight };
        self
    }
    /// A thin film on the principled base: its weight, its index (0 = 1.3), its thickness in nanometres (0 = 400), and
    /// that where its texture is 0.
    pub fn iridescence(mut self, weight: f32, ior: f32, thickness: f32, thickness_minimum: f32) -> Self {
        self.raw.iridescence = weight;
        self.raw.iridescence_ior = ior;
        self.raw.iridescence_thickness = thickness;
        self.raw.iridescence_thickness_minimum = thickness_minimum;
        self
    }
    setters! {
        /// In \[0,1\] per channel. Of all but conductors, dielectrics and mixes.
        reflectance: [f32; 3] => reflectance;
        /// What meets the back is absorbed.
        one_sided: bool => one_sided;
        /// Index inside over index outside; 0 = 1.5.
        ior: f32 => ior;
        /// GGX alpha along u and v, in \[0,1\]; both 0 = smooth.
        roughness: [f32; 2] => roughness;
        /// Alpha is the square of roughness, and of its texture, as in glTF and OpenPBR.
        perceptual_roughness: bool => perceptual_roughness;
        /// Radiance emitted by the front, W/(m² sr): an instance is a light.
        emission: [f32; 3] => emission;
        /// The back emits too.
        emission_two_sided: bool => emission_two_sided;
        /// The light's group, in \[0,63\].
        emission_group: u32 => emission_group;
        /// What is emitted goes by this power of the cosine to the normal, in \[-1,10000\]; 0 = Lambertian.
        emission_exponent: f32 => emission_exponent;
        /// Where several closed surfaces overlap, that of highest priority is what is there.
        priority: u32 => priority;
        /// Oren-Nayar's, in \[0,1\].
        diffuse_roughness: f32 => diffuse_roughness;
        /// The colour of what goes through, in \[0,1\].
        transmittance: [f32; 3] => transmittance;
        /// Principled: weight of a clear coat.
        coat: f32 => coat;
        /// Index of the coat; 0 = 1.5.
        coat_ior: f32 => coat_ior;
        /// Alpha of the coat.
        coat_roughness: f32 => coat_roughness;
        /// Principled: how much is metal.
        metalness: f32 => metalness;
        /// Principled: of the gloss at normal incidence; zeros = (1,1,1).
        specular_color: [f32; 3] => specular_color;
        /// Principled: of the sheen.
        sheen_color: [f32; 3] => sheen_color;
        /// Principled: alpha of the sheen; below 0.1 it is as 0.1.
        sheen_roughness: f32 => sheen_roughness;
        /// Principled: how much of what is no metal is clear.
        transmission: f32 => transmission;
        /// Principled: how much of what is diffuse goes through.
        diffuse_transmission_weight: f32 => diffuse_transmission;
        /// Principled: alpha along u goes to 1 with its square.
        anisotropy: f32 => anisotropy;
        /// Of u about the normal, counter-clockwise in degrees.
        anisotropy_rotation: f32 => anisotropy_rotation;
        /// What is clear does not refract: window panes, bubbles.
        thin_walled: bool => thin_walled;
        /// Rough conductors and dielectrics lose what meets their microfacets more than once.
        single_scattering: bool => single_scattering;
    }

    pub(crate) fn label_text(&self) -> Result<Text> {
        Text::new(&self.label)
    }
}

impl fmt::Debug for Material {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Material").field("label", &self.label).field("type", &self.raw.type_).finish_non_exhaustive()
    }
}
