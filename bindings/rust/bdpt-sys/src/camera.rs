// SPDX-License-Identifier: Apache-2.0

//! Cameras

use crate::*;

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

extern "C" {
    /// Creates a camera.
    pub fn bdpt_camera_create(
        context: *mut bdpt_context,
        desc: *const bdpt_camera_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;
}
