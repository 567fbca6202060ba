#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Files reports of the benchmark programs under results/DEVICE/ and renews the tables of README.md.

    report.py kernels.json end_to_end.json [--accuracy accuracy.json]
    report.py compared/*/compare.json experiments/*/results.json

The inputs are what --benchmark_out=FILE of the programs, --json FILE of accuracy/score_folder,
`gigaray compare` and gigaray_experiments write. Of several reports of the same program, the one with the higher figures was the less disturbed:
run again when the machine was busy, and file that. Names of hosts and paths are left out.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "accuracy"))
import tables  # noqa: E402

AGGREGATES = ["min", "median", "max", "mean", "stddev", "cv"]
KEPT_CONTEXT = ["date", "num_cpus", "mhz_per_cpu", "load_avg", "gigaray_version", "device",
                "device_type", "compute_units", "platform", "driver"]
SCORES = ("density_score", "robust_score")
NOT_FIGURES = {"name", "family_index", "per_family_instance_index", "run_name", "run_type",
               "repetitions", "repetition_index", "threads", "aggregate_name", "aggregate_unit",
               "iterations", "time_unit"}


def device_folder(name):
    """A device's name as a folder: letters, digits and dashes."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def commit():
    done = subprocess.run(["git", "-C", HERE, "rev-parse", "--short", "HEAD"], capture_output=True,
                          text=True)
    return done.stdout.strip() or None


def condensed(report):
    """Benchmarks by name: {figure: {aggregate: value}}; spread is the coefficient of variation."""
    context = {key: report["context"][key] for key in KEPT_CONTEXT if key in report["context"]}
    benchmarks = {}
    for entry in report["benchmarks"]:
        name = re.sub(r"/(iterations:\d+|repeats:\d+|process_time|real_time)", "", entry["run_name"])
        figures = benchmarks.setdefault(name, {"time_unit": entry.get("time_unit", "")})
        for key, value in entry.items():
            if key not in NOT_FIGURES:
                figures.setdefault(key, {})[entry.get("aggregate_name", "value")] = value
    return {"commit": commit(), **context, "benchmarks": benchmarks}


def value(figures, key, aggregate, digits):
    number = figures.get(key, {}).get(aggregate)
    return "" if number is None else f"{number:.{digits}f}"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def score_table(report):
    rate, share = "G sample-iterations/s", "share of FMA limit"
    rows = []
    for name, f in report["benchmarks"].items():
        if not name.startswith(SCORES):
            continue
        rows.append([name.partition("/")[2], value(f, rate, "max", 2),
                     value(f, rate, "median", 2), value(f, "G FMA/s before", "max", 0),
                     value(f, "G FMA/s before", "median", 0), value(f, share, "max", 2),
                     value(f, share, "median", 2)])
    return table(["density score", "best, 10⁹/s", "median", "FMA limit, best, 10⁹/s", "median",
                  "share of the limit, best", "median"], rows)


def step_table(report):
    rows = []
    for name, f in report["benchmarks"].items():
        if name.startswith(SCORES):
            continue
        rows.append([name, value(f, "M/s", "max", 1), value(f, "M/s", "median", 1),
                     value(f, "GB/s", "max", 2), value(f, "copy GB/s", "median", 1)])
    return table(["kernel / preset / what is counted", "best, 10⁶/s", "median", "GB/s", "copy GB/s"],
                 rows)


def end_to_end_table(report):
    stages = ["decode", "load", "edges", "score", "support", "winner", "median", "radiance",
              "propagate", "downsample", "bounds", "fill"]
    rows = []
    for name, f in report["benchmarks"].items():
        parts = [f"{stage} {value(f, stage, 'median', 2)}" for stage in stages
                 if f.get(stage, {}).get("median", 0) >= 0.005]
        rows.append([name, value(f, "real_time", "min", 2), value(f, "real_time", "median", 2),
                     value(f, "cpu_time", "min", 2), value(f, "BadPix0.07", "median", 1),
                     ", ".join(parts)])
    return table(["job", "best, s", "median, s", "CPU seconds, best", "BadPix0.07",
                  "seconds per stage, median"], rows)


def renew(readme, marker, text):
    begin, end = f"<!-- {marker} -->", f"<!-- end of {marker} -->"
    before, rest = readme.split(begin)
    after = rest.split(end)[1]
    return f"{before}{begin}\n{text}\n{end}{after}"


def folder_of(device):
    """Of the engine's name: opencl: NAME (PLATFORM)."""
    return HERE / "results" / device_folder(re.sub(r"^\w+: | \(.*\)$", "", device or "unknown"))


