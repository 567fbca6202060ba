# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Gigaray authors
"""Markdown of the figures that the score_… programs write as JSON."""

import statistics

METRICS = ["BadPix0.07", "BadPix0.03", "BadPix0.01", "MSEx100", "filled"]
AVERAGED = [*METRICS, "seconds", "peak_memory_mib"]


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def markdown(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def cell(value):
    if value is None:
        return ""
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def of_rows(rows):
    """A table of dictionaries, with a column for every key of any."""
    head = list(dict.fromkeys(key for row in rows for key in row))
    return markdown(head, [[cell(row.get(key)) for key in head] for row in rows])


def means(rows):
    """One row per variant and method of several scenes: the mean over them."""
    result = []
    for variant, preset in dict.fromkeys((row["variant"], row["preset"]) for row in rows):
        own = [row for row in rows if (row["variant"], row["preset"]) == (variant, preset)]
        if len(own) < 2:
            continue
        mean = {**own[0], "scene": f"mean of {len(own)}", "views": "", "size": ""}
        for key in AVERAGED:
            values = [row[key] for row in own if row[key] is not None]
            mean[key] = statistics.fmean(values) if values else None
        result.append(mean)
    return result


def scores(rows):
    head = ["scene", "variant", "method", "views", "computed", "size", *METRICS, "seconds",
            "peak MiB"]
    return markdown(head, [
        [row["scene"], row["variant"], row["preset"], str(row["views"]), row["computed"],
         row["size"], *[number(row[metric]) for metric in METRICS], number(row["seconds"], 1),
         number(row["peak_memory_mib"], 0)] for row in rows])


def reliability(entries):
    """Bins that no row has a pixel in are left out."""
    bins = [i for i in range(len(entries[0]["bins"]))
            if any(entry["bins"][i]["pixels"] for entry in entries)]

    def label(row):
        return f"{row['from']:g} – " + ("" if row["to"] is None else f"{row['to']:g}")

    def cell(entry, row):
        if not row["pixels"]:
            return "-"
        share = 100 * row["pixels"] / sum(other["pixels"] for other in entry["bins"])
        return f"{row['right']:.1f} ({share:.0f})"

    head = ["scene", "variant", "method", "off by",
            *[label(entries[0]["bins"][i]) for i in bins]]
    rows = [[entry["scene"], entry["variant"], entry["preset"],
             number(entry["calibration_error"], 1),
             *[cell(entry, entry["bins"][i]) for i in bins]] for entry in entries]
    title = ("% of pixels within 0.07 px of the truth by their confidence, in brackets the % of "
             "all pixels; off by: mean distance of the two in percent")
    return title + "\n\n" + markdown(head, rows)


def consistency(entries):
    head = ["scene", "variant", "method", "views", "pairs", "% agree within 0.1 px", "seen by both",
            "centre BadPix0.07", "all views", "worst view", "seconds"]
    return markdown(head, [
        [entry["scene"], entry["variant"], entry["preset"], str(entry["views"]),
         str(entry["pairs"]), number(entry["agree"]), entry["visibility"],
         number(entry["centre_bad"]), number(entry["mean_bad"]), number(entry["worst_bad"]),
         number(entry["seconds"], 1)] for entry in entries])


def report(root):
    """All tables of the JSON of score_folder."""
    rows = root["rows"]
    parts = [scores(rows + means(rows))]
    if "sgbm" in root:
        parts.append("SGBM: " + root["sgbm"] + ".")
    if "reliability" in root:
        parts.append(reliability(root["reliability"]))
    if "consistency" in root:
        parts.append(consistency(root["consistency"]))
    return "\n\n".join(parts)
