# SPDX-License-Identifier: Apache-2.0
"""A witness, a module like witness_luxcore.py, in a process of its own: two renderers in one spoil each other's memory."""
import concurrent.futures
import importlib
import multiprocessing

_ways = {}


def _about(module):
    witness = importlib.import_module(module)
    return witness.ID, witness.NAME, witness.METAL, witness.MEASURED


def _load(module, *arguments):
    _ways.clear()
    _ways.update(importlib.import_module(module).ways(*arguments))
    return list(_ways)


def _render(way, seed):
    return _ways[way](seed)


class Witness:
    def __init__(self, module):
        self._module = module
        self._process = concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context('spawn'))
        self.id, self.name, self.metal, self.measured = self._ask(_about, module)

    def _ask(self, *arguments):
        return self._process.submit(*arguments).result()

    def ways(self, scene, samples, max_edges):
        """Renders of SCENE by name: functions of a seed that return a grey picture, and the processor time it took."""
        names = self._ask(_load, self._module, scene, samples, max_edges)
        return {name: lambda seed, name=name: self._ask(_render, name, seed) for name in names}
