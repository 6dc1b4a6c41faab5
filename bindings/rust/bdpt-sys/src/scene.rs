//! Scene building

use crate::*;
use std::os::raw::{c_char, c_void};

opaque!(bdpt_builder);

opaque!(bdpt_scene);

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_shape_id {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_texture_id {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_material_id {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_light_id {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_instance_id {
    pub id: u64,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct bdpt_medium_id {
    pub id: u64,
}

pub type bdpt_format = i32;

/// allowed only in a view whose count is 0
pub const BDPT_FORMAT_NONE: bdpt_format = 0;

/// two 32-bit floats
pub const BDPT_FORMAT_FLOAT2: bdpt_format = 1;

/// three 32-bit floats
pub const BDPT_FORMAT_FLOAT3: bdpt_format = 2;

/// a triangle's three indices
pub const BDPT_FORMAT_UINT16X3: bdpt_format = 3;
pub const BDPT_FORMAT_UINT32X3: bdpt_format = 4;

/// four 32-bit floats
pub const BDPT_FORMAT_FLOAT4: bdpt_format = 5;

/// one 32-bit float
pub const BDPT_FORMAT_FLOAT1: bdpt_format = 6;

/// one 32-bit number
pub const BDPT_FORMAT_UINT32: bdpt_format = 7;

pub type bdpt_ownership = i32;

/// the library copies during the call
pub const BDPT_OWNERSHIP_COPY: bdpt_ownership = 0;

/// the data must stay, unchanged, until release is called
pub const BDPT_OWNERSHIP_BORROW: bdpt_ownership = 1;

/// A strided array.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_data {
    pub data: *const c_void,
    pub count: u64,
    pub stride: u64,
    pub format: bdpt_format,
    pub ownership: bdpt_ownership,
    pub slack_bytes: u64,
    pub release: Option<unsafe extern "C" fn(user: *mut c_void, data: *const c_void)>,
    pub user: *mut c_void,
}
zeroed!(bdpt_data);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_mesh_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub indices: bdpt_data,
    pub normals: bdpt_data,
    pub uv: [bdpt_data; 2],
    pub colors: bdpt_data,
    pub tangents: bdpt_data,
}
sized!(bdpt_mesh_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_sphere_desc {
    pub struct_size: u32,
    pub radius: f32,
    pub label: *const c_char,
    pub center: [f32; 3],
    pub reserved: u32,
}
sized!(bdpt_sphere_desc);

pub type bdpt_curve_basis = i32;

/// cones that touch spheres round the control points. 2 points, and 1 for each further segment. Closed: a sphere at
/// either end
pub const BDPT_CURVE_LINEAR: bdpt_curve_basis = 0;

/// cubic: 4 points, and 3 for each further segment
pub const BDPT_CURVE_BEZIER: bdpt_curve_basis = 1;

/// cubic, uniform: 4 points, and 1 for each further segment
pub const BDPT_CURVE_BSPLINE: bdpt_curve_basis = 2;

/// cubic: 4 points, and 1 for each further segment; through all but a strand's ends
pub const BDPT_CURVE_CATMULL_ROM: bdpt_curve_basis = 3;

/// Round curves, such as hair: strands along which a circle is swept, whose radius varies as the axis does.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_curves_desc {
    pub struct_size: u32,
    pub basis: bdpt_curve_basis,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub radii: bdpt_data,
    pub counts: bdpt_data,
}
sized!(bdpt_curves_desc);

pub type bdpt_boundary = i32;

/// boundaries are smooth curves, round at their corners
pub const BDPT_BOUNDARY_SMOOTH: bdpt_boundary = 0;

/// smooth, but for corners of one face, which stay where they are
pub const BDPT_BOUNDARY_PIN_CORNERS: bdpt_boundary = 1;

/// all of the boundary stays where it is
pub const BDPT_BOUNDARY_PIN: bdpt_boundary = 2;

/// Displaces `count` places of a surface: packed arrays of positions, unit normals and texture coordinates come in,
/// three, three and two floats each; displaced comes as the positions, and is what they become.
pub type bdpt_displace_fn = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        count: u64,
        positions: *const f32,
        normals: *const f32,
        uv: *const f32,
        displaced: *mut f32,
    ) -> i32,
>;

/// A Catmull-Clark surface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_subdivision_desc {
    pub struct_size: u32,
    pub level: u32,
    pub label: *const c_char,
    pub positions: bdpt_data,
    pub face_counts: bdpt_data,
    pub indices: bdpt_data,
    pub uv: bdpt_data,
    pub uv_indices: bdpt_data,
    pub crease_edges: bdpt_data,
    pub crease_weights: bdpt_data,
    pub corners: bdpt_data,
    pub corner_weights: bdpt_data,
    pub boundary: bdpt_boundary,
    pub reserved: u32,
    pub displace: bdpt_displace_fn,
    pub user: *mut c_void,
}
sized!(bdpt_subdivision_desc);

pub type bdpt_texel = i32;

/// 255 is 1
pub const BDPT_TEXEL_UINT8: bdpt_texel = 0;
pub const BDPT_TEXEL_FLOAT: bdpt_texel = 1;

/// 65535 is 1
pub const BDPT_TEXEL_UINT16: bdpt_texel = 2;
pub const BDPT_TEXEL_HALF: bdpt_texel = 3;

pub type bdpt_encoding = i32;

/// texels, but for alpha, are decoded by the sRGB curve
pub const BDPT_ENCODING_SRGB: bdpt_encoding = 0;
pub const BDPT_ENCODING_LINEAR: bdpt_encoding = 1;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_texture_desc {
    pub struct_size: u32,
    pub channels: u32,
    pub label: *const c_char,
    pub pixels: *const c_void,
    pub width: u32,
    pub height: u32,
    pub row_stride: u64,
    pub texel: bdpt_texel,
    pub encoding: bdpt_encoding,
    pub mip_levels: u32,
    pub reserved: u32,
    pub color_space: *const c_char,
}
sized!(bdpt_texture_desc);

/// Where a texture of yours is looked up.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_texture_place {
    pub uv: [f32; 2],
    pub position: [f32; 3],
    pub reserved: u32,
    pub instance: bdpt_instance_id,
}

