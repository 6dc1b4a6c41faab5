// SPDX-License-Identifier: Apache-2.0
//! Vertices of meshes: what arrives round each.

use crate::count::{array, count};
use crate::error::Result;
use crate::id::InstanceId;
use crate::image::floats_mut;
use crate::output::Output;
use crate::panics::{call, make};
use crate::scene::Scene;
use crate::sensor::Sensor;
use bdpt_sys as sys;

/// A sensor of vertices, to be created. Each measures the mean over the triangles round it, weighed by the function that
/// is 1 there, 0 at all other vertices and linear between: [`Sensor::solve_vertices`] makes values of these, to be
/// interpolated. A packed read of its film begins with the vertices, those of the first instance first.
///
/// ```
/// # fn main() -> bdpt::Result<()> {
/// use bdpt::{Builder, Context, Instance, Material, Mesh, Vertices};
/// let context = Context::new()?;
/// let mut builder = Builder::new(&context)?;
/// let triangle = builder.add_mesh(Mesh::new(vec![[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]]))?;
/// let grey = builder.add_material(Material::diffuse([0.5; 3]))?;
/// let wall = builder.add_instance(&Instance::new(triangle, grey))?;
/// let sensor = Vertices::new().instance(wall).create(&builder.build()?)?;
/// let mut areas = [0.0; 3];
/// sensor.vertex_areas(&mut areas)?;
/// assert!(areas.iter().all(|area| (area - 1.0).abs() < 1e-5)); // a third of 3 each
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct Vertices {
    instances: Vec<sys::bdpt_vertex_instance>,
    outputs: Vec<sys::bdpt_output_desc>,
    geometric_normals: bool,
}

impl Vertices {
    /// Of the vertices of no instance yet.
    pub fn new() -> Self {
        Self::default()
    }
    /// One more instance of a mesh, whose front receives; each once.
    pub fn instance(self, instance: InstanceId) -> Self {
        self.side(instance, false)
    }
    /// One more instance of a mesh, whose back receives.
    pub fn back_of(self, instance: InstanceId) -> Self {
        self.side(instance, true)
    }
    fn side(mut self, instance: InstanceId, flip: bool) -> Self {
        let flip = flip.into();
        self.instances.push(sys::bdpt_vertex_instance { flip, instance: instance.0, ..Default::default() });
        self
    }
    /// One more output; irradiance alone where none is asked for.
    pub fn output(mut self, output: Output) -> Self {
        self.outputs.push(output.raw());
        self
    }
    /// Normals are the triangles', not the vertices'.
    pub fn geometric_normals(mut self, yes: bool) -> Self {
        self.geometric_normals = yes;
        self
    }
    /// The sensor. A render takes it with this scene only, which it keeps alive.
    ///
    /// # Errors
    /// [`InvalidArgument`](crate::ErrorCode::InvalidArgument) for what is no mesh, an instance twice, or when no triangle
    /// has an area; [`InvalidId`](crate::ErrorCode::InvalidId).
    pub fn create(&self, scene: &Scene) -> Result<Sensor> {
        let desc = sys::bdpt_vertices_desc {
            instance_count: count(self.instances.len(), "instances")?,
            instances: array(&self.instances),
            output_count: count(self.outputs.len(), "outputs")?,
            outputs: array(&self.outputs),
            geometric_normals: self.geometric_normals.into(),
            ..Default::default()
        };
        make(
            scene.panics(),
            // SAFETY: what desc points to is borrowed from self, and copied by the call.
            |raw| unsafe { sys::bdpt_vertices_create(scene.as_ptr(), &desc, raw) },
            // SAFETY: the call gave one reference.
            |raw| unsafe { Sensor::new(raw, scene.panics().clone(), scene.context().clone()) },
        )
    }
}

/// Of vertices; other sensors give [`InvalidArgument`](crate::ErrorCode::InvalidArgument).
impl Sensor {
    /// The area that each vertex stands for, in square world units; 0 where nothing is measured.
    ///
    /// # Errors
    /// Also when there are more vertices than room for them.
    pub fn vertex_areas(&self, areas: &mut [f32]) -> Result<()> {
        let (capacity, areas) = (areas.len() as u64, areas.as_mut_ptr());
        // SAFETY: there is room for so many floats.
        call(self.panics(), || unsafe { sys::bdpt_vertices_read_areas(self.as_ptr(), areas, capacity) })
    }
    /// Turns means, as a film of the sensor has them, into values at the vertices, in place: of all functions linear on
    /// each triangle the one nearest to what was measured. Values of vertices that are not measured stay.
    ///
    /// # Errors
    /// Also for values that are not finite, and when there are fewer than vertices.
    pub fn solve_vertices(&self, values: &mut [[f32; 3]]) -> Result<()> {
        let values = floats_mut(values);
        let (capacity, values) = (values.len() as u64, values.as_mut_ptr());
        // SAFETY: there is room for so many floats.
        call(self.panics(), || unsafe { sys::bdpt_vertices_solve(self.as_ptr(), 3, values, capacity) })
    }
}
