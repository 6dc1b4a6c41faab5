// SPDX-License-Identifier: Apache-2.0
//! Points in space, disks and balls: what arrives at each.

use crate::context::Context;
use crate::count::{array, count};
use crate::error::Result;
use crate::output::Output;
use crate::panics::make;
use crate::sensor::Sensor;
use bdpt_sys as sys;

/// A place where light is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct Point {
    raw: sys::bdpt_point,
}

impl Point {
    /// A point that takes light from everywhere.
    pub fn new(position: [f32; 3]) -> Self {
        Self { raw: sys::bdpt_point { position, ..Default::default() } }
    }
    /// Only light from the side of this normal counts; of any length but zero.
    pub fn normal(mut self, normal: [f32; 3]) -> Self {
        self.raw.normal = normal;
        self
    }
    /// The mean over a disk of this radius across the normal, or without one over a ball.
    pub fn radius(mut self, radius: f32) -> Self {
        self.raw.radius = radius;
        self
    }
    /// Only light within so many degrees of the normal counts, above 0 to 90.
    pub fn cone(mut self, degrees: f32) -> Self {
        self.raw.cone = degrees;
        self
    }
}

/// A sensor of points, to be created. A packed read of its film begins with them, one after another: see
/// [`Image::pixels`](crate::Image::pixels).
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Context, Output, OutputKind, Point, Points};
/// let context = Context::new()?;
/// let desk = Point::new([0.0, 0.75, 0.0]).normal([0.0, 1.0, 0.0]);
/// let air = Point::new([0.0, 1.5, 0.0]).radius(0.05);
/// let sensor = Points::new(&[desk]).output(Output::new(OutputKind::Irradiance)).create(&context)?;
/// let balls = Points::new(&[air; 12]).create(&context)?; // fluence, for there is no normal
/// # let _ = (sensor, balls);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Points<'a> {
    points: &'a [Point],
    outputs: Vec<sys::bdpt_output_desc>,
    offset: f32,
}

impl<'a> Points<'a> {
    /// Of these points, at least one.
    pub fn new(points: &'a [Point]) -> Self {
        Self { points, outputs: Vec::new(), offset: 0.0 }
    }
    /// One more output; where none is asked for, irradiance if the first point has a normal, else fluence.
    pub fn output(mut self, output: Output) -> Self {
        self.outputs.push(output.raw());
        self
    }
    /// Points with a normal may lie on surfaces: their rays start so far off, along the normal. By default 16 ulps of the
    /// largest coordinate, which is enough unless a triangle there is larger than that.
    pub fn offset(mut self, distance: f32) -> Self {
        self.offset = distance;
        self
    }
    /// The sensor. The points are copied.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument), also for irradiance of points without a normal.
    pub fn create(&self, context: &Context) -> Result<Sensor> {
        let desc = sys::bdpt_points_desc {
            count: self.points.len() as u64,
            points: array(self.points) as *const sys::bdpt_point,
            output_count: count(self.outputs.len(), "outputs")?,
            outputs: array(&self.outputs),
            offset: self.offset,
            ..Default::default()
        };
        make(
            context.panics(),
            // SAFETY: a Point is a bdpt_point; what desc points to is borrowed from self, and copied by the call.
            |raw| unsafe { sys::bdpt_points_create(context.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Sensor::new(raw, context.panics().clone(), context.clone()) },
        )
    }
}
