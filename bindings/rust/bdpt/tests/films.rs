// SPDX-License-Identifier: Apache-2.0
//! Films: reading, merging, saving, coverage.

mod common;
use bdpt::*;
use common::*;

fn film_of(first: u64, passes: u64, options: &FilmOptions, camera: &Camera) -> Film {
    let context = threads(1);
    film_in(&context, first, passes, options, camera)
}

fn film_in(context: &Context, first: u64, passes: u64, options: &FilmOptions, camera: &Camera) -> Film {
    let scene = scene(context).unwrap();
    let sensor = camera.create(context).unwrap();
    let film = Film::new(&sensor, options).unwrap();
    let options = RenderOptions::new().seed(5).first_pass(first);
    let mut render = Render::new(&scene, &sensor, film, &options).unwrap();
    render.advance(Advance::passes(passes)).unwrap();
    render.into_film()
}

#[test]
fn a_merge_of_ranges_is_the_render_of_all() {
    let context = threads(1);
    let options = FilmOptions::default();
    let mut film = film_in(&context, 0, 3, &options, &camera());
    let rest = film_in(&context, 3, 2, &options, &camera());
    film.merge(&rest).unwrap();
    assert!(bits(&film) == reference(5));
    assert_eq!(code(film.merge(&rest)), ErrorCode::Mismatch);
    assert!(bits(&film) == reference(5));
    let info = film.info().unwrap();
    assert_eq!((info.passes, info.first_pass, info.next_pass, info.seed), (5, 0, 5, 5));
    film.clear().unwrap();
    assert_eq!(film.info().unwrap().passes, 0);
    film.merge(&rest).unwrap();
    assert_eq!(film.info().unwrap().first_pass, 3);
}