/// A texture of yours: a function that computes colours, for patterns and noise.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_host_texture_desc {
    pub struct_size: u32,
    pub maximum: f32,
    pub label: *const c_char,
    pub look_up: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            count: u32,
            places: *const bdpt_texture_place,
            colors: *mut [f32; 4],
        ) -> i32,
    >,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
    pub hash: u64,
    pub step: [f32; 2],
}
sized!(bdpt_host_texture_desc);

/// A homogeneous medium: what fills closed surfaces, or the whole scene.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_medium_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub label: *const c_char,
    pub sigma_a: [f32; 3],
    pub sigma_s: [f32; 3],
    pub g: f32,
    pub reserved2: u32,
}
sized!(bdpt_medium_desc);

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

pub type bdpt_slot = i32;

/// colour
pub const BDPT_SLOT_REFLECTANCE: bdpt_slot = 0;

/// number, along u and v
pub const BDPT_SLOT_ROUGHNESS: bdpt_slot = 1;

/// a tangent-space normal map: 2 rgb - 1, x along u, y along v; x and y times scale
pub const BDPT_SLOT_NORMAL: bdpt_slot = 2;

/// the surface seems raised along its normal by a channel times scale, in world units
pub const BDPT_SLOT_BUMP: bdpt_slot = 3;

/// number
pub const BDPT_SLOT_OPACITY: bdpt_slot = 4;

/// colour; on meshes alone. Such a light is sampled by its texels
pub const BDPT_SLOT_EMISSION: bdpt_slot = 5;
pub const BDPT_SLOT_DIFFUSE_ROUGHNESS: bdpt_slot = 6;

