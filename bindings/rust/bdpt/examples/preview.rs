// SPDX-License-Identifier: Apache-2.0
//! A preview in the terminal: each tile goes into a picture as it comes, and each whole image is drawn over the one
//! before, two pixels to a character. Where stdout is no terminal it is drawn once, at the end. The first argument is
//! the number of passes.

use bdpt::*;
use std::fmt::Write as _;
use std::io::Write as _;
use std::ops::ControlFlow;

const WIDTH: u32 = 72;
const HEIGHT: u32 = 48;

struct Preview {
    picture: Image,
    passes: u64,
    drawn: bool,
    live: bool,
}

impl Preview {
    fn draw(&mut self) -> std::result::Result<(), Box<dyn std::error::Error>> {
        let mut shown = self.picture.clone();
        Display::aces().apply(&mut shown)?;
        let rows: Vec<_> = shown.rows().collect();
        let mut text = String::new();
        if self.drawn {
            write!(text, "\x1b[{}A", HEIGHT / 2 + 1)?; // back to the top
        }
        for pair in rows.chunks_exact(2) {
            for (top, bottom) in pair[0].iter().zip(pair[1]) {
                let ([r, g, b], [u, v, w]) = (top.map(byte), bottom.map(byte));
                write!(text, "\x1b[38;2;{r};{g};{b};48;2;{u};{v};{w}m\u{2580}")?;
                // the upper half of a block
            }
            text.push_str("\x1b[0m\n");
        }
        writeln!(text, "{} passes", self.passes)?;
        self.drawn = true;
        std::io::stdout().write_all(text.as_bytes())?;
        Ok(std::io::stdout().flush()?)
    }
}

fn byte(value: f32) -> u8 {
    (value * 255.0).round() as u8
}

impl Sink for Preview {
    fn begin(&mut self, _: u32, _: u32, passes: u64) -> ControlFlow<()> {
        self.passes = passes;
        ControlFlow::Continue(())
    }
    fn tile(&mut self, tile: Tile<'_>) -> ControlFlow<()> {
        let Rect { x0, y0, x1, .. } = tile.rect();
        for (y, row) in (y0..).zip(tile.rows()) {
            let line = y as usize * WIDTH as usize;
            self.picture.pixels_mut()[line + x0 as usize..line + x1 as usize].copy_from_slice(row);
        }
        ControlFlow::Continue(())
    }
    fn end(&mut self, complete: bool) {
        if complete && self.live {
            self.draw().expect("the terminal is there");
        }
    }
}

fn is_terminal() -> bool {
    let stdout = std::fs::read_link("/proc/self/fd/1").unwrap_or_default();
    stdout.starts_with("/dev/pts") || stdout.starts_with("/dev/tty")
}

fn scene(context: &Context) -> Result<Scene> {
    let mut builder = Builder::new(context)?;
    let ball = builder.add_sphere(Sphere::new([0.0, 1.0, 0.0], 1.0))?;
    let (a, b, c, d) = ([-9.0, 0.0, 9.0], [9.0, 0.0, 9.0], [9.0, 0.0, -9.0], [-9.0, 0.0, -9.0]);
    let floor = builder.add_mesh(Mesh::new([a, b, c, a, c, d]))?;
    let gold = builder.add_material(Material::metal(Metal::Gold)?.roughness([0.15, 0.15]))?;
    let glass = builder.add_material(Material::dielectric(1.5))?;
    let clay = builder.add_material(Material::diffuse([0.5, 0.55, 0.6]))?;
    builder.add_instance(&Instance::new(floor, clay))?;
    builder.add_instance(&Instance::new(ball, gold).transform(Transform::translate([-1.1, 0.0, 0.0])))?;
    builder.add_instance(&Instance::new(ball, glass).transform(Transform::translate([1.1, 0.0, 0.0])))?;
    builder.add_light(&Light::environment([0.3, 0.4, 0.6]))?;
    builder.add_light(&Light::directional([-1.0, -2.0, -1.0], [3.0, 2.7, 2.2]).angular_radius(1.0))?;
    builder.build()
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let passes = std::env::args().nth(1).map_or(Ok(64), |text| text.parse())?;
    let context = Context::new()?;
    let camera = Camera::perspective(WIDTH, HEIGHT)
        .transform(Transform::look_at([0.0, 1.7, 6.0], [0.0, 0.8, 0.0], [0.0, 1.0, 0.0]))
        .field_of_view(35.0);
    let sensor = camera.create(&context)?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&scene(&context)?, &sensor, film, &RenderOptions::new())?;
    let live = is_terminal();
    let mut preview = Preview { picture: Image::new(WIDTH, HEIGHT)?, passes: 0, drawn: false, live };
    render.advance(Advance::passes(passes).sink(if live { 1 } else { 0 }, &mut preview))?;
    if !live {
        preview.draw()?;
    }
    Ok(())
}
