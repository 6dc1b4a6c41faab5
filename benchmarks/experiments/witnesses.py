#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders two scenes by Mitsuba 3, by LuxCore and by this library, and writes a row of page.py for each of the two.

    witnesses.py FOLDER PROGRAM SCENES [--quick]

FOLDER is that of the results, PROGRAM is build/bdpt, SCENES holds Bitterli's grey scenes in pbrt's format. LuxCore is
left out where its module is not to be had. Other renderers: a module like witness_luxcore.py, and its name in main().
"""
import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

import witness_scene
from witness_process import Witness

# LuxCore's bidirectional engine bounds its two subpaths, not their sum. Of these scenes' light less than a thousandth
# takes paths that are longer than this.
MAX_EDGES = 12


# --- A render by bdpt: a grey picture, and the processor time it took ---

def read_grey(file):
    import mitsuba as mi  # here, for what stands above is imported into the processes of the other witnesses, too
    mi.set_variant('scalar_rgb')
    return np.array(dict(mi.Bitmap(str(file)).split())['<root>'])[..., :3].mean(axis=2)


def by_bdpt(program, scene, integrator, samples, seed, folder):
    used = lambda: sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    begin, output = used(), folder / 'picture.exr'
    subprocess.run([program, 'render', scene.path, '-o', output, '--integrator', integrator, '--spp', str(samples), '--seed',
                    str(seed), '--filter', 'box', '--max-edges', str(MAX_EDGES), '--width', str(scene.size[0]), '--height',
                    str(scene.size[1])], check=True, stderr=subprocess.DEVNULL)
    return read_grey(output), used() - begin


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


# --- A scene ---

def table(scene, samples, names, images, seconds, reference):
    """The ways of NAMES, and whether their means agree; the last is what means are divided by, the first what is
    slower or faster."""
    first, last, turns = names[0], names[-1], len(seconds[names[0]])
    cost = lambda way, t: relative_variance(images[way][t], reference) * np.mean(np.array(seconds[way])[t])
    rows, agree = [], True
    for way in names:
        means, others = images[way].mean(axis=(1, 2)), images[last].mean(axis=(1, 2))
        error = np.hypot(means.std(ddof=1) / means.mean(), others.std(ddof=1) / others.mean()) / np.sqrt(turns)
        ratio = float(means.mean() / others.mean())
        agree = agree and (way == last or abs(ratio - 1) < 4 * error + 0.001)
        faster = '1' if way == first else jackknife(turns, lambda t: cost(first, t) / cost(way, t))
        rows.append([way, '1' if way == last else estimate(ratio, float(error)),
                     jackknife(turns, lambda t: relative_variance(images[way][t], reference)),
                     float(np.mean(seconds[way])), faster])
    return {'title': f'{scene.path.parent.name}, {scene.size[0]} x {scene.size[1]}, {samples} samples a pixel',
            'columns': ['', 'mean / BDPT', 'relative variance', 'processor seconds',
                        f'times faster to equal variance than {first}'], 'rows': rows}, agree


def without_metal(path, folder):
    """The scene with matt things for metal ones."""
    text = re.sub(r'"conductor" \][^A-Z]*', '"diffuse" ]\n    "rgb reflectance" [ 0.5 0.5 0.5 ]\n', path.read_text())
    copy = folder / f'{path.parent.name}, matt for metal' / path.name
    copy.parent.mkdir()
    copy.write_text(text)
    if (path.parent / 'models').exists():
        (copy.parent / 'models').symlink_to((path.parent / 'models').resolve())
    return copy


def measure(path, program, witnesses, quick, folder):
    """For each witness a table, and whether its means agree."""
    scene = witness_scene.read(path, 96 if quick else 256, folder)
    turns, samples = (6, 32) if quick else (12, 64)
    ours = {'bdpt, path tracing': lambda seed: by_bdpt(program, scene, 'path', samples, seed, folder),
            'bdpt, BDPT': lambda seed: by_bdpt(program, scene, 'bdpt', samples, seed, folder)}
    theirs = [w.ways(scene, samples, MAX_EDGES) for w in witnesses]
    ways = {way: render for some in [*theirs, ours] for way, render in some.items()}
    images, seconds = ({way: [] for way in ways} for _ in range(2))
    for turn in range(turns):
        for way, render in ways.items():
            image, spent = render(turn + 1)
            images[way].append(image)
            seconds[way].append(spent)
    images = {way: np.array(i) for way, i in images.items()}
    # A render of its own: no way's noise may enter its own measure.
    reference = by_bdpt(program, scene, 'bdpt', samples * turns, 1000000, folder)[0]
    return {w.id: table(scene, samples, [*some, *ours], images, seconds, reference) for w, some in zip(witnesses, theirs)}


def row(witness, results, quick, seconds):
    agree = all(same for _, same in results)
    return {'id': witness.id, 'paper': witness.name, 'title': 'Another renderer', 'claim': 'Renderers measure the same.',
            'size': 'quick' if quick else 'full', 'seconds': seconds, 'processor_share': 1,
            'verdict': 'agrees' if agree else 'differs',
            'verdict_text': 'The means agree within four standard errors.' if agree else 'The means do not agree.',
            'measured': f'Grey scenes, paths of up to {MAX_EDGES} edges, box filter. {witness.measured} The time of bdpt '
                        'holds reading the scene, too.',
            'notes': [], 'tables': [t for t, _ in results], 'plots': [], 'pictures': []}


def found(modules):
    """The witnesses that can be had; tells of the others."""
    witnesses = []
    for module in modules:
        try:
            witnesses.append(Witness(module))
        except Exception as error:  # another's binaries may fail by anything
            print(f'{module} is left out: {error}', file=sys.stderr)
    return witnesses


def main(arguments):
    quick = '--quick' in arguments
    arguments = [a for a in arguments if a != '--quick']
    if len(arguments) != 3:
        sys.exit(__doc__)
    output, program, scenes = pathlib.Path(arguments[0]), arguments[1], pathlib.Path(arguments[2])
    begin = time.time()
    witnesses = found(['witness_mitsuba', 'witness_luxcore'])
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        box, eggs = (scenes / name / 'scene-v4-grey.pbrt' for name in ('cornell-box', 'veach-bidir'))
        results = [measure(path, program, some, quick, folder) for path, some in (
            (box, witnesses), (eggs, [w for w in witnesses if w.metal]),
            (without_metal(eggs, folder), [w for w in witnesses if not w.metal])) if some]
    output.mkdir(parents=True, exist_ok=True)
    for witness in witnesses:
        text = json.dumps(row(witness, [r[witness.id] for r in results if witness.id in r], quick, time.time() - begin))
        (output / f'{witness.id}.json').write_text(text)


if __name__ == '__main__':
    main(sys.argv[1:])
