// SPDX-License-Identifier: Apache-2.0

//! Materials

use crate::*;
use std::os::raw::c_char;

pub type bdpt_material_type = i32;

/// f = reflectance / pi; Oren-Nayar where diffuse_roughness > 0
pub const BDPT_MATERIAL_DIFFUSE: bdpt_material_type = 0;

/// perfect reflection, times reflectance
pub const BDPT_MATERIAL_MIRROR: bdpt_material_type = 1;

/// Fresnel reflection by a complex index; smooth, or GGX where roughness > 0
pub const BDPT_MATERIAL_CONDUCTOR: bdpt_material_type = 2;

/// Fresnel reflection and refraction; smooth, or GGX where roughness > 0
pub const BDPT_MATERIAL_DIELECTRIC: bdpt_material_type = 3;

/// the boundary of a medium, which nothing else shows: rays pass it, shadow rays too
pub const BDPT_MATERIAL_INTERFACE: bdpt_material_type = 4;

/// reflectance / pi, and transmittance / pi through to the other side
pub const BDPT_MATERIAL_DIFFUSE_TRANSMISSION: bdpt_material_type = 5;

/// plastic: a dielectric coat with ior and roughness over diffuse
pub const BDPT_MATERIAL_COATED_DIFFUSE: bdpt_material_type = 6;

/// a conductor below a dielectric coat with coat_ior and coat_roughness
pub const BDPT_MATERIAL_COATED_CONDUCTOR: bdpt_material_type = 7;

/// glTF 2.0's with its extensions: base colour in reflectance, and all below
pub const BDPT_MATERIAL_PRINCIPLED: bdpt_material_type = 8;

/// two others, the second with the weight mix
pub const BDPT_MATERIAL_MIX: bdpt_material_type = 9;

/// functions of yours: bdpt_host_material
pub const BDPT_MATERIAL_HOST: bdpt_material_type = 10;

/// perfectly anisotropic reflection by grooves along u, times reflectance: all that a mirror could send to the cone
/// round u goes evenly to all of it
pub const BDPT_MATERIAL_BRUSHED: bdpt_material_type = 11;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_material_desc {
    pub struct_size: u32,
    pub type_: bdpt_material_type,
    pub label: *const c_char,
    pub reflectance: [f32; 3],
    pub one_sided: u32,
    pub reflectance_texture: bdpt_texture_id,
    pub eta: [f32; 3],
    pub k: [f32; 3],
    pub ior: f32,
    pub roughness: [f32; 2],
    pub emission: [f32; 3],
    pub emission_two_sided: u32,
    pub emission_group: u32,
    pub textures: *const bdpt_texture_use,
    pub texture_count: u32,
    pub texture_stride: u32,
    pub perceptual_roughness: u32,
    pub opacity_mode: bdpt_opacity_mode,
    pub opacity: f32,
    pub opacity_cutoff: f32,
    pub interior: bdpt_medium_id,
    pub priority: u32,
    pub emission_exponent: f32,
    pub diffuse_roughness: f32,
    pub transmittance: [f32; 3],
    pub coat: f32,
    pub coat_ior: f32,
    pub coat_roughness: f32,
    pub metalness: f32,
    pub specular: f32,
    pub specular_color: [f32; 3],
    pub sheen_color: [f32; 3],
    pub sheen_roughness: f32,
    pub transmission: f32,
    pub diffuse_transmission: f32,
    pub anisotropy: f32,
    pub anisotropy_rotation: f32,
    pub thin_walled: u32,
    pub single_scattering: u32,
    pub mix: f32,
    pub reserved_2: u32,
    pub parts: [bdpt_material_id; 2],
    pub host: *const bdpt_host_material,
    pub iridescence: f32,
    pub iridescence_ior: f32,
    pub iridescence_thickness: f32,
    pub iridescence_thickness_minimum: f32,
}
sized!(bdpt_material_desc);

extern "C" {
    /// Adds a material.
    pub fn bdpt_material_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_material_desc,
        material: *mut bdpt_material_id,
    ) -> bdpt_result;

    /// Replaces a material's description for scenes built from now on.
    pub fn bdpt_material_update(
        builder: *mut bdpt_builder,
        material: bdpt_material_id,
        desc: *const bdpt_material_desc,
    ) -> bdpt_result;

    /// The complex index of a measured metal, in linear Rec.709: Ag, Al, Au or Cu.
    pub fn bdpt_metal_find(name: *const c_char, eta: *mut f32, k: *mut f32) -> bdpt_result;

    /// Removes a material that no instance and no mix uses.
    pub fn bdpt_material_remove(builder: *mut bdpt_builder, material: bdpt_material_id) -> bdpt_result;
}
