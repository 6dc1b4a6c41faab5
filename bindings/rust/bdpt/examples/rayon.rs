// SPDX-License-Identifier: Apache-2.0
//! Renders on rayon's threads: the library starts none of its own, which the kernel's list of threads shows.

use bdpt::*;
use rayon::prelude::*;
use std::collections::BTreeSet;

struct Rayon(rayon::ThreadPool);

impl Executor for Rayon {
    fn worker_count(&self) -> u32 {
        self.0.current_num_threads() as u32
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        self.0.install(|| (0..n).into_par_iter().with_max_len(1).for_each(body));
    }
}

/// The threads of this process, where the system tells.
fn threads() -> std::io::Result<BTreeSet<String>> {
    std::fs::read_dir("/proc/self/task")?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect()
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build()?;
    pool.broadcast(|_| ()); // all have started
    let before = threads()?;

    let context = ContextOptions::default().executor(Rayon(pool)).create()?;
    let mut builder = Builder::new(&context)?;
    let ball = builder.add_sphere(Sphere::new([0.0; 3], 1.0))?;
    let clay = builder.add_material(Material::diffuse([0.8, 0.5, 0.3]))?;
    builder.add_instance(&Instance::new(ball, clay))?;
    builder.add_light(&Light::environment([1.0; 3]))?;
    let sensor = Camera::perspective(128, 128).transform(Transform::translate([0.0, 0.0, 4.0])).create(&context)?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&builder.build()?, &sensor, film, &RenderOptions::new())?;
    let mut most = before.clone();
    render.advance(Advance::passes(16).progress(|_| most.extend(threads().unwrap_or_default())))?;

    most.extend(threads()?);
    let middle = render.film().read(Layer::Color)?.pixel(64, 64).unwrap_or_default();
    println!("the ball's middle is {:.2} {:.2} {:.2}", middle[0], middle[1], middle[2]);
    println!("{} threads before, {} in all", before.len(), most.len());
    if most != before {
        return Err("the library started a thread".into());
    }
    println!("the library started no thread");
    Ok(())
}
