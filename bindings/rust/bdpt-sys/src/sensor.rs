// SPDX-License-Identifier: Apache-2.0

//! Sensors: what all kinds have

use crate::*;

opaque!(bdpt_sensor);

extern "C" {
    /// Tells what plane `plane` of a sensor's films measures.
    pub fn bdpt_sensor_get_plane(sensor: *const bdpt_sensor, plane: u32, info: *mut bdpt_plane_info) -> bdpt_result;

    /// Adds a reference.
    pub fn bdpt_sensor_retain(sensor: *mut bdpt_sensor);

    /// Takes a reference.
    pub fn bdpt_sensor_release(sensor: *mut bdpt_sensor);
}