def file_comparison(report):
    """results/DEVICE/compare/SCENE.json: no maps, no paths."""
    scene = pathlib.PurePath(report["input"]).name
    report = {"commit": commit(), **report, "input": scene}
    if report["truth"]:
        report["truth"] = pathlib.PurePath(report["truth"]).name
    folder = folder_of(report["device"]) / "compare"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{scene}.json").write_text(json.dumps(report, indent=1) + "\n")
    return folder


def file_experiment(report):
    folder = folder_of(report["device"]) / "experiments"
    folder.mkdir(parents=True, exist_ok=True)
    name = f"{report['experiment']}-{report['rows'][0]['scene']}.json"
    (folder / name).write_text(json.dumps({"commit": commit(), **report}, indent=1) + "\n")
    return folder


def score(method, name, digits=2):
    number = method["scores"].get(name)
    return "–" if number is None else f"{number:.{digits}f}"


def comparison_tables(folder):
    """Light fields with truth, without, stereo pairs: a table each, methods as rows."""
    reports = [json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))]
    kinds = [("BadPix 0.07 (near jumps)", lambda r: r["truth"] and r["num_views"] > 2,
              lambda m: f"{score(m, 'BadPix0.07')} ({score(m, 'NearJumps', 1)})"),
             ("photo-consistency", lambda r: not r["truth"],
              lambda m: score(m, "PhotoConsistency")),
             ("bad 1 px (seen by both), %", lambda r: r["truth"] and r["num_views"] == 2,
              lambda m: f"{score(m, 'bad1.0', 1)} ({score(m, 'nonocc.bad1.0', 1)})")]
    parts = []
    for heading, belongs, cell in kinds:
        own = [report for report in reports if belongs(report)]
        titles = list(dict.fromkeys(m["title"] for report in own for m in report["methods"]))
        rows = []
        for title in titles:
            row = [title]
            for report in own:
                found = [m for m in report["methods"] if m["title"] == title]
                row.append(f"{cell(found[0])}, {found[0]['seconds']:.2f} s" if found else "–")
            rows.append(row)
        if own:
            parts.append(table([heading] + [report["input"] for report in own], rows))
    return "\n\n".join(parts)


def experiment_tables(folder):
    parts = []
    for path in sorted(folder.glob("*.json")):
        report = json.loads(path.read_text())
        rows = [[row["label"].replace("_", " "), str(row["views"]), f"{row['BadPix0.07']:.2f}",
                 f"{row['MSEx100']:.2f}", f"{row['NearJumps']:.2f}", f"{100 * row['SAD']:.2f}",
                 f"{row['seconds']:.2f}", f"{row['memory_mib']:.0f}"] for row in report["rows"]]
        parts.append(f"`{report['experiment']}`, {report['rows'][0]['scene']}: "
                     f"{report['question']}.\n\n" +
                     table(["", "views", "BadPix 0.07", "MSE × 100", "near jumps",
                            "mean error, % of the range", "s", "MiB"], rows))
    return "\n\n".join(parts)


def caption(report):
    return (f"{report['device']}, {report['compute_units']} compute units, driver "
            f"{report['driver']}; version {report['gigaray_version']}, commit {report['commit']}, "
            f"{report['date'][:10]}.")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("reports", nargs="*", type=pathlib.Path)
    parser.add_argument("--accuracy", type=pathlib.Path)
    arguments = parser.parse_args()

    readme = (HERE / "README.md").read_text()
    folder = None
    for path in arguments.reports:
        report = json.loads(path.read_text())
        if report.get("format") == "gigaray compare":
            text = comparison_tables(file_comparison(report))
            readme = renew(readme, "comparisons", text)
            continue
        if report.get("format") == "gigaray experiment":
            readme = renew(readme, "experiments", experiment_tables(file_experiment(report)))
            continue
        report = condensed(report)
        is_kernels = any(name.startswith("density_score") for name in report["benchmarks"])
        folder = HERE / "results" / device_folder(report["device"])
        folder.mkdir(parents=True, exist_ok=True)
        name = "kernels.json" if is_kernels else "end_to_end.json"
        (folder / name).write_text(json.dumps(report, indent=1) + "\n")
        if is_kernels:
            readme = renew(readme, "density score", caption(report) + "\n\n" + score_table(report))
            readme = renew(readme, "other kernels", step_table(report))
        else:
            readme = renew(readme, "end to end", caption(report) + "\n\n" + end_to_end_table(report))
    if arguments.accuracy:
        report = json.loads(arguments.accuracy.read_text())
        folder = folder or HERE / "results"
        (folder / "accuracy.json").write_text(json.dumps(report, indent=1) + "\n")
        readme = renew(readme, "accuracy", tables.report(report))
    (HERE / "README.md").write_text(readme)


if __name__ == "__main__":
    main()
