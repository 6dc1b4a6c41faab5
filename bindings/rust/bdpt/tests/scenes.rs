// SPDX-License-Identifier: Apache-2.0
//! Scenes hold what was added, however it was given.

mod common;
use bdpt::*;
use common::*;
use std::sync::Arc;

fn info_of(mesh: Mesh) -> SceneInfo {
    let mut builder = Builder::new(&threads(1)).unwrap();
    let floor = builder.add_mesh(mesh).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    builder.add_instance(&Instance::new(floor, clay)).unwrap();
    builder.build().unwrap().info().unwrap()
}

#[test]
fn arrays_are_the_same_however_they_are_given() {
    let shared: Arc<[[f32; 3]]> = CORNERS.to_vec().into();
    let mut flat: Vec<f32> = Vec::new();
    for [x, y, z] in CORNERS {
        flat.extend([9.0, x, y, z, 8.0]);
    }
    let mut roomy = Vec::with_capacity(99);
    roomy.extend(CORNERS);
    let longer: Vec<_> = [[8.0; 3]].into_iter().chain(CORNERS).chain([[7.0; 3]; 2]).collect();
    let positions: Vec<Data<[f32; 3]>> = vec![
        CORNERS.into(),
        (&CORNERS).into(),
        CORNERS.to_vec().into(),
        CORNERS[..].into(),
        roomy.into(),
        shared.into(),
        Data::from_owner(CORNERS.to_vec()),
        Data::range(longer, 1..5).unwrap(),
        Data::interleaved(flat, 1, 5).unwrap(),
    ];
    let hash = info_of(square()).hash;
    for (i, positions) in positions.into_iter().enumerate() {
        assert_eq!(positions.len(), 4, "{i}");
        let wide: [Indices; 2] = [TRIANGLES.to_vec().into(), vec![[0_u16, 1, 2], [0, 2, 3]].into()];
        let mesh = Mesh::new(positions).indices(wide.into_iter().nth(i % 2).unwrap());
        assert_eq!(info_of(mesh).hash, hash, "{i}");
    }
}

#[test]
fn a_scene_tells_what_it_holds() {
    let scene = scene(&threads(1)).unwrap();
    let info = scene.info().unwrap();
    assert_eq!((info.lights, info.instances, info.triangles, info.spheres), (1, 3, 4, 1));
    assert_eq!((info.degenerate_triangles, info.curves), (0, 0));
    assert_eq!((info.bounds_min, info.bounds_max), ([-1.0, 0.0, -1.0], [1.0, 2.0, 1.0]));
    assert!(info.memory >= info.memory_embree && info.memory_embree > 0);
    let lights = scene.lights().unwrap();
    assert_eq!((lights.len(), lights[0].label.as_str(), lights[0].light), (1, "lamp", None));
    assert!(lights[0].instance.is_some());
}

