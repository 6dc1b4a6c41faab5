//! Sensors

use crate::*;
use std::os::raw::c_void;

opaque!(bdpt_sensor);

/// Cameras look along their own -z, with x to the right and y up.
pub type bdpt_camera_type = i32;

/// straight lines stay straight; a pinhole, or a thin lens
pub const BDPT_CAMERA_PERSPECTIVE: bdpt_camera_type = 0;

/// parallel rays, from the plane through the camera, at right angles to it
pub const BDPT_CAMERA_ORTHOGRAPHIC: bdpt_camera_type = 1;

/// fisheye in a circle that touches the image's top and bottom, black around it: the angle with the axis grows as the
/// distance from the centre. Crop the circle for one that fills its frame
pub const BDPT_CAMERA_EQUIDISTANT: bdpt_camera_type = 2;

/// the same; each pixel of the circle sees the same solid angle
pub const BDPT_CAMERA_EQUISOLID: bdpt_camera_type = 3;

/// all directions: longitude to the right, latitude upward, -z in the middle
pub const BDPT_CAMERA_EQUIRECTANGULAR: bdpt_camera_type = 4;

/// all directions, on the faces +x -x +y -y +z -z of a cube map of OpenGL, Vulkan or Direct3D: sampled by a direction
/// in the camera's frame it tells what is seen there. Square faces in a row (width = 6 height) or a column (height = 6
/// width). For BDPT_FILTER_BOX of one pixel alone: wider ones would mix the faces
pub const BDPT_CAMERA_CUBE: bdpt_camera_type = 5;

/// a lens by its surfaces, traced; the first lies at the camera, on its axis. Light is neither reflected nor absorbed
/// in it, for lenses are coated
pub const BDPT_CAMERA_LENS: bdpt_camera_type = 6;

/// A surface of a lens, as tables of patents have it, in the lens' unit.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_lens_surface {
    pub radius: f32,
    pub thickness: f32,
    pub ior: f32,
    pub aperture: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_camera_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub crop: [u32; 4],
    pub transform: [f32; 12],
    pub field_of_view: f32,
    pub lens_radius: f32,
    pub focus_distance: f32,
    pub aperture_blades: u32,
    pub aperture_rotation: f32,
    pub shift: [f32; 2],
    pub type_: bdpt_camera_type,
    pub field_height: f32,
    pub focus_tilt: [f32; 2],
    pub film_height: f32,
    pub lens_unit: f32,
    pub lens_surface_count: u32,
    pub lens_surface_stride: u32,
    pub lens_surfaces: *const bdpt_lens_surface,
    pub end_transform: [f32; 12],
    pub output_count: u32,
    pub output_stride: u32,
    pub outputs: *const bdpt_output_desc,
}
sized!(bdpt_camera_desc);

/// A measurement is a texel or a point; it has one or more outputs, all sampled at once; an output is one or more
/// planes of the film, of three colours each.
pub type bdpt_output_kind = i32;

/// 1 plane: E = INT L max(0, w·n) dw \[W/m²\]
pub const BDPT_OUTPUT_IRRADIANCE: bdpt_output_kind = 0;

/// 1 plane: E / pi, what a diffuse surface of albedo 1 would emit
pub const BDPT_OUTPUT_IRRADIANCE_OVER_PI: bdpt_output_kind = 1;

/// 4 planes: c_lm = INT L Y_lm(w) dw for l \<= 1, over the hemisphere of n (all directions, for points without normal)
pub const BDPT_OUTPUT_RADIANCE_SH1: bdpt_output_kind = 2;

/// 9 planes: l \<= 2
pub const BDPT_OUTPUT_RADIANCE_SH2: bdpt_output_kind = 3;

/// 4 planes: c_lm times pi, 2 pi / 3 for l = 0, 1: the irradiance of a surface with normal m is about SUM of these
/// times Y_lm(m)
pub const BDPT_OUTPUT_IRRADIANCE_SH1: bdpt_output_kind = 4;

/// 9 planes: and times pi / 4 for l = 2
pub const BDPT_OUTPUT_IRRADIANCE_SH2: bdpt_output_kind = 5;

/// 1 plane: INT L dw \[W/m²\]
pub const BDPT_OUTPUT_FLUENCE: bdpt_output_kind = 6;

/// 1 plane: 1 / pi INT V max(0, w·n) dw, in \[0,1\]: ambient occlusion is one less this
pub const BDPT_OUTPUT_OPENNESS: bdpt_output_kind = 7;

/// 1 plane: INT V w max(0, w·n) dw, x, y and z in place of colours; of any length
pub const BDPT_OUTPUT_BENT_NORMAL: bdpt_output_kind = 8;

/// 4 planes: INT V Y_lm(w) dw
pub const BDPT_OUTPUT_OPENNESS_SH1: bdpt_output_kind = 9;

/// 9 planes
pub const BDPT_OUTPUT_OPENNESS_SH2: bdpt_output_kind = 10;

/// 1 plane: the part of all rays that do not meet the back of a one-sided surface: near 0 inside of closed meshes
pub const BDPT_OUTPUT_FRONTS: bdpt_output_kind = 11;

