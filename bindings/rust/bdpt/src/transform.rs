// SPDX-License-Identifier: Apache-2.0
//! Where things are.

/// A matrix of 3 rows and 4 columns that takes points of an object, or of a camera, to the world.
///
/// ```
/// use bdpt::Transform;
/// let there = Transform::scale(2.0).then(Transform::translate([1.0, 0.0, 0.0]));
/// assert_eq!(there.point([1.0, 1.0, 1.0]), [3.0, 2.0, 2.0]);
/// let camera = Transform::look_at([0.0, 1.0, 5.0], [0.0, 1.0, 0.0], [0.0, 1.0, 0.0]);
/// assert_eq!(camera.point([0.0, 0.0, -5.0]), [0.0, 1.0, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform([f32; 12]);

impl Transform {
    /// Changes nothing.
    pub const IDENTITY: Self = Self([1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]);

    /// From three rows, each of three factors and an offset.
    pub const fn from_rows(rows: [f32; 12]) -> Self {
        Self(rows)
    }
    /// From where the axes point to, and where the origin comes to be.
    pub const fn from_columns(x: [f32; 3], y: [f32; 3], z: [f32; 3], at: [f32; 3]) -> Self {
        Self([x[0], y[0], z[0], at[0], x[1], y[1], z[1], at[1], x[2], y[2], z[2], at[2]])
    }
    /// Three rows, each of three factors and an offset.
    pub const fn rows(&self) -> [f32; 12] {
        self.0
    }
    /// Moves by an offset.
    pub const fn translate(offset: [f32; 3]) -> Self {
        let [x, y, z] = offset;
        Self([1.0, 0.0, 0.0, x, 0.0, 1.0, 0.0, y, 0.0, 0.0, 1.0, z])
    }
    /// Scales alike in all directions.
    pub const fn scale(factor: f32) -> Self {
        Self::scale_axes([factor; 3])
    }
    /// Scales along the axes.
    pub const fn scale_axes(factors: [f32; 3]) -> Self {
        let [x, y, z] = factors;
        Self([x, 0.0, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, 0.0, z, 0.0])
    }
    /// Turns round an axis, of any length but zero, counter-clockwise for who looks against it, in degrees.
    pub fn rotate(axis: [f32; 3], degrees: f32) -> Self {
        let [x, y, z] = normalized(axis);
        let (s, c) = degrees.to_radians().sin_cos();
        let d = 1.0 - c;
        Self([
            c + x * x * d,
            x * y * d - z * s,
            x * z * d + y * s,
            0.0,
            y * x * d + z * s,
            c + y * y * d,
            y * z * d - x * s,
            0.0,
            z * x * d - y * s,
            z * y * d + x * s,
            c + z * z * d,
            0.0,
        ])
    }
    /// Puts a camera, which looks along its own -z with y up, at `from`, so that it looks at `at`.
    pub fn look_at(from: [f32; 3], at: [f32; 3], up: [f32; 3]) -> Self {
        let back = normalized([from[0] - at[0], from[1] - at[1], from[2] - at[2]]);
        let right = normalized(cross(up, back));
        let up = cross(back, right);
        let row = |i: usize| [right[i], up[i], back[i], from[i]];
        let ([a, b, c, d], [e, f, g, h], [i, j, k, l]) = (row(0), row(1), row(2));
        Self([a, b, c, d, e, f, g, h, i, j, k, l])
    }
    /// This one first, then `outer`.
    pub fn then(self, outer: Self) -> Self {
        let (a, b) = (outer.0, self.0);
        Self(std::array::from_fn(|i| {
            let (row, column) = (i / 4 * 4, i % 4);
            let sum = a[row] * b[column] + a[row + 1] * b[4 + column] + a[row + 2] * b[8 + column];
            sum + if column == 3 { a[row + 3] } else { 0.0 }
        }))
    }
    /// Where a point comes to be.
    pub fn point(&self, p: [f32; 3]) -> [f32; 3] {
        let m = &self.0;
        std::array::from_fn(|i| m[4 * i] * p[0] + m[4 * i + 1] * p[1] + m[4 * i + 2] * p[2] + m[4 * i + 3])
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl From<Transform> for [f32; 12] {
    fn from(transform: Transform) -> Self {
        transform.0
    }
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn normalized(v: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    v.map(|x| x / length)
}
