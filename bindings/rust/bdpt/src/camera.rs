// SPDX-License-Identifier: Apache-2.0
//! Cameras of all kinds.

use crate::context::Context;
use crate::error::Result;
use crate::host::pointer;
use crate::light::count;
use crate::output::Output;
use crate::panics::make;
use crate::plain::Plain;
use crate::rect::Rect;
use crate::sensor::Sensor;
use crate::transform::Transform;
use bdpt_sys as sys;

/// A surface of a lens, as tables of patents have it, in the lens' unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LensSurface {
    /// Of its curvature; positive where the centre is on the film's side; 0 = flat.
    pub radius: f32,
    /// Along the axis, to the next surface; of the last, to the film.
    pub thickness: f32,
    /// Behind it, 1 to 4; 0 = 1, air. Flat with the same on both sides: a stop.
    pub ior: f32,
    /// Diameter through which light passes.
    pub aperture: f32,
}

/// A camera. It looks along its own -z, with x to the right and y up. `bdpt.h` defines each number and its range; those
/// that a kind of camera does not have are refused.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Camera, Context, Output, OutputKind, Transform};
/// let context = Context::new()?;
/// let camera = Camera::perspective(640, 480)
///     .transform(Transform::look_at([0.0, 1.0, 6.8], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]))
///     .field_of_view(19.5)
///     .lens(0.05, 6.0)
///     .output(Output::new(OutputKind::Albedo))
///     .output(Output::new(OutputKind::Depth));
/// let sensor = camera.create(&context)?;
/// assert_eq!(sensor.plane(2)?.kind, OutputKind::Depth);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    raw: Plain<sys::bdpt_camera_desc>,
    surfaces: Vec<sys::bdpt_lens_surface>,
    outputs: Vec<Output>,
}

impl Camera {
    fn new(kind: sys::bdpt_camera_type, width: u32, height: u32) -> Self {
        let raw = sys::bdpt_camera_desc { type_: kind, width, height, ..Default::default() };
        Self { raw: raw.into(), surfaces: Vec::new(), outputs: Vec::new() }
    }
    /// Straight lines stay straight: a pinhole, or with [`lens`](Self::lens) a thin lens.
    pub fn perspective(width: u32, height: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_PERSPECTIVE, width, height)
    }
    /// Parallel rays; `field_height` in world units from the image's bottom to its top.
    pub fn orthographic(width: u32, height: u32, field_height: f32) -> Self {
        let mut camera = Self::new(sys::BDPT_CAMERA_ORTHOGRAPHIC, width, height);
        camera.raw.field_height = field_height;
        camera
    }
    /// A fisheye: the angle with the axis grows as the distance from the centre.
    pub fn equidistant(width: u32, height: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_EQUIDISTANT, width, height)
    }
    /// A fisheye: each pixel of the circle sees the same solid angle.
    pub fn equisolid(width: u32, height: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_EQUISOLID, width, height)
    }
    /// All directions: longitude to the right, latitude upward, -z in the middle.
    pub fn equirectangular(width: u32, height: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_EQUIRECTANGULAR, width, height)
    }
    /// All directions, on the faces +x -x +y -y +z -z of a cube map, `size` pixels each way, in a row.
    pub fn cube(size: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_CUBE, size.saturating_mul(6), size)
    }
    /// The same in a column.
    pub fn cube_column(size: u32) -> Self {
        Self::new(sys::BDPT_CAMERA_CUBE, size, size.saturating_mul(6))
    }
    /// A lens by its surfaces, 1 to 64, from the scene to the film.
    pub fn traced_lens(width: u32, height: u32, surfaces: &[LensSurface]) -> Self {
        let mut camera = Self::new(sys::BDPT_CAMERA_LENS, width, height);
        let raw = |s: &LensSurface| sys::bdpt_lens_surface {
            radius: s.radius,
            thickness: s.thickness,
            ior: s.ior,
            aperture: s.aperture,
        };
        camera.surfaces = surfaces.iter().map(raw).collect();
        camera
    }

    /// The pixels measured.
    pub fn crop(mut self, crop: Rect) -> Self {
        self.raw.crop = crop.raw();
        self
    }
    /// Perspective: a thin lens, by its radius and the distance to the plane in focus, along the axis.
    pub fn lens(mut self, radius: f32, focus_distance: f32) -> Self {
        (self.raw.lens_radius, self.raw.focus_distance) = (radius, focus_distance);
        self
    }
    /// Perspective and traced lenses: a regular polygon of 3 to 32 corners, turned by degrees, in place of a round
    /// aperture.
    pub fn aperture(mut self, blades: u32, rotation: f32) -> Self {
        (self.raw.aperture_blades, self.raw.aperture_rotation) = (blades, rotation);
        self
    }
    /// Measures more beside the picture: planes 1, 2 ... of the film, in this order.
    pub fn output(mut self, output: Output) -> Self {
        self.outputs.push(output);
        self
    }
    setters! {
        /// Camera to world: rotation, reflection and translation; uniform scale is taken out.
        transform: Transform => transform;
        /// The same when the shutter closes: between, the camera moves and turns evenly.
        end_transform: Transform => end_transform;
        /// Perspective: vertical, of the whole image, in degrees; 0 = 45. Fisheyes: across the circle; 0 = 180.
        field_of_view: f32 => field_of_view;
        /// The frame's centre moves right and up by these fractions of its width and height.
        shift: [f32; 2] => shift;
        /// Traced lenses: the film moves until what is near the axis there is sharp.
        focus_distance: f32 => focus_distance;
        /// Perspective with a lens: degrees by which the plane in focus leans.
        focus_tilt: [f32; 2] => focus_tilt;
        /// Traced lenses: of the whole image on the film, in the lens' unit; 0 = 24.
        film_height: f32 => film_height;
        /// Traced lenses: world units in one of the lens; 0 = 0.001, millimetres in metres.
        lens_unit: f32 => lens_unit;
    }

    /// Creates the sensor.
    pub fn create(&self, context: &Context) -> Result<Sensor> {
        let outputs: Vec<_> = self.outputs.iter().map(Output::raw).collect();
        let desc = sys::bdpt_camera_desc {
            lens_surfaces: pointer(&self.surfaces),
            lens_surface_count: count(self.surfaces.len()),
            outputs: pointer(&outputs),
            output_count: count(outputs.len()),
            ..*self.raw
        };
        make(
            context.panics(),
            // SAFETY: what the description points to lives until the call returns, and is copied.
            |raw| unsafe { sys::bdpt_camera_create(context.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Sensor::new(raw, context.panics().clone(), context.clone()) },
        )
    }
}
