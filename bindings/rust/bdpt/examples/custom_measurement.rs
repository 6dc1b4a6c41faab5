// SPDX-License-Identifier: Apache-2.0

//! A measurement that no renderer has: how much light the leaves of a plant take up. A leaf absorbs on both sides, less of
//! what comes in flat, for its cuticle reflects that. Each leaf is one measurement with two planes: the light that falls on
//! it, and the light that it takes up.

use bdpt::*;
use std::f32::consts::PI;

const LEAVES: u16 = 12;
const WIDTH: f32 = 0.2;
const LENGTH: f32 = 0.6;
pub const AREA: f32 = 2.0 * WIDTH * LENGTH; // of both sides

type Vector = [f32; 3];

fn dot(a: Vector, b: Vector) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn scaled(a: Vector, factor: f32) -> Vector {
    a.map(|x| x * factor)
}

fn sum<const N: usize>(vectors: [Vector; N]) -> Vector {
    [0, 1, 2].map(|c| vectors.iter().map(|vector| vector[c]).sum())
}

/// A leaf: its instance, middle, and unit vectors along and across it and off its upper side.
struct Leaf {
    instance: InstanceId,
    middle: Vector,
    along: Vector,
    across: Vector,
    normal: Vector,
}

struct Plant {
    leaves: Vec<Leaf>,
}

fn taken_up(cosine: f32) -> f32 {
    let reflected = 0.04 + 0.96 * (1.0 - cosine).powi(5); // Schlick (1994)
    0.85 * (1.0 - reflected)
}

impl Measurement for Plant {
    fn functions(&self) -> Functions {
        Functions::default().density().respond().land()
    }

    /// A point of the leaf, on either side, and a direction by the cosine. W is 1: what is measured is power.
    fn start(&self, measurements: &[u64], numbers: &[[f32; 4]], starts: &mut [Start]) {
        for ((start, measurement), u) in starts.iter_mut().zip(measurements).zip(numbers) {
            let leaf = &self.leaves[*measurement as usize];
            let (side, r2) = if u[2] < 0.5 { (1.0, 2.0 * u[2]) } else { (-1.0, 2.0 * u[2] - 1.0) };
            let (r, phi, up) = (r2.sqrt(), 2.0 * PI * u[3], (1.0 - r2).sqrt());
            let along = scaled(leaf.along, LENGTH / 2.0 * (2.0 * u[0] - 1.0));
            let across = scaled(leaf.across, WIDTH / 2.0 * (2.0 * u[1] - 1.0));
            start.position = sum([leaf.middle, along, across]);
            start.normal = scaled(leaf.normal, side);
            start.direction =
                sum([scaled(leaf.along, r * phi.cos()), scaled(leaf.across, r * phi.sin()), scaled(start.normal, up)]);
            start.weight = AREA; // one over the density: two sides
            start.density_position = 1.0 / AREA;
            start.density_direction = 1.0 / PI;
            start.offset = 1e-5;
        }
    }

    fn density(&self, _: &[Place], densities: &mut [f32]) {
        densities.fill(1.0 / PI);
    }

    fn respond(&self, places: &[Place], responses: &mut [f32]) {
        for (place, planes) in places.iter().zip(responses.chunks_exact_mut(2)) {
            planes[0] = 1.0;
            planes[1] = taken_up(dot(place.normal, place.direction));
        }
    }

    /// Light subpaths that land on a leaf count there.
    fn land(&self, landings: &[Landing], landed: &mut [Landed]) {
        for (landing, landed) in landings.iter().zip(landed) {
            let leaves = self.leaves.iter().enumerate();
            if let Some((k, leaf)) = leaves.into_iter().find(|(_, leaf)| leaf.instance == landing.instance()) {
                let side = if dot(leaf.normal, landing.direction) > 0.0 { 1.0 } else { -1.0 };
                landed.count_for(k as u64);
                landed.normal = scaled(leaf.normal, side);
                landed.weight = 1.0;
                landed.density_position = 1.0 / AREA;
            }
        }
    }
}

/// Leaf number k of a spiral round a stem.
fn add_leaf(builder: &mut Builder, square: ShapeId, green: MaterialId, k: u16) -> Result<Leaf> {
    let (turn, height, rise) = (2.39996 * f32::from(k), 0.3 + 0.12 * f32::from(k), 0.35_f32);
    let along = [turn.cos() * rise.cos(), rise.sin(), turn.sin() * rise.cos()];
    let across = [-turn.sin(), 0.0, turn.cos()];
    let normal = [
        across[1] * along[2] - across[2] * along[1],
        across[2] * along[0] - across[0] * along[2],
        across[0] * along[1] - across[1] * along[0],
    ];
    let middle = [0.4 * turn.cos(), height, 0.4 * turn.sin()];
    let row = |c: usize| [LENGTH / 2.0 * along[c], normal[c], WIDTH / 2.0 * across[c], middle[c]];
    let rows: Vec<f32> = (0..3).flat_map(row).collect();
    let mut matrix = [0.0; 12];
    matrix.copy_from_slice(&rows);
    let instance = builder.add_instance(&Instance::new(square, green).transform(Transform::from_rows(matrix)))?;
    Ok(Leaf { instance, middle, along, across, normal })
}

/// Measures leaves under a uniform sky of radiance 1 for so many passes: what falls on each, and what it takes up.
pub fn measure(leaves: u16, passes: u64) -> Result<[Vec<f32>; 2]> {
    let context = Context::new()?;
    let mut builder = Builder::new(&context)?;
    let corners = vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    let square = builder.add_mesh(Mesh::new(corners).indices(vec![[0_u16, 1, 2], [0, 2, 3]]))?;
    let green = builder.add_material(Material::diffuse([0.1; 3]))?;
    builder.add_light(&Light::environment([1.0; 3]))?;
    let leaves: Vec<_> = (0..leaves).map(|k| add_leaf(&mut builder, square, green, k)).collect::<Result<_>>()?;

    let count = leaves.len();
    let sensor = Custom::new(count as u64, Plant { leaves }).planes(2).create(&context)?;
    let scene = builder.build()?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&scene, &sensor, film, &RenderOptions::default())?;
    render.advance(Advance::passes(passes))?;
    let read = |plane| -> Result<Vec<f32>> {
        let image = render.film().read(ReadOptions::new(Layer::Color).plane(plane))?;
        Ok(image.pixels().iter().take(count).map(|pixel| pixel[0]).collect())
    };
    Ok([read(0)?, read(1)?])
}

fn main() -> Result<()> {
    let [falls, _] = measure(1, 4096)?;
    println!("a leaf alone: {:.4} W falls on it, and should: {:.4}", falls[0], PI * AREA);
    let [falls, taken] = measure(LEAVES, 1024)?;
    println!("leaf  falls on it [W]  takes up [W]");
    for (k, (falls, taken)) in falls.iter().zip(&taken).enumerate() {
        println!("{k:4}  {falls:15.4}  {taken:12.4}");
    }
    Ok(())
}