/// size² planes: the mean of L over the texel's directions
pub const BDPT_OUTPUT_RADIANCE_OCTAHEDRAL: bdpt_output_kind = 12;

/// size² planes: INT L max(0, w·m) dw, m the direction of the middle
pub const BDPT_OUTPUT_IRRADIANCE_OCTAHEDRAL: bdpt_output_kind = 13;

/// size² planes; in place of colours the means of d, d² and 1 - V, d the distance of what is seen, or reach where that
/// is less
pub const BDPT_OUTPUT_DISTANCE_OCTAHEDRAL: bdpt_output_kind = 14;

/// 1 plane: the direct part of E as if nothing were in its way \[W/m²\], whatever paths says; of all kinds of lights,
/// by direct lighting alone, whatever techniques take part: it costs no ray. A shadow mask of group g is IRRADIANCE
/// with BDPT_LIGHT_PATHS_DIRECT over this, both of group g; 1 where both are 0
pub const BDPT_OUTPUT_UNSHADOWED: bdpt_output_kind = 15;

/// the part of the picture that paths and groups name. DIRECT is light of at most two edges: that of lights that are
/// seen, and that of one reflection
pub const BDPT_OUTPUT_RADIANCE: bdpt_output_kind = 16;

/// the part of light, in \[0,1\], that the surface sends on, reflected or transmitted, for the direction from which it
/// is seen: of a diffuse surface its reflectance
pub const BDPT_OUTPUT_ALBEDO: bdpt_output_kind = 17;

/// x, y, z: the shading normal, in the world, on the side that is seen
pub const BDPT_OUTPUT_NORMAL: bdpt_output_kind = 18;

/// in place of colours the means of d, d² and 1: d the distance from the camera along its axis; of fisheyes and
/// panoramas, the distance from the point. The first over the third is the mean of what is seen
pub const BDPT_OUTPUT_DEPTH: bdpt_output_kind = 19;

/// x, y, z in the world
pub const BDPT_OUTPUT_POSITION: bdpt_output_kind = 20;

/// no plane: whose surfaces the samples met, bdpt_instance_id; see bdpt_film_read_coverage
pub const BDPT_OUTPUT_INSTANCE_COVERAGE: bdpt_output_kind = 21;

/// the same, bdpt_material_id. Of each of these two a camera has one at most
pub const BDPT_OUTPUT_MATERIAL_COVERAGE: bdpt_output_kind = 22;

/// bdpt_plane_info: a camera's pixels, or a measurement of your own
pub const BDPT_OUTPUT_NONE: bdpt_output_kind = -1;

pub type bdpt_light_paths = i32;
pub const BDPT_LIGHT_PATHS_ALL: bdpt_light_paths = 0;

/// light that comes straight from where it is emitted to what is measured or seen
pub const BDPT_LIGHT_PATHS_DIRECT: bdpt_light_paths = 1;

/// all other
pub const BDPT_LIGHT_PATHS_INDIRECT: bdpt_light_paths = 2;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_output_desc {
    pub struct_size: u32,
    pub kind: bdpt_output_kind,
    pub paths: bdpt_light_paths,
    pub reach: f32,
    pub groups: u64,
    pub size: u32,
    pub unfiltered: u32,
}
sized!(bdpt_output_desc);

/// What a plane of the film measures.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_plane_info {
    pub struct_size: u32,
    pub kind: bdpt_output_kind,
    pub paths: bdpt_light_paths,
    pub reach: f32,
    pub groups: u64,
    pub output: u32,
    pub coefficient: u32,
    pub reserved: u64,
}
sized!(bdpt_plane_info);

/// An instance and its place in an atlas.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_instance {
    pub struct_size: u32,
    pub atlas: u32,
    pub instance: bdpt_instance_id,
    pub uv_set: u32,
    pub flip: u32,
    pub scale: [f32; 2],
    pub offset: [f32; 2],
}
sized!(bdpt_lightmap_instance);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_desc {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub atlas_count: u32,
    pub instance_count: u32,
    pub instance_stride: u32,
    pub instances: *const bdpt_lightmap_instance,
    pub output_count: u32,
    pub output_stride: u32,
    pub outputs: *const bdpt_output_desc,
    pub rect: [u32; 4],
    pub geometric_normals: u32,
    pub buried_rays: u32,
    pub backface_tolerance: f32,
    pub all_backs: u32,
    pub cancel: *const bdpt_cancel,
    pub film_of_rect: u32,
    pub reserved: u32,
}
sized!(bdpt_lightmap_desc);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_lightmap_info {
    pub struct_size: u32,
    pub width: u32,
    pub height: u32,
    pub reserved: u32,
    pub texels: u64,
    pub texels_shared: u64,
    pub triangles_unmapped: u64,
    pub triangles_outside: u64,
    pub area: f64,
    pub area_outside: f64,
    pub texels_buried: u64,
    pub area_buried: f64,
}
sized!(bdpt_lightmap_info);

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_point {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub radius: f32,
    pub cone: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_points_desc {
    pub struct_size: u32,
    pub output_count: u32,
    pub count: u64,
    pub point_stride: u64,
    pub points: *const bdpt_point,
    pub outputs: *const bdpt_output_desc,
    pub output_stride: u32,
    pub offset: f32,
}
sized!(bdpt_points_desc);

/// An instance whose vertices are measured.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_vertex_instance {
    pub struct_size: u32,
    pub flip: u32,
    pub instance: bdpt_instance_id,
}
sized!(bdpt_vertex_instance);

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_vertices_desc {
    pub struct_size: u32,
    pub instance_count: u32,
    pub instances: *const bdpt_vertex_instance,
    pub outputs: *const bdpt_output_desc,
    pub output_count: u32,
    pub output_stride: u32,
    pub instance_stride: u32,
    pub geometric_normals: u32,
}
sized!(bdpt_vertices_desc);

