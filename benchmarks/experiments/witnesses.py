#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders two scenes by Mitsuba 3 and by this library, and writes witness-mitsuba.json for page.py.

    witnesses.py FOLDER PROGRAM SCENES [--quick]

FOLDER is that of the results, PROGRAM is build/bdpt, SCENES holds Bitterli's grey scenes in pbrt's format, which both
read: the few directives they are made of are turned into Mitsuba's here.
"""
import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

mi.set_variant('scalar_rgb')
MAX_EDGES = 6
TOKEN = re.compile(r'#[^\n]*|"[^"]*"|[\[\]]|[^\s\[\]"]+')


# --- pbrt to Mitsuba ---

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


def grey(values):
    return {'type': 'rgb', 'value': floats(values)}


def bsdf(parameters):
    kind = parameters['type'][0]
    if kind == 'dielectric':
        return {'type': 'dielectric', 'int_ior': float(parameters.get('eta', ['1.5'])[0]), 'ext_ior': 1.0}
    if kind == 'diffuse':
        inner = {'type': 'diffuse', 'reflectance': grey(parameters['reflectance'])}
    elif kind == 'conductor':
        inner = {'type': 'roughconductor', 'distribution': 'ggx', 'alpha': float(parameters['uroughness'][0]),
                 'eta': grey(parameters['eta']), 'k': grey(parameters['k'])}
    else:
        sys.exit(f'witnesses.py: a material of type {kind} has no counterpart here; add it to bsdf()')
    return {'type': 'twosided', 'inner': inner}


def write_ply(path, parameters):
    points, normals = (np.array(floats(parameters[n])).reshape(-1, 3) for n in 'PN')
    triangles = np.array([int(v) for v in parameters['indices']]).reshape(-1, 3)
    header = [f'ply\nformat ascii 1.0\nelement vertex {len(points)}'] + [f'property float {n}' for n in
              ('x', 'y', 'z', 'nx', 'ny', 'nz')] + [f'element face {len(triangles)}',
              'property list uchar int vertex_indices', 'end_header']
    rows = [' '.join(map(repr, map(float, (*p, *n)))) for p, n in zip(points, normals)]
    path.write_text('\n'.join(header + rows + ['3 ' + ' '.join(map(str, t)) for t in triangles]) + '\n')


def matrix(values):
    return np.array(floats(values)).reshape(4, 4).T


def convert(path, width, folder):
    scene = {'type': 'scene', 'integrator': {'type': 'path', 'max_depth': MAX_EDGES}}
    materials, material, light, transform, stack = {}, None, None, np.eye(4), []
    camera, size = {}, (width, width)
    for name, plain, p in directives(path.read_text()):
        if name == 'Transform':
            transform = matrix(plain)
        elif name == 'Film':
            size = (width, round(width * int(p['yresolution'][0]) / int(p['xresolution'][0])))
        elif name == 'Camera':
            # pbrt's picture has x to the right, Mitsuba's to the left.
            to_world = np.linalg.inv(transform) @ np.diag([-1.0, 1, 1, 1])
            camera = {'type': 'perspective', 'fov': float(p['fov'][0]), 'fov_axis': 'smaller',
                      'to_world': mi.ScalarTransform4f(to_world.tolist())}
        elif name == 'WorldBegin':
            transform = np.eye(4)
        elif name == 'MakeNamedMaterial':
            materials[plain[0]] = bsdf(p)
        elif name == 'NamedMaterial':
            material = materials[plain[0]]
        elif name == 'AttributeBegin':
            stack.append((material, light, transform))
        elif name == 'AttributeEnd':
            material, light, transform = stack.pop()
        elif name == 'AreaLightSource':
            light = grey(p['L'])
        elif name == 'Shape':
            file = folder / f'{len(scene)}.ply'
            if plain[0] == 'trianglemesh':
                write_ply(file, p)
            else:
                file = path.parent / p['filename'][0]
            shape = {'type': 'ply', 'filename': str(file), 'bsdf': material or bsdf({'type': ['diffuse'],
                     'reflectance': ['0.5'] * 3}), 'to_world': mi.ScalarTransform4f(transform.tolist())}
            if light:
                shape['emitter'] = {'type': 'area', 'radiance': light}
            scene[f'shape{len(scene)}'] = shape
    camera['film'] = {'type': 'hdrfilm', 'width': size[0], 'height': size[1], 'rfilter': {'type': 'box'},
                      'pixel_format': 'rgb', 'component_format': 'float32'}
    scene['sensor'] = camera
    return mi.load_dict(scene), size


# --- Renders: a grey picture, and the processor time it took ---

def by_mitsuba(scene, samples, seed):
    begin = time.process_time()
    image = np.array(mi.render(scene, spp=samples, seed=seed))
    return image[..., :3].mean(axis=2), time.process_time() - begin


def by_bdpt(program, path, size, integrator, samples, seed, folder):
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    begin, output = used(), folder / 'picture.exr'
    subprocess.run([program, 'render', path, '-o', output, '--integrator', integrator, '--spp', str(samples), '--seed',
                    str(seed), '--filter', 'box', '--max-edges', str(MAX_EDGES), '--width', str(size[0]), '--height',
                    str(size[1])], check=True, stderr=subprocess.DEVNULL)
    spent = used() - begin
    layers = dict(mi.Bitmap(str(output)).split())
    return np.array(layers['<root>'])[..., :3].mean(axis=2), spent


# --- Figures, as docs/experiments.md defines them ---

def relative_variance(images, reference):
    return float(np.mean(np.var(images, axis=0, ddof=1) / (reference ** 2 + 0.01 * reference.mean() ** 2)))


def jackknife(turns, of):
    logs = np.log([of([j for j in range(turns) if j != i]) for i in range(turns)])
    value = of(list(range(turns)))
    return estimate(value, value * float(np.sqrt(logs.var() * (turns - 1))))


def estimate(value, error):
    digits = max(0, -int(np.floor(np.log10(max(error / 1.5, value / 500)))))
    return {'value': value, 'error': error, 'text': f'{value:.{digits}f} ± {error:.{digits}f}'}


def measure(name, scenes, program, quick, folder):
    path = scenes / name / 'scene-v4-grey.pbrt'
    scene, size = convert(path, 96 if quick else 256, folder)
    turns, samples = (6, 32) if quick else (12, 64)
    ways = {'Mitsuba 3, path tracing': lambda seed: by_mitsuba(scene, samples, seed),
            'bdpt, path tracing': lambda seed: by_bdpt(program, path, size, 'path', samples, seed, folder),
            'bdpt, BDPT': lambda seed: by_bdpt(program, path, size, 'bdpt', samples, seed, folder)}
    images, seconds = ({way: [] for way in ways} for _ in range(2))
    for turn in range(turns):
        for way, render in ways.items():
            image, spent = render(turn + 1)
            images[way].append(image)
            seconds[way].append(spent)
    images = {way: np.array(i) for way, i in images.items()}
    last = list(ways)[-1]
    # A render of its own: no way's noise may enter its own measure.
    reference = by_bdpt(program, path, size, 'bdpt', samples * turns, 1000000, folder)[0]
    first = list(ways)[0]
    cost = lambda way, turns_: relative_variance(images[way][turns_], reference) * np.mean(np.array(seconds[way])[turns_])
    rows, agree = [], True
    for way in ways:
        means, others = images[way].mean(axis=(1, 2)), images[last].mean(axis=(1, 2))
        error = np.hypot(means.std(ddof=1) / means.mean(), others.std(ddof=1) / others.mean()) / np.sqrt(turns)
        ratio = float(means.mean() / others.mean())
        agree = agree and (way == last or abs(ratio - 1) < 4 * error + 0.001)
        faster = '1' if way == first else jackknife(turns, lambda t, w=way: cost(first, t) / cost(w, t))
        rows.append([way, '1' if way == last else estimate(ratio, float(error)),
                     jackknife(turns, lambda t, w=way: relative_variance(images[w][t], reference)),
                     float(np.mean(seconds[way])), faster])
    table = {'title': f'{name}, {size[0]} x {size[1]}, {samples} samples a pixel', 'columns': [
        '', 'mean / BDPT', 'relative variance', 'processor seconds', 'times faster to equal variance than Mitsuba'],
        'rows': rows}
    return table, agree


def main(arguments):
    quick = '--quick' in arguments
    arguments = [a for a in arguments if a != '--quick']
    if len(arguments) != 3:
        sys.exit(__doc__)
    output, program, scenes = pathlib.Path(arguments[0]), arguments[1], pathlib.Path(arguments[2])
    begin, tables, agree = time.time(), [], True
    with tempfile.TemporaryDirectory() as folder:
        for name in ('cornell-box', 'veach-bidir'):
            table, same = measure(name, scenes, program, quick, pathlib.Path(folder))
            tables.append(table)
            agree = agree and same
    output.mkdir(parents=True, exist_ok=True)
    (output / 'witness-mitsuba.json').write_text(json.dumps({
        'id': 'witness-mitsuba', 'paper': f'Mitsuba {mi.__version__}', 'title': 'Another renderer',
        'claim': 'Renderers measure the same.', 'size': 'quick' if quick else 'full', 'seconds': time.time() - begin,
        'processor_share': 1, 'verdict': 'agrees' if agree else 'differs',
        'verdict_text': 'The means agree within four standard errors.' if agree else 'The means do not agree.',
        'measured': f'Grey scenes, paths of up to {MAX_EDGES} edges, box filter. Mitsuba is its variant scalar_rgb: not '
                    'its fastest, but the one that needs no LLVM. The time of bdpt holds reading the scene, too.',
        'notes': [], 'tables': tables, 'plots': [], 'pictures': []}))


if __name__ == '__main__':
    main(sys.argv[1:])
