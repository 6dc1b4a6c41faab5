# SPDX-License-Identifier: Apache-2.0
"""Renders a scene of witness_scene.py by LuxCore."""
import atexit
import contextlib
import io
import time

import numpy as np

with contextlib.redirect_stdout(io.StringIO()):  # it lists the libraries it loads
    import pyluxcore

pyluxcore.Init(lambda message: None)
atexit.register(pyluxcore.SetLogHandler, None)  # else the interpreter aborts at its end
ID = 'witness-luxcore'
NAME = f'LuxCore {pyluxcore.Version()}'
METAL = False  # rough metal: its two engines differ by 1.4 per cent, and the nearer one from this library by 0.7
MEASURED = ('BIDIRCPU is without roulette: its weights leave the chance to survive out, and with it the Cornell box '
            'is 5 per cent too bright. It bounds each of its two subpaths, not their sum.')


def properties(values):
    result = pyluxcore.Properties()
    for name, value in values.items():
        result.Set(pyluxcore.Property(name, value))
    return result


def material(values):
    if values['type'] == 'diffuse':
        return {'type': 'matte', 'kd': values['reflectance']}
    if values['type'] == 'dielectric':
        return {'type': 'glass', 'kr': [1.0] * 3, 'kt': [1.0] * 3, 'interiorior': values['eta'], 'exteriorior': 1.0}
    # The distribution of normals is that of pbrt, the shadowing and Fresnel's formula are not.
    return {'type': 'metal2', 'n': values['eta'], 'k': values['k'], 'uroughness': values['roughness'],
            'vroughness': values['roughness']}


def camera(scene):
    position, forward, up = (scene.camera_to_world[:3, i] for i in (3, 2, 1))
    width, height = scene.size
    x, y = max(1, width / height), max(1, height / width)
    # Its rows lie one pixel higher than its window says.
    row = 2 * y / height
    return {'type': 'perspective', 'lookat.orig': position.tolist(), 'lookat.target': (position + forward).tolist(),
            'up': up.tolist(), 'fieldofview': scene.fov, 'screenwindow': [-x, x, -y - row, y - row],
            'autofocus.enable': False, 'lensradius': 0.0}


def load(scene):
    values = {f'scene.camera.{k}': v for k, v in camera(scene).items()}
    for i, shape in enumerate(scene.shapes):
        values |= {f'scene.materials.material{i}.{k}': v for k, v in material(shape.material).items()}
        if shape.radiance:
            values[f'scene.materials.material{i}.emission'] = shape.radiance
        values |= {f'scene.objects.shape{i}.ply': str(shape.file), f'scene.objects.shape{i}.material': f'material{i}'}
        if not np.array_equal(shape.to_world, np.eye(4)):
            values[f'scene.objects.shape{i}.transformation'] = shape.to_world.T.flatten().tolist()
    result = pyluxcore.Scene()
    result.Parse(properties(values))
    return result


def render(scene, size, settings):
    """A grey picture, and the processor time it took."""
    session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties(settings), scene))
    begin = time.process_time()
    session.Start()
    while not session.HasDone():
        time.sleep(0.02)
        session.UpdateStats()
    session.Stop()
    spent = time.process_time() - begin
    image = np.zeros(size[0] * size[1] * 3, dtype=np.float32)
    session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB, image)  # linear, the lowest row first
    return image.reshape(size[1], size[0], 3)[::-1].mean(axis=2), spent


def ways(scene, samples, max_edges):
    """As Witness.ways."""
    loaded = load(scene)
    settings = {'film.width': scene.size[0], 'film.height': scene.size[1], 'film.filter.type': 'NONE',
                'sampler.type': 'SOBOL', 'sampler.sobol.adaptive.strength': 0.0, 'batch.haltspp': samples,
                'path.clamping.variance.maxvalue': 0.0, 'path.maxdepth': max_edges, 'light.maxdepth': max_edges}
    settings |= {f'path.pathdepth.{k}': max_edges for k in ('total', 'diffuse', 'glossy', 'specular')}
    engines = {'LuxCore, PATHCPU': {'renderengine.type': 'PATHCPU'},
               'LuxCore, BIDIRCPU': {'renderengine.type': 'BIDIRCPU', 'path.russianroulette.depth': 10 ** 6}}
    return {name: lambda seed, engine=engine: render(loaded, scene.size,
                                                     settings | engine | {'renderengine.seed': seed})
            for name, engine in engines.items()}