#[test]
fn materials_of_all_kinds_are_built_and_rendered() {
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    let medium = builder.add_medium(&Medium::new([0.1; 3], [0.2; 3]).mean_cosine(0.5).label("fog")).unwrap();
    let pixels = builder.add_texture(Texture::srgb(2, 2, 4, &[200_u8; 16]).mip_levels(2)).unwrap();
    let (eta, k) = Metal::Copper.index().unwrap();
    let wood = Material::diffuse([0.5; 3]).diffuse_roughness(0.3).reflectance_texture(pixels).one_sided(true);
    let first = builder.add_material(wood).unwrap();
    let second = builder.add_material(Material::coated_diffuse([0.2, 0.4, 0.6]).ior(1.4).roughness([0.1; 2])).unwrap();
    let mut materials = vec![first, second];
    for material in [
        Material::mirror([0.9; 3]),
        Material::metal(Metal::Silver).unwrap(),
        Material::conductor(eta, k).roughness([0.2, 0.4]).anisotropy_rotation(30.0).single_scattering(true),
        Material::dielectric(1.3).interior(medium).priority(3),
        Material::dielectric(1.5).thin_walled(false).roughness([0.3; 2]).perceptual_roughness(true),
        Material::interface(medium),
        Material::diffuse_transmission([0.4; 3], [0.5; 3]),
        Material::coated_conductor(eta, k).coat_ior(1.6).coat_roughness(0.1).roughness([0.2; 2]),
        Material::principled([0.8, 0.2, 0.1])
            .roughness([0.4; 2])
            .metalness(0.2)
            .coat(0.5)
            .coat_roughness(0.1)
            .specular(0.0)
            .sheen_color([0.2; 3])
            .sheen_roughness(0.4)
            .anisotropy(0.3)
            .iridescence(0.5, 1.4, 300.0, 0.0),
        Material::principled([0.8; 3]).transmission(0.7).thin_walled(true).specular_color([1.0, 0.9, 0.8]),
        Material::principled([0.8; 3]).diffuse_transmission_weight(0.6).transmittance([0.3, 0.6, 0.2]),
        Material::mix(first, second, 0.25),
        Material::brushed([0.7; 3]),
        Material::diffuse([0.5; 3]).opacity_mask(0.7, 0.3).texture(TextureUse::new(Slot::Opacity, pixels).channel(3)),
        Material::diffuse([0.5; 3]).opacity_blend(0.5),
        Material::diffuse([0.5; 3]).emission([3.0, 2.0, 1.0]).emission_two_sided(true).emission_group(7),
        Material::diffuse([0.5; 3]).emission([1.0; 3]).emission_exponent(20.0),
    ] {
        materials.push(builder.add_material(material).unwrap());
    }
    let ball = builder.add_sphere(Sphere::new([0.0; 3], 0.4)).unwrap();
    for (i, material) in materials.iter().enumerate() {
        let at = Transform::translate([(i % 5) as f32 - 2.0, (i / 5) as f32 - 1.5, 0.0]);
        builder.add_instance(&Instance::new(ball, *material).transform(at)).unwrap();
    }
    for light in [
        Light::point([0.0, 3.0, 3.0], [20.0; 3]).label("bulb"),
        Light::spot([3.0, 3.0, 3.0], [-1.0, -1.0, -1.0], [30.0; 3], 40.0).cone_falloff(10.0).texture(pixels).group(1),
        Light::environment([0.3; 3]).texture(pixels).transform(Transform::rotate([0.0, 1.0, 0.0], 90.0)),
        Light::directional([0.0, -1.0, -1.0], [2.0; 3]).angular_radius(0.3).portals(&[Portal {
            corner: [-3.0, 3.0, -3.0],
            edge_u: [6.0, 0.0, 0.0],
            edge_v: [0.0, 0.0, 6.0],
        }]),
    ] {
        builder.add_light(&light).unwrap();
    }
    let scene = builder.build().unwrap();
    assert_eq!(scene.info().unwrap().lights, 6);
    let kinds = [
        Camera::perspective(10, 8).lens(0.1, 6.0).aperture(5, 10.0).focus_tilt([1.0, 0.0]),
        Camera::orthographic(10, 8, 5.0),
        Camera::equidistant(10, 8),
        Camera::equisolid(10, 8).field_of_view(200.0),
        Camera::equirectangular(10, 8),
        Camera::cube(4),
        Camera::cube_column(4),
        Camera::traced_lens(
            10,
            8,
            &[
                LensSurface { radius: 50.0, thickness: 5.0, ior: 1.5, aperture: 20.0 },
                LensSurface { radius: -50.0, thickness: 48.0, ior: 1.0, aperture: 20.0 },
            ],
        )
        .focus_distance(6.0),
    ];
    for camera in kinds {
        let moves = [Transform::translate([0.0, 0.0, 6.0]), Transform::translate([0.1, 0.0, 6.0])];
        let sensor = camera.clone().transform(moves[0]).end_transform(moves[1]).create(&context).unwrap();
        let film = Film::new(&sensor, &FilmOptions::default().filter(Filter::Box)).unwrap();
        let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new().max_edges(8)).unwrap();
        render.advance(Advance::passes(8)).unwrap();
        let image = render.film().read(Layer::Color).unwrap();
        assert!(image.as_floats().iter().any(|value| *value > 0.0), "{camera:?}");
    }
    // The whole scene in fog, which lights that are infinitely far do not allow.
    assert_eq!(code(builder.build_with(BuildOptions::new().medium(medium))), ErrorCode::InvalidArgument);
}

