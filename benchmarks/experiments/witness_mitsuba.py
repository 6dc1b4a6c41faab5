# SPDX-License-Identifier: Apache-2.0
"""Renders a scene of witness_scene.py by Mitsuba 3."""
import time

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
ID = 'witness-mitsuba'
NAME = f'Mitsuba {mi.__version__}'
METAL = True  # measures rough metal as this library does
MEASURED = 'Mitsuba is its variant scalar_rgb: not its fastest, but the one that needs no LLVM.'


def rgb(value):
    return {'type': 'rgb', 'value': value}


def bsdf(material):
    if material['type'] == 'dielectric':
        return {'type': 'dielectric', 'int_ior': material['eta'], 'ext_ior': 1.0}
    if material['type'] == 'diffuse':
        inner = {'type': 'diffuse', 'reflectance': rgb(material['reflectance'])}
    else:
        inner = {'type': 'roughconductor', 'distribution': 'ggx', 'alpha': material['roughness'],
                 'eta': rgb(material['eta']), 'k': rgb(material['k'])}
    return {'type': 'twosided', 'inner': inner}


def load(scene, max_edges):
    # pbrt's picture has x to the right, Mitsuba's to the left.
    to_world = scene.camera_to_world @ np.diag([-1.0, 1, 1, 1])
    description = {'type': 'scene', 'integrator': {'type': 'path', 'max_depth': max_edges}, 'sensor': {
        'type': 'perspective', 'fov': scene.fov, 'fov_axis': 'smaller',
        'to_world': mi.ScalarTransform4f(to_world.tolist()),
        'film': {'type': 'hdrfilm', 'width': scene.size[0], 'height': scene.size[1], 'rfilter': {'type': 'box'},
                 'pixel_format': 'rgb', 'component_format': 'float32'}}}
    for i, shape in enumerate(scene.shapes):
        description[f'shape{i}'] = {'type': 'ply', 'filename': str(shape.file), 'bsdf': bsdf(shape.material),
                                    'to_world': mi.ScalarTransform4f(shape.to_world.tolist())}
        if shape.radiance:
            description[f'shape{i}']['emitter'] = {'type': 'area', 'radiance': rgb(shape.radiance)}
    return mi.load_dict(description)


def ways(scene, samples, max_edges):
    """As Witness.ways."""
    loaded = load(scene, max_edges)

    def path(seed):
        begin = time.process_time()
        image = np.array(mi.render(loaded, spp=samples, seed=seed))
        return image[..., :3].mean(axis=2), time.process_time() - begin
    return {'Mitsuba, path tracing': path}
