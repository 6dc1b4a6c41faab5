// SPDX-License-Identifier: Apache-2.0

//! Vertices of meshes

use crate::*;

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

extern "C" {
    /// Creates a sensor of the vertices of meshes.
    pub fn bdpt_vertices_create(
        scene: *mut bdpt_scene,
        desc: *const bdpt_vertices_desc,
        sensor: *mut *mut bdpt_sensor,
    ) -> bdpt_result;

    /// Reads A_j of each vertex, in square world units; 0 where nothing is measured.
    pub fn bdpt_vertices_read_areas(sensor: *const bdpt_sensor, areas: *mut f32, capacity: u64) -> bdpt_result;

    /// Turns means by hat functions, as a film of the sensor has them, into values at the vertices, in place: of all
    /// functions linear on each triangle the one nearest to what was measured, by least squares over the surface.
    pub fn bdpt_vertices_solve(
        sensor: *const bdpt_sensor,
        channels: u32,
        values: *mut f32,
        capacity: u64,
    ) -> bdpt_result;
}