#[test]
fn curves_and_subdivision_surfaces_are_displaced_and_built() {
    let mut builder = Builder::new(&threads(1)).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    let points: Vec<[f32; 3]> = (0..8).map(|i| [i as f32 * 0.2, (i % 2) as f32, 0.0]).collect();
    let hair = Curves::new(CurveBasis::CatmullRom, points, vec![0.02; 8]).counts(vec![4, 4]).label("hair");
    let hair = builder.add_curves(hair).unwrap();
    let mut asked = 0;
    let leaf = Subdivision::new(CORNERS, vec![0, 1, 2, 0, 2, 3])
        .face_counts(vec![3, 3])
        .level(2)
        .uv(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
        .creases(&[([0, 2], f32::INFINITY)])
        .corners(&[(1, 2.0)])
        .boundary(Boundary::Pin)
        .displace(|place| {
            asked += 1;
            let length: f32 = place.normal.iter().map(|n| n * n).sum();
            assert!((length - 1.0).abs() < 1e-3 && place.uv.iter().all(|t| (0.0..=1.0).contains(t)));
            [place.position[0], place.position[1] + 1.0, place.position[2]]
        });
    let leaf = builder.add_subdivision(leaf).unwrap();
    assert!(asked > 4);
    builder.add_instance(&Instance::new(hair, clay)).unwrap();
    builder.add_instance(&Instance::new(leaf, clay)).unwrap();
    let info = builder.build().unwrap().info().unwrap();
    assert_eq!((info.curves, info.triangles), (2, 2 * 3 * 4 / 2));
    assert!(info.bounds_max[1] >= 1.0);
}

#[test]
fn updates_are_for_scenes_built_from_then_on() {
    let mut builder = Builder::new(&threads(1)).unwrap();
    let floor = builder.add_material(Material::diffuse([0.7; 3])).unwrap();
    fill(&mut builder, floor).unwrap();
    let light = builder.add_light(&Light::point([0.0, 1.0, 0.0], [1.0; 3])).unwrap();
    let before = builder.build().unwrap();
    builder.update_material(floor, Material::diffuse([0.2; 3])).unwrap();
    builder.update_light(light, &Light::environment([1.0; 3]).group(3)).unwrap();
    let after = builder.build().unwrap();
    assert_ne!(before.info().unwrap().hash, after.info().unwrap().hash);
    let groups = |scene: &Scene| scene.lights().unwrap().iter().map(|light| light.group).collect::<Vec<_>>();
    assert_eq!((groups(&before), groups(&after)), (vec![0, 0], vec![3, 0]));
    builder.remove_light(light).unwrap();
    builder.update_material(floor, Material::diffuse([0.7; 3])).unwrap();
    let mut render = render_of(&builder.build().unwrap()).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    assert!(bits(render.film()) == reference(2));
}

#[test]
fn labels_name_objects_in_error_texts() {
    let mut builder = Builder::new(&threads(1)).unwrap();
    let text = |error: Error| error.to_string();
    let error = builder.add_sphere(Sphere::new([0.0; 3], -1.0).label("the ball")).map_err(text).unwrap_err();
    assert!(error.contains("the ball"), "{error}");
    let error = builder.add_material(Material::diffuse([2.0; 3]).label("the wall")).map_err(text).unwrap_err();
    assert!(error.contains("the wall"), "{error}");
}