/// Where a measurement begins.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_start {
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
    pub weight: f32,
    pub density_position: f32,
    pub density_direction: f32,
    pub offset: f32,
    pub reserved: u32,
}

/// A point of a measurement and a direction there.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_place {
    pub measurement: u64,
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
    pub reserved: u32,
}

/// Light that lands on a surface of the scene.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_landing {
    pub instance: bdpt_instance_id,
    pub triangle: u32,
    pub u: f32,
    pub v: f32,
    pub position: [f32; 3],
    pub normal: [f32; 3],
    pub direction: [f32; 3],
}

/// What it counts for.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct bdpt_measurement_landed {
    pub measurement: u64,
    pub normal: [f32; 3],
    pub weight: f32,
    pub density_position: f32,
    pub reserved: u32,
}
pub const BDPT_NO_MEASUREMENT: u64 = u64::MAX;

#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct bdpt_custom_desc {
    pub struct_size: u32,
    pub planes: u32,
    pub measurements: u64,
    pub hash: u64,
    pub start: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            measurements: *const u64,
            numbers: *const [f32; 4],
            starts: *mut bdpt_measurement_start,
        ) -> i32,
    >,
    pub density: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            places: *const bdpt_measurement_place,
            densities: *mut f32,
        ) -> i32,
    >,
    pub respond: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            places: *const bdpt_measurement_place,
            responses: *mut f32,
        ) -> i32,
    >,
    pub land: Option<
        unsafe extern "C" fn(
            user: *mut c_void,
            n: u32,
            landings: *const bdpt_measurement_landing,
            landed: *mut bdpt_measurement_landed,
        ) -> i32,
    >,
    pub user: *mut c_void,
    pub drop: Option<unsafe extern "C" fn(user: *mut c_void)>,
}
sized!(bdpt_custom_desc);

extern "C" {
    /// Creates a camera.
    pub fn bdpt_camera_create(
        context: *mut bdpt_context,
        desc: *const bdpt_camera_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Tells what plane `plane` of a sensor's films measures.
    pub fn bdpt_sensor_get_plane(
        sensor: *const bdpt_sensor,
        plane: u32,
        info: *mut bdpt_plane_info,
    ) -> bdpt_result;

    /// Creates a lightmap.
    pub fn bdpt_lightmap_create(
        scene: *mut bdpt_scene,
        desc: *const bdpt_lightmap_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Tells what a lightmap covers.
    pub fn bdpt_lightmap_get_info(
        sensor: *const bdpt_sensor,
        info: *mut bdpt_lightmap_info,
    ) -> bdpt_result;

    /// Reads, for each texel in rows, the part of it that its surfaces cover, by area in the atlas (above 1 where they
    /// overlap; 0 where nothing is measured), and the area of these surfaces in the world.
    pub fn bdpt_lightmap_read_texels(
        sensor: *const bdpt_sensor,
        coverage: *mut f32,
        area: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Reads, for each texel in rows, the part of it whose surfaces are buried, by area in the atlas;
    /// bdpt_lightmap_read_texels tells of what is left.
    pub fn bdpt_lightmap_read_buried(
        sensor: *const bdpt_sensor,
        buried: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Creates a sensor of points in space.
    pub fn bdpt_points_create(
        context: *mut bdpt_context,
        desc: *const bdpt_points_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Creates a sensor of the vertices of meshes.
    pub fn bdpt_vertices_create(
        scene: *mut bdpt_scene,
        desc: *const bdpt_vertices_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Reads A_j of each vertex, in square world units; 0 where nothing is measured.
    pub fn bdpt_vertices_read_areas(
        sensor: *const bdpt_sensor,
        areas: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Turns means by hat functions, as a film of the sensor has them, into values at the vertices, in place: of all
    /// functions linear on each triangle the one nearest to what was measured, by least squares over the surface.
    pub fn bdpt_vertices_solve(
        sensor: *const bdpt_sensor,
        channels: u32,
        values: *mut f32,
        capacity: u64,
    ) -> bdpt_result;

    /// Creates a sensor from functions.
    pub fn bdpt_custom_create(
        context: *mut bdpt_context,
        desc: *const bdpt_custom_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_sensor_retain(sensor: *mut bdpt_sensor);

    /// Takes a reference.
    pub fn bdpt_sensor_release(sensor: *mut bdpt_sensor);
}
