// SPDX-License-Identifier: Apache-2.0
//! Shapes with a material, placed in the world.

use crate::error::{Result, Text};
use crate::id::{MaterialId, ShapeId};
use crate::plain::Plain;
use crate::transform::Transform;
use bdpt_sys as sys;

/// Places a shape, with a material, in the world.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Instance, Material, Sphere, Transform};
/// let mut builder = Builder::new(&Context::new()?)?;
/// let ball = builder.add_sphere(Sphere::new([0.0; 3], 1.0))?;
/// let clay = builder.add_material(Material::diffuse([0.6, 0.4, 0.3]))?;
/// let left = builder.add_instance(&Instance::new(ball, clay).transform(Transform::translate([-2.0, 0.0, 0.0])))?;
/// builder.add_instance(&Instance::new(ball, clay).transform(Transform::translate([2.0, 0.0, 0.0])))?;
/// builder.update_instance(left, &Instance::new(ball, clay).transform(Transform::scale(0.5)))?;
/// # Ok(()) }
/// ```
#[derive(Clone, Debug)]
pub struct Instance {
    label: Option<String>,
    raw: Plain<sys::bdpt_instance_desc>,
}

impl Instance {
    /// A shape where it is.
    pub fn new(shape: ShapeId, material: MaterialId) -> Self {
        let raw = sys::bdpt_instance_desc { shape: shape.0, material: material.0, ..Default::default() };
        Self { label: None, raw: raw.into() }
    }
    labelled!();
    setters! {
        /// Object to world, invertible.
        transform: Transform => transform;
        /// The same when the shutter closes: between, all points move on straight lines. Not for what emits.
        end_transform: Transform => end_transform;
        /// No ray meets it: it casts no shadow and scatters no light, but lightmaps and vertices may measure it.
        invisible: bool => invisible;
    }

    pub(crate) fn with_desc<R>(&self, call: impl FnOnce(&sys::bdpt_instance_desc) -> Result<R>) -> Result<R> {
        let label = Text::new(&self.label)?;
        call(&sys::bdpt_instance_desc { label: label.as_ptr(), ..*self.raw })
    }
}