#[test]
fn a_film_is_saved_and_loaded_to_the_bit() {
    let folder = std::env::temp_dir().join(format!("bdpt-films-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("a film \u{e9}.bdpt");
    let film = film_of(0, 3, &FilmOptions::default().groups(3), &camera());
    film.save(&path).unwrap();
    let context = threads(1);
    let loaded = Film::load(&context, &path).unwrap();
    assert!(bits(&loaded) == bits(&film));
    assert_eq!(loaded.info().unwrap(), film.info().unwrap());
    std::fs::write(&path, b"no film").unwrap();
    assert_eq!(code(Film::load(&context, &path)), ErrorCode::Format);
    assert_eq!(code(Film::load(&context, folder.join("none"))), ErrorCode::Io);
    assert_eq!(code(Film::load(&context, "zero\0")), ErrorCode::InvalidArgument);
    assert_eq!(code(film.save(folder.join("no folder/film"))), ErrorCode::Io);
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn parts_of_a_film_are_read() {
    let film = film_of(0, 2, &FilmOptions::default(), &camera());
    let all = film.read(Layer::Color).unwrap();
    assert_eq!((all.width(), all.height()), (12, 10));
    let rect = Rect::new(3, 2, 8, 9);
    let part = film.read(ReadOptions::new(Layer::Color).rect(rect)).unwrap();
    for (y, row) in part.rows().enumerate() {
        for (x, pixel) in row.iter().enumerate() {
            assert_eq!(Some(*pixel), all.pixel(x as u32 + 3, y as u32 + 2));
        }
    }
    let flipped = film.read(ReadOptions::new(Layer::Color).flip(true)).unwrap();
    assert!(flipped.rows().rev().eq(all.rows()));
    // Into a larger picture, row by row.
    let mut large = vec![-1.0; 20 * 10 * 3];
    film.read_into(&ReadOptions::new(Layer::Color).row_stride(60), &mut large).unwrap();
    for (y, row) in large.chunks(60).enumerate() {
        assert_eq!(&row[..36], &all.as_floats()[36 * y..36 * (y + 1)]);
        assert!(row[36..].iter().all(|value| *value == -1.0));
    }
    // One float too few, and then enough: the last row needs no stride.
    assert_eq!(code(film.read_into(&ReadOptions::new(Layer::Color), &mut vec![0.0; 359])), ErrorCode::InvalidArgument);
    film.read_into(&ReadOptions::new(Layer::Color), &mut vec![0.0; 360]).unwrap();
    film.read_into(&ReadOptions::new(Layer::Color).row_stride(60), &mut large[..9 * 60 + 36]).unwrap();
    // Tiles are the picture again.
    let mut pixels = 0;
    for tile in all.tiles(5, 4) {
        let Rect { x0, y0, .. } = tile.rect();
        for (y, row) in tile.rows().enumerate() {
            for (x, pixel) in row.iter().enumerate() {
                assert_eq!(Some(*pixel), all.pixel(x0 + x as u32, y0 + y as u32));
                pixels += 1;
            }
        }
    }
    assert_eq!(pixels, 120);
}

#[test]
fn layers_add_up() {
    let options = FilmOptions::default().pyramid_edges(3).groups(2);
    let film = film_of(0, 4, &options, &camera());
    let read = |layer| film.read(layer).unwrap().into_pixels();
    let (color, eye, light) = (read(Layer::Color), read(Layer::Eye), read(Layer::Light));
    for ((color, eye), light) in color.iter().zip(&eye).zip(&light) {
        for c in 0..3 {
            assert!((color[c] - eye[c] - light[c]).abs() <= 1e-5 * color[c].max(1.0));
        }
    }
    assert!(read(Layer::Variance).iter().flatten().any(|value| *value > 0.0));
    assert!(read(Layer::Technique { s: 1, t: 2 }).iter().flatten().any(|value| *value > 0.0));
    assert_eq!(code(film.read(Layer::Technique { s: 9, t: 9 })), ErrorCode::InvalidArgument);
    assert_eq!(code(film.read(Layer::Samples)), ErrorCode::InvalidArgument);
}

#[test]
fn cameras_have_outputs() {
    let camera = camera()
        .output(Output::new(OutputKind::Albedo).unfiltered(true))
        .output(Output::new(OutputKind::Depth))
        .output(Output::new(OutputKind::InstanceCoverage))
        .output(Output::new(OutputKind::Radiance).paths(LightPaths::Direct));
    let context = threads(1);
    let sensor = camera.create(&context).unwrap();
    let kinds: Vec<_> = (0..4).map(|plane| sensor.plane(plane).unwrap().kind).collect();
    assert_eq!(kinds, [OutputKind::None, OutputKind::Albedo, OutputKind::Depth, OutputKind::Radiance]);
    assert_eq!(sensor.plane(3).unwrap().paths, LightPaths::Direct);
    assert_eq!(code(sensor.plane(4)), ErrorCode::InvalidArgument);

    let film = film_in(&context, 0, 4, &FilmOptions::default(), &camera);
    let info = film.info().unwrap();
    assert_eq!((info.planes, info.coverages), (4, 1));
    let depth = film.read(ReadOptions::new(Layer::Color).plane(2)).unwrap().pixel(6, 6).unwrap();
    assert!((3.0..5.0).contains(&(depth[0] / depth[2])), "{depth:?}");
    let coverage = film.read_coverage(&CoverageOptions::new().ranks(2)).unwrap();
    assert_eq!((coverage.width(), coverage.height(), coverage.entries().len()), (12, 10, 240));
    let scene = scene(&context).unwrap();
    let ball = coverage.pixel(6, 5)[0];
    assert!(ball.id != 0 && ball.part > 0.9, "{ball:?}");
    assert!(scene.lights().unwrap().iter().all(|light| light.instance.unwrap().number() & 0xffff != ball.id & 0xffff));
    assert_eq!(coverage.pixel(12, 0), []);
    assert!((0.0..1.0).contains(&coverage.lost()));
    let without = film_of(0, 1, &FilmOptions::default(), &common::camera());
    assert_eq!(code(without.read_coverage(&CoverageOptions::new())), ErrorCode::InvalidArgument);
}

#[test]
fn an_estimate_is_near_what_is_taken() {
    let context = threads(1);
    let sensor = Camera::perspective(200, 100).create(&context).unwrap();
    let options = FilmOptions::default().groups(3);
    let estimate = Film::estimate(&sensor, &options).unwrap();
    let before = context.info().unwrap().memory;
    let _film = Film::new(&sensor, &options).unwrap();
    let taken = context.info().unwrap().memory - before;
    assert_eq!(estimate.film, taken);
    assert_eq!(estimate.total, estimate.film + estimate.render);
}

#[test]
fn pictures_have_as_many_pixels_as_they_say() {
    assert_eq!(code(Image::from_pixels(2, 2, vec![[0.0; 3]; 3])), ErrorCode::InvalidArgument);
    assert_eq!(code(Image::new(u32::MAX, u32::MAX)), ErrorCode::OutOfMemory);
    let empty = Image::new(0, 7).unwrap();
    assert_eq!((empty.rows().count(), empty.tiles(3, 0).count(), empty.pixel(0, 0)), (0, 0, None));
    let image = Image::from_pixels(2, 1, vec![[1.0; 3], [2.0; 3]]).unwrap();
    assert_eq!((image.pixel(1, 0), image.pixel(2, 0), image.pixel(0, 1)), (Some([2.0; 3]), None, None));
    assert_eq!(image.as_floats(), [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
}

#[cfg(feature = "ndarray")]
#[test]
fn a_film_is_read_as_an_array() {
    let film = film_of(0, 2, &FilmOptions::default(), &camera());
    let (image, array) = (film.read(Layer::Color).unwrap(), film.read_ndarray(Layer::Color).unwrap());
    assert_eq!(array.shape(), [10, 12, 3]);
    for ((y, x, c), value) in array.indexed_iter() {
        assert_eq!(*value, image.pixel(x as u32, y as u32).unwrap()[c]);
    }
}