/// colour
pub const BDPT_SLOT_TRANSMITTANCE: bdpt_slot = 7;
pub const BDPT_SLOT_METALNESS: bdpt_slot = 8;
pub const BDPT_SLOT_SPECULAR: bdpt_slot = 9;

/// colour
pub const BDPT_SLOT_SPECULAR_COLOR: bdpt_slot = 10;
pub const BDPT_SLOT_COAT: bdpt_slot = 11;
pub const BDPT_SLOT_COAT_ROUGHNESS: bdpt_slot = 12;

/// colour
pub const BDPT_SLOT_SHEEN_COLOR: bdpt_slot = 13;
pub const BDPT_SLOT_SHEEN_ROUGHNESS: bdpt_slot = 14;
pub const BDPT_SLOT_TRANSMISSION: bdpt_slot = 15;
pub const BDPT_SLOT_DIFFUSE_TRANSMISSION: bdpt_slot = 16;

/// as in glTF: red and green the direction, 2 rg - 1, in the frame of u; blue the number
pub const BDPT_SLOT_ANISOTROPY: bdpt_slot = 17;
pub const BDPT_SLOT_MIX: bdpt_slot = 18;
pub const BDPT_SLOT_IRIDESCENCE: bdpt_slot = 19;

/// from iridescence_thickness_minimum to iridescence_thickness
pub const BDPT_SLOT_IRIDESCENCE_THICKNESS: bdpt_slot = 20;

pub type bdpt_wrap = i32;
pub const BDPT_WRAP_REPEAT: bdpt_wrap = 0;
pub const BDPT_WRAP_MIRROR: bdpt_wrap = 1;

/// beyond the edge the last texel goes on
pub const BDPT_WRAP_CLAMP: bdpt_wrap = 2;

pub type bdpt_lookup = i32;
pub const BDPT_LOOKUP_BILINEAR: bdpt_lookup = 0;
pub const BDPT_LOOKUP_NEAREST: bdpt_lookup = 1;

/// by B-splines: smooth, and never beyond the texels' range
pub const BDPT_LOOKUP_BICUBIC: bdpt_lookup = 2;

/// A texture that varies a number of a material over the surface.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_texture_use {
    pub struct_size: u32,
    pub slot: bdpt_slot,
    pub texture: bdpt_texture_id,
    pub channel: u32,
    pub uv_set: u32,
    pub transform: [f32; 6],
    pub wrap: [bdpt_wrap; 2],
    pub lookup: bdpt_lookup,
    pub level: f32,
    pub scale: f32,
    pub reserved: u32,
}
sized!(bdpt_texture_use);

pub type bdpt_opacity_mode = i32;
pub const BDPT_OPACITY_OPAQUE: bdpt_opacity_mode = 0;

/// there where opacity is at least the cutoff
pub const BDPT_OPACITY_MASK: bdpt_opacity_mode = 1;

/// there with the probability of opacity, by a hash of the ray
pub const BDPT_OPACITY_BLEND: bdpt_opacity_mode = 2;

/// Where a host's material scatters.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_scattering_place {
    pub previous: [f32; 3],
    pub reflectance: [f32; 3],
    pub roughness: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_scattering_value {
    pub f: [f32; 3],
    pub density: f32,
    pub density_reverse: f32,
}

/// A material of yours.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_host_material {
    pub struct_size: u32,
    pub transmits: u32,
    pub user: *mut c_void,
    pub evaluate: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            place: *const bdpt_scattering_place,
            next: *const f32,
            value: *mut bdpt_scattering_value,
        ) -> i32,
    >,
    pub sample: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            place: *const bdpt_scattering_place,
            u: *const f32,
            next: *mut f32,
        ) -> i32,
    >,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
    pub hash: u64,
}
sized!(bdpt_host_material);

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

pub type bdpt_light_type = i32;
pub const BDPT_LIGHT_POINT: bdpt_light_type = 0;

/// a point that shines into a cone, with a smooth edge
pub const BDPT_LIGHT_SPOT: bdpt_light_type = 1;

