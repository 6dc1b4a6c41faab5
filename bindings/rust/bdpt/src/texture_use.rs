// SPDX-License-Identifier: Apache-2.0
//! What a texture varies, and how it is looked up.

use crate::id::TextureId;
use bdpt_sys as sys;

enumeration!(
    /// What of a [`Material`](crate::Material) a texture varies. Colours are multiplied by the texture's, numbers by
    /// one of its channels; what is 0 is refused.
    Slot: bdpt_slot {
        /// Colour.
        Reflectance = BDPT_SLOT_REFLECTANCE,
        /// Number, along u and v.
        Roughness = BDPT_SLOT_ROUGHNESS,
        /// A tangent-space normal map: 2 rgb - 1, x along u, y along v; x and y times scale.
        Normal = BDPT_SLOT_NORMAL,
        /// The surface seems raised along its normal by a channel times scale, in world units.
        Bump = BDPT_SLOT_BUMP,
        /// Number.
        Opacity = BDPT_SLOT_OPACITY,
        /// Colour; on meshes alone. Such a light is sampled by its texels.
        Emission = BDPT_SLOT_EMISSION,
        /// Number.
        DiffuseRoughness = BDPT_SLOT_DIFFUSE_ROUGHNESS,
        /// Colour.
        Transmittance = BDPT_SLOT_TRANSMITTANCE,
        /// Number.
        Metalness = BDPT_SLOT_METALNESS,
        /// Number.
        Specular = BDPT_SLOT_SPECULAR,
        /// Colour.
        SpecularColor = BDPT_SLOT_SPECULAR_COLOR,
        /// Number.
        Coat = BDPT_SLOT_COAT,
        /// Number.
        CoatRoughness = BDPT_SLOT_COAT_ROUGHNESS,
        /// Colour.
        SheenColor = BDPT_SLOT_SHEEN_COLOR,
        /// Number.
        SheenRoughness = BDPT_SLOT_SHEEN_ROUGHNESS,
        /// Number.
        Transmission = BDPT_SLOT_TRANSMISSION,
        /// Number.
        DiffuseTransmission = BDPT_SLOT_DIFFUSE_TRANSMISSION,
        /// As in glTF: red and green the direction, 2 rg - 1, in the frame of u; blue the number.
        Anisotropy = BDPT_SLOT_ANISOTROPY,
        /// Number.
        Mix = BDPT_SLOT_MIX,
        /// Number.
        Iridescence = BDPT_SLOT_IRIDESCENCE,
        /// From the minimum of the thickness to the thickness.
        IridescenceThickness = BDPT_SLOT_IRIDESCENCE_THICKNESS,
    }
);

enumeration!(
    /// What is beyond the edges of a texture.
    Wrap: bdpt_wrap {
        /// The texture again.
        Repeat = BDPT_WRAP_REPEAT,
        /// The texture mirrored.
        Mirror = BDPT_WRAP_MIRROR,
        /// The last texel goes on.
        Clamp = BDPT_WRAP_CLAMP,
    }
);

enumeration!(
    /// How a texture is interpolated between texels.
    Lookup: bdpt_lookup {
        /// Linear along both axes.
        Bilinear = BDPT_LOOKUP_BILINEAR,
        /// Not at all.
        Nearest = BDPT_LOOKUP_NEAREST,
        /// By B-splines: smooth, and never beyond the texels' range.
        Bicubic = BDPT_LOOKUP_BICUBIC,
    }
);

/// A texture that varies a number of a [`Material`](crate::Material) over the surface.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Material, Slot, Texture, TextureUse, Wrap};
/// let mut builder = Builder::new(&Context::new()?)?;
/// let scratches = builder.add_texture(Texture::linear(2, 1, 1, &[0.5_f32, 1.0]))?;
/// let varied = TextureUse::new(Slot::Roughness, scratches).wrap([Wrap::Mirror, Wrap::Clamp]);
/// builder.add_material(Material::dielectric(1.5).roughness([0.3, 0.3]).texture(varied))?;
/// # Ok(()) }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TextureUse {
    pub(crate) raw: sys::bdpt_texture_use,
}

impl TextureUse {
    /// The texture over uv set 0, bilinear, repeated.
    pub fn new(slot: Slot, texture: TextureId) -> Self {
        Self { raw: sys::bdpt_texture_use { slot: slot.raw(), texture: texture.0, ..Default::default() } }
    }
    setters! {
        /// Of numbers: 0 to 3 for red, green, blue, alpha.
        channel: u32 => channel;
        /// 0 or 1. A mesh without set 0 has (0,0), (1,0), (1,1) at each triangle's corners; spheres have u the angle
        /// round z, v from -z to z.
        uv_set: u32 => uv_set;
        /// Two rows of a matrix: u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5.
        transform: [f32; 6] => transform;
        /// How it is interpolated.
        lookup: Lookup => lookup;
        /// Mip level, in \[0,16\]; between two levels both are mixed.
        level: f32 => level;
        /// Of normal and bump maps; 0 = 1.
        scale: f32 => scale;
    }
    /// Beyond the edges, along u and v.
    pub fn wrap(mut self, wrap: [Wrap; 2]) -> Self {
        self.raw.wrap = wrap.map(Wrap::raw);
        self
    }
}
