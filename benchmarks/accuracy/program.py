# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Runs `gigaray` as a user does."""

import json
import subprocess


def output_of(command):
    """stdout of a program; ends with its last line when it fails."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if done.returncode != 0:
        last = done.stderr.strip().splitlines()[-1:]
        raise SystemExit(f"{' '.join(map(str, command[1:3]))}: {' '.join(last)}")
    return done.stdout


class Gigaray:
    def __init__(self, program, extra):
        self.program, self.extra = program, extra

    def depth(self, scene, out, preset, views):
        """Writes `out`, returns its gigaray.json."""
        output_of([self.program, "depth", scene.folder, "-o", out, "--preset", preset,
                   "--views", views, *self.extra])
        return json.loads((out / "gigaray.json").read_text())

    def scores(self, estimate, truth, *options):
        """The JSON of `gigaray evaluate`."""
        return json.loads(output_of([self.program, "evaluate", estimate, truth, "--json",
                                     *options]))
