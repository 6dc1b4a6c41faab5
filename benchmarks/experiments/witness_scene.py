# SPDX-License-Identifier: Apache-2.0
"""Reads the grey scenes of pbrt's format for renderers that lack a reader of it: the few directives they are made of."""
import dataclasses
import pathlib
import re
import sys

import numpy as np

TOKEN = re.compile(r'#[^\n]*|"[^"]*"|[\[\]]|[^\s\[\]"]+')


@dataclasses.dataclass
class Shape:
    file: pathlib.Path
    material: dict  # type is diffuse (reflectance), dielectric (eta) or conductor (roughness, eta, k)
    radiance: list | None  # of the side the normal is on
    to_world: np.ndarray


@dataclasses.dataclass
class Scene:
    path: pathlib.Path
    size: tuple
    camera_to_world: np.ndarray  # pbrt's: x to the right, y up, z forward
    fov: float  # of the smaller side, in degrees
    shapes: list


def directives(text):
    """Yields (name, plain arguments, parameters by name)."""
    tokens = [t for t in TOKEN.findall(text) if not t.startswith('#')]
    i = 0
    while i < len(tokens):
        name, plain, parameters = tokens[i], [], {}
        i += 1
        while i < len(tokens) and not tokens[i][0].isalpha():
            token = tokens[i]
            i += 1
            if token == '[' or (token[0] == '"' and i < len(tokens) and tokens[i] == '[' and ' ' in token):
                key = token.strip('"').split()[-1] if token != '[' else None
                end = tokens.index(']', i)
                values = [t.strip('"') for t in tokens[i + (token != '['):end]]
                i = end + 1
                if key:
                    parameters[key] = values
                else:
                    plain += values
            else:
                plain.append(token.strip('"'))
        yield name, plain, parameters


def floats(values):
    return [float(v) for v in values]


def matrix(values):
    return np.array(floats(values)).reshape(4, 4).T


def material(parameters):
    kind = parameters['type'][0]
    if kind == 'diffuse':
        return {'type': kind, 'reflectance': floats(parameters['reflectance'])}
    if kind == 'dielectric':
        return {'type': kind, 'eta': float(parameters.get('eta', ['1.5'])[0])}
    if kind == 'conductor':
        return {'type': kind, 'roughness': float(parameters['uroughness'][0]), 'eta': floats(parameters['eta']),
                'k': floats(parameters['k'])}
    sys.exit(f'witness_scene.py: a material of type {kind} is not read here; add it to material()')


def write_ply(path, parameters):
    points, normals = (np.array(floats(parameters[n])).reshape(-1, 3) for n in 'PN')
    triangles = np.array([int(v) for v in parameters['indices']]).reshape(-1, 3)
    header = [f'ply\nformat ascii 1.0\nelement vertex {len(points)}'] + [f'property float {n}' for n in
              ('x', 'y', 'z', 'nx', 'ny', 'nz')] + [f'element face {len(triangles)}',
              'property list uchar int vertex_indices', 'end_header']
    rows = [' '.join(map(repr, map(float, (*p, *n)))) for p, n in zip(points, normals)]
    path.write_text('\n'.join(header + rows + ['3 ' + ' '.join(map(str, t)) for t in triangles]) + '\n')


def read(path, width, folder):
    """The scene at path, width pixels wide; FOLDER takes the meshes that stand in the text."""
    scene = Scene(path, (width, width), np.eye(4), 90.0, [])
    materials, current, radiance, transform, stack = {}, {'type': 'diffuse', 'reflectance': [0.5] * 3}, None, np.eye(4), []
    for name, plain, p in directives(path.read_text()):
        if name == 'Transform':
            transform = matrix(plain)
        elif name == 'Film':
            scene.size = (width, round(width * int(p['yresolution'][0]) / int(p['xresolution'][0])))
        elif name == 'Camera':
            scene.camera_to_world, scene.fov = np.linalg.inv(transform), float(p['fov'][0])
        elif name == 'WorldBegin':
            transform = np.eye(4)
        elif name == 'MakeNamedMaterial':
            materials[plain[0]] = material(p)
        elif name == 'NamedMaterial':
            current = materials[plain[0]]
        elif name == 'AttributeBegin':
            stack.append((current, radiance, transform))
        elif name == 'AttributeEnd':
            current, radiance, transform = stack.pop()
        elif name == 'AreaLightSource':
            radiance = floats(p['L'])
        elif name == 'Shape':
            file = path.parent / p['filename'][0] if 'filename' in p else folder / f'{len(scene.shapes)}.ply'
            if 'filename' not in p:
                write_ply(file, p)
            scene.shapes.append(Shape(file, current, radiance, transform))
    return scene
