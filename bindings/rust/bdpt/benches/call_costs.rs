// SPDX-License-Identifier: Apache-2.0
//! What calls cost from Rust, as benchmarks/call_costs.cpp measures it from C: 8 passes of 256 x 256 pixels in one call,
//! in 8 calls, and with the image sent by tiles after each pass, on one thread. Medians of the ratios of each turn.
//!
//!     cargo bench --bench call_costs -- [TURNS]

use bdpt::*;
use std::time::Instant;

const PASSES: u64 = 8;

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn room(context: &Context) -> Result<Scene> {
    let mut builder = Builder::new(context)?;
    let grey = builder.add_material(Material::diffuse([0.7; 3]))?;
    let lamp = builder.add_material(Material::diffuse([0.7; 3]).emission([10.0; 3]))?;
    let quads: [(_, [[f32; 3]; 4]); 6] = [
        (grey, [[-1., 0., 1.], [1., 0., 1.], [1., 0., -1.], [-1., 0., -1.]]),
        (grey, [[-1., 2., -1.], [1., 2., -1.], [1., 2., 1.], [-1., 2., 1.]]),
        (grey, [[-1., 0., -1.], [1., 0., -1.], [1., 2., -1.], [-1., 2., -1.]]),
        (grey, [[-1., 0., 1.], [-1., 0., -1.], [-1., 2., -1.], [-1., 2., 1.]]),
        (grey, [[1., 0., -1.], [1., 0., 1.], [1., 2., 1.], [1., 2., -1.]]),
        (lamp, [[-0.3, 1.99, -0.3], [0.3, 1.99, -0.3], [0.3, 1.99, 0.3], [-0.3, 1.99, 0.3]]),
    ];
    for (material, corners) in quads {
        let quad = builder.add_mesh(Mesh::new(corners).indices(vec![[0_u32, 1, 2], [0, 2, 3]]))?;
        builder.add_instance(&Instance::new(quad, material))?;
    }
    builder.build()
}

fn main() -> Result<()> {
    let turns: usize = std::env::args().find_map(|text| text.parse().ok()).unwrap_or(15);
    let context = ContextOptions::default().threads(1).create()?;
    let scene = room(&context)?;
    let at = Transform::translate([0.0, 1.0, 3.6]);
    let camera = Camera::perspective(256, 256).transform(at).create(&context)?;
    let seconds = |calls: u64, tiles: bool| -> Result<f64> {
        let film = Film::new(&camera, &FilmOptions::default())?;
        let mut render = Render::new(&scene, &camera, film, &RenderOptions::default())?;
        let begin = Instant::now();
        let mut sum = 0.0;
        for _ in 0..calls {
            let advance = Advance::passes(PASSES / calls);
            if tiles {
                render.advance(advance.tiles(1, |tile| sum += tile.rows().map(|row| row[0][0]).sum::<f32>()))?;
            } else {
                render.advance(advance)?;
            }
        }
        Ok(begin.elapsed().as_secs_f64())
    };
    let (mut calls, mut tiles) = (Vec::new(), Vec::new());
    seconds(1, false)?; // warms up
    for _ in 0..turns {
        let one = seconds(1, false)?;
        calls.push(seconds(PASSES, false)? / one);
        tiles.push(seconds(PASSES, true)? / one);
    }
    println!("a call for each pass, over one call          {:.4}", median(calls));
    println!("and the image by tiles, over one call        {:.4}", median(tiles));
    Ok(())
}
