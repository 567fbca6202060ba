#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Peak memory of every command against its limit and its forecast, as a Markdown table.

    benchmarks/memory/measure.py build/release/cli/gigaray [-w FOLDER] [--only depth,cloud]

Renders light fields, then runs each command with compiled kernels absent (cold) and present
(warm). "forecast" is what `depth` writes into gigaray.json. A line ends with "above" where a peak is
above the limit, and "far" where a forecast is off by more than 20 % of the peak with cold kernels.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time

SCENES = {
    # name: options of synth
    "3D 9 x 0.04 MP": "--views 9 --width 240 --height 160",
    "3D 17 x 0.3 MP": "--views 17 --width 640 --height 480",
    "3D 9 x 1 MP": "--views 9 --width 1152 --height 864",
    "3D 41 x 0.3 MP": "--views 41 --width 640 --height 480",
    "4D 25 x 0.04 MP": "--grid 5x5 --width 240 --height 160",
    "4D 25 x 0.3 MP": "--grid 5x5 --width 640 --height 480",
    "4D 25 x 1 MP": "--grid 5x5 --width 1152 --height 864",
    "posed 9 x 0.1 MP": "--path walk --views 9 --width 400 --height 300",
    "posed 15 x 0.5 MP": "--path walk --views 15 --width 800 --height 600",
}


class Lab:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder
        self.kernels = folder / "kernels"

    def scene(self, name):
        place = self.folder / re.sub(r"\W+", "_", name)
        if not place.exists():
            partial = place.with_suffix(".new")
            shutil.rmtree(partial, ignore_errors=True)
            self.run(["synth", "garden", "-o", partial, *SCENES[name].split()])
            partial.rename(place)
        return place

    def run(self, arguments, cold=False):
        """Peak resident MiB, seconds and the one line of an error (or None)."""
        if cold:
            shutil.rmtree(self.kernels, ignore_errors=True)
        environment = os.environ | {"GIGARAY_CACHE_DIR": str(self.kernels)}
        with tempfile.TemporaryFile("w+") as errors:
            begin = time.monotonic()
            child = subprocess.Popen([self.program, *map(str, arguments)], env=environment,
                                     stdout=subprocess.DEVNULL, stderr=errors)
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            errors.seek(0)
            last = (errors.read().splitlines() or [""])[-1]
        error = last if child.returncode else None
        return usage.ru_maxrss / 1024, time.monotonic() - begin, error


def line(*cells):
    print("| " + " | ".join(str(cell) for cell in cells) + " |", flush=True)


def row(name, limit, forecast, peaks, seconds, error):
    """peaks: cold, warm; MiB."""
    remarks = [error] if error else []
    if not error:
        known = [peak for peak in peaks if peak]
        if limit and max(known) > limit:
            remarks.append("above")
        if forecast and not 0.8 * known[0] <= forecast <= 1.2 * known[0]:
            remarks.append("far")
    line(name, f"{limit:.0f}" if limit else "default", f"{forecast:.0f}" if forecast else "",
         *(f"{peak:.0f}" if peak else "" for peak in peaks), f"{seconds:.1f}", ", ".join(remarks))


def least_limit(lab, arguments):
    """MiB that the refusal of a tiny limit names."""
    _, _, error = lab.run([*arguments, "--memory", 0.001])
    found = re.search(r"at least ([\d.]+) (MiB|GiB)", error or "")
    return float(found[1]) * (1024 if found[2] == "GiB" else 1) if found else None


def depth(lab, scenes, presets):
    for scene in scenes:
        for preset in presets:
            command = ["depth", lab.scene(scene), "-o", lab.folder / "depth", "--preset", preset]
            least = least_limit(lab, command)
            for limit in [None, least]:
                options = ["--memory", limit / 1024 + 1e-9] if limit else []
                cold, seconds, error = lab.run(command + options, cold=True)
                warm = forecast = None
                if not error:
                    warm, seconds, error = lab.run(command + options)
                    report = json.loads((lab.folder / "depth" / "gigaray.json").read_text())
                    forecast = report["forecast_memory_mib"]
                row(f"depth {preset} {scene}", limit, forecast, [cold, warm], seconds, error)


def others(lab, scenes, only):
    for scene in scenes:
        light_field = lab.scene(scene)
        result = lab.folder / ("result_" + light_field.name)
        if not result.exists():
            lab.run(["depth", light_field, "-o", result])
        to = lab.folder
        calls = {
            "encode": ["encode", light_field, "-o", to / "out.grl", "--depth", result],
            "cloud": ["cloud", result, "-o", to / "out.ply"],
            "mesh": ["mesh", result, "-o", to / "out_mesh.ply"],
            "mesh poisson": ["mesh", result, "-o", to / "out_mesh.ply", "--method", "poisson"],
            "mesh front": ["mesh", result, "-o", to / "out_mesh.ply", "--method", "front"],
            "render": ["render", result, "-o", to / "out_render", "--pose", "centre"],
            "refocus": ["render", result, "-o", to / "out_render", "--refocus", "0"],
            "evaluate": ["evaluate", result, light_field],
            "compare": ["compare", light_field, "-o", to / "out_compare"],
        }
        if "posed" in scene:
            del calls["evaluate"]
            calls["rectify"] = ["rectify", light_field / "images", "-o", to / "out_rail", "--poses",
                                "order"]
        for name, call in calls.items():
            if only and name.split()[0] not in only:
                continue
            for limit in [None, least_limit(lab, call)]:
                options = ["--memory", limit / 1024 + 1e-9] if limit else []
                cold = warm = None
                if name == "compare":
                    cold, seconds, error = lab.run(call + options, cold=True)
                if name != "compare" or not error:
                    warm, seconds, error = lab.run(call + options)
                row(f"{name} {scene}", limit, None, [cold, warm], seconds, error)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("-w", "--work", type=pathlib.Path, help="keeps light fields for next time")
    parser.add_argument("--scenes", help="part of the names of scenes", default="")
    parser.add_argument("--presets", default="auto,paper")
    parser.add_argument("--only", default="", help="depth, encode, cloud, …")
    options = parser.parse_args()
    program = options.program.resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder = (options.work or pathlib.Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        lab = Lab(program, folder)
        scenes = [name for name in SCENES if options.scenes in name]
        only = [name for name in options.only.split(",") if name]
        line("run", "limit, MiB", "forecast", "peak cold", "peak warm", "s", "")
        line(*["---"] * 7)
        if not only or "depth" in only:
            depth(lab, scenes, options.presets.split(","))
        if only != ["depth"]:
            others(lab, scenes, only)


if __name__ == "__main__":
    main()