/// radiance from all directions: the same from each, or a picture's
pub const BDPT_LIGHT_ENVIRONMENT: bdpt_light_type = 2;

/// light from far away: from one direction, or from a disc: a sun
pub const BDPT_LIGHT_DIRECTIONAL: bdpt_light_type = 3;

/// What a luminaire sends into each direction, as measured: the table of an IES file of type C.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_photometry {
    pub struct_size: u32,
    pub vertical_count: u32,
    pub horizontal_count: u32,
    pub reserved: u32,
    pub vertical_angles: *const f32,
    pub horizontal_angles: *const f32,
    pub intensities: *const f32,
}
sized!(bdpt_photometry);

/// A rectangle through which light comes from infinitely far: a window, seen from either side.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_portal {
    pub corner: [f32; 3],
    pub edge_u: [f32; 3],
    pub edge_v: [f32; 3],
}

/// Area lights are instances whose material emits.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_light_desc {
    pub struct_size: u32,
    pub type_: bdpt_light_type,
    pub label: *const c_char,
    pub position: [f32; 3],
    pub direction: [f32; 3],
    pub intensity: [f32; 3],
    pub radiance: [f32; 3],
    pub cone_angle: f32,
    pub cone_falloff: f32,
    pub group: u32,
    pub reserved: u32,
    pub texture: bdpt_texture_id,
    pub transform: [f32; 12],
    pub irradiance: [f32; 3],
    pub angular_radius: f32,
    pub up: [f32; 3],
    pub reserved_2: u32,
    pub photometry: *const bdpt_photometry,
    pub portals: *const bdpt_portal,
    pub portal_count: u32,
    pub reserved_3: u32,
}
sized!(bdpt_light_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_sky_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub turbidity: f32,
    pub to_sun: [f32; 3],
    pub ground: [f32; 3],
}
sized!(bdpt_sky_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_instance_desc {
    pub struct_size: u32,
    pub invisible: u32,
    pub label: *const c_char,
    pub shape: bdpt_shape_id,
    pub material: bdpt_material_id,
    pub transform: [f32; 12],
    pub end_transform: [f32; 12],
}
sized!(bdpt_instance_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_build_desc {
    pub struct_size: u32,
    pub reserved: u32,
    pub cancel: *mut bdpt_cancel,
    pub progress: bdpt_progress_fn,
    pub user: *mut c_void,
    pub medium: bdpt_medium_id,
}
sized!(bdpt_build_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_scene_info {
    pub struct_size: u32,
    pub lights: u32,
    pub instances: u64,
    pub triangles: u64,
    pub spheres: u64,
    pub degenerate_triangles: u64,
    pub memory: u64,
    pub memory_embree: u64,
    pub hash: u64,
    pub bounds_min: [f32; 3],
    pub bounds_max: [f32; 3],
    pub curves: u64,
}
sized!(bdpt_scene_info);

/// One of a scene's lights: a light, or an instance of a material that emits.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_scene_light {
    pub struct_size: u32,
    pub group: u32,
    pub light: bdpt_light_id,
    pub instance: bdpt_instance_id,
    pub label: *const c_char,
}
sized!(bdpt_scene_light);

extern "C" {
    /// Creates an empty builder.
    pub fn bdpt_builder_create(
        context: *mut bdpt_context,
        builder: *mut *mut bdpt_builder,
    ) -> bdpt_result;

    /// Destroys a builder; scenes built from it live on.
    pub fn bdpt_builder_destroy(builder: *mut bdpt_builder);

    /// Adds a triangle mesh.
    pub fn bdpt_mesh_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_mesh_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;

    /// Adds an exact sphere.
    pub fn bdpt_sphere_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_sphere_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;

    /// Adds curves, as a set: one for all hair of a head is better than one for each.
    pub fn bdpt_curves_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_curves_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;

    /// Adds a subdivision surface as a mesh of points of its limit, so all that meshes can do, it can: 2 level²
    /// triangles for a face of 4 corners, n level² / 2 for one of n.
    pub fn bdpt_subdivision_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_subdivision_desc,
        shape: *mut bdpt_shape_id,
    ) -> bdpt_result;

    /// Removes a shape that no instance uses.
    pub fn bdpt_shape_remove(builder: *mut bdpt_builder, shape: bdpt_shape_id) -> bdpt_result;

    /// Adds an image texture.
    pub fn bdpt_texture_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_texture_desc,
        texture: *mut bdpt_texture_id,
    ) -> bdpt_result;

    /// Adds a texture of yours.
    pub fn bdpt_host_texture_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_host_texture_desc,
        texture: *mut bdpt_texture_id,
    ) -> bdpt_result;

    /// Removes a texture that no material or light uses.
    pub fn bdpt_texture_remove(builder: *mut bdpt_builder, texture: bdpt_texture_id)
        -> bdpt_result;

    /// Adds a medium.
    pub fn bdpt_medium_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_medium_desc,
        medium: *mut bdpt_medium_id,
    ) -> bdpt_result;

    /// Replaces a medium's description for scenes built from now on.
    pub fn bdpt_medium_update(
        builder: *mut bdpt_builder,
        medium: bdpt_medium_id,
        desc: *const bdpt_medium_desc,
    ) -> bdpt_result;

    /// Removes a medium that no material uses.
    pub fn bdpt_medium_remove(builder: *mut bdpt_builder, medium: bdpt_medium_id) -> bdpt_result;

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
    pub fn bdpt_material_remove(
        builder: *mut bdpt_builder,
        material: bdpt_material_id,
    ) -> bdpt_result;

    /// Adds a light.
    pub fn bdpt_light_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_light_desc,
        light: *mut bdpt_light_id,
    ) -> bdpt_result;

    /// Replaces a light's description for scenes built from now on.
    pub fn bdpt_light_update(
        builder: *mut bdpt_builder,
        light: bdpt_light_id,
        desc: *const bdpt_light_desc,
    ) -> bdpt_result;

    /// Removes a light.
    pub fn bdpt_light_remove(builder: *mut bdpt_builder, light: bdpt_light_id) -> bdpt_result;

    /// Fills a picture for the texture of an environment with a clear sky, without its sun, +y up: 3 floats a pixel,
    /// linear Rec.
    pub fn bdpt_sky_fill(
        desc: *const bdpt_sky_desc,
        pixels: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Places a shape, with a material, in the world.
    pub fn bdpt_instance_add(
        builder: *mut bdpt_builder,
        desc: *const bdpt_instance_desc,
        instance: *mut bdpt_instance_id,
    ) -> bdpt_result;

    /// Replaces an instance's description for scenes built from now on.
    pub fn bdpt_instance_update(
        builder: *mut bdpt_builder,
        instance: bdpt_instance_id,
        desc: *const bdpt_instance_desc,
    ) -> bdpt_result;

    /// Removes an instance.
    pub fn bdpt_instance_remove(
        builder: *mut bdpt_builder,
        instance: bdpt_instance_id,
    ) -> bdpt_result;

    /// Builds an immutable scene from what the builder holds.
    pub fn bdpt_scene_build(
        builder: *mut bdpt_builder,
        desc: *const bdpt_build_desc,
        scene: *mut *mut bdpt_scene,
    ) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_scene_retain(scene: *mut bdpt_scene);

    /// Takes a reference.
    pub fn bdpt_scene_release(scene: *mut bdpt_scene);

    /// Tells what a scene holds.
    pub fn bdpt_scene_get_info(scene: *const bdpt_scene, info: *mut bdpt_scene_info)
        -> bdpt_result;

    /// Tells what light `index` is, below bdpt_scene_info.lights: lights first, then instances, each in the order of
    /// adding.
    pub fn bdpt_scene_get_light(
        scene: *const bdpt_scene,
        index: u32,
        light: *mut bdpt_scene_light,
    ) -> bdpt_result;
}
