# SPDX-License-Identifier: MIT
"""Writes what the quality study found as one page: the text is page.md beside this file, in which {{NAME}} stands for a
table or a sentence with figures."""
import os
import pathlib
import re
import statistics

import tables
from bench import Refused, answered
from cells import FIGURES, ONE_PAIR_SECONDS

TEMPLATE = pathlib.Path(__file__).with_name("page.md")
MISSES_LISTED = 12


def processor():
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        text = ""
    model = re.search(r"^model name\s*: (.*)$", text, re.MULTILINE)
    return f"{len(os.sched_getaffinity(0))} cores of {model.group(1).strip() if model else 'an unknown processor'}"


def refusals(results):
    lines = [f"- {' '.join(item) if isinstance(item, tuple) else item}: {why}"
             for item, why in results.items() if isinstance(why, Refused)]
    return ["", "Refused:", "", *lines] if lines else []


def median_gap(results):
    return statistics.median(row["gap"] for row in answered(results).values()) if answered(results) else None


def together_summary(by_method):
    apart, together = median_gap(by_method["default"]), median_gap(by_method["together"])
    if apart is None or together is None:
        return "Learning all contents together was refused."
    return (f"Median gap of the models learnt from all contents together: {together:.3f}; of those learnt apart: "
            f"{apart:.3f}. The goal, no lower together than apart, is {'met' if together >= apart else 'not met'}.")


def one_pair_summary(by_method, warned, num_takes):
    one, all_takes = median_gap(by_method["one pair"]), median_gap(by_method["default"])
    if one is None or all_takes is None:
        return "Learning from one pair was refused."
    return (f"Median gap from one pair: {one:.2f}, from {num_takes} takes: {all_takes:.2f}. Learning from one pair warned of what "
            f"it cannot cover in {len(warned)} of {len(answered(by_method['one pair']))} cells.")


def judge_section(found):
    if not found["judge"]:
        return ["This page was made without one."]
    return tables.judge_table(found["cells"], found["judge"])


def options_by_method(options):
    return [f"- `{name}`: the same pairs, `strut learn {' '.join(words)}`" for name, words in options.items()]


def take_numbers(bench):
    """The takes that the text speaks of."""
    learnt, judged, retakes = bench.split.learnt, bench.split.judged, bench.split.retakes
    half = len(learnt) // 2

    def span(takes):
        return [f"{takes[0]:03d}-{takes[-1]:03d}"]
    return {"learnt": span(learnt), "judged": span(judged), "first_judged": [f"{judged[0]:03d}"],
            "retakes": [", ".join(f"{take:03d}" for take in retakes[:-1]) + f" and {retakes[-1]:03d}"],
            "first_half": span(learnt[:half]), "second_half": span(learnt[half:])}


def sections(found, bench, joints, method_options, seconds):
    """What every {{NAME}} of the template stands for."""
    methods, recognition = found["methods"], found["recognition"]
    return take_numbers(bench) | {
        "cells": tables.cells_table(found["cells"], FIGURES + tables.TIMES, with_misses=True),
        "cells_summary": [tables.gap_summary(found["cells"])],
        "goals": tables.goals_table(found["cells"]),
        "median_goal": [tables.median_goal(found["cells"])],
        "judge": judge_section(found),
        "method_options": options_by_method(method_options),
        "one_pair_seconds": ["{:g}-{:g} s".format(*ONE_PAIR_SECONDS)],
        "methods_summary": tables.methods_summary(methods["rows"]),
        "methods_gaps": tables.methods_gaps(methods["rows"]),
        "one_pair": [one_pair_summary(methods["rows"], methods["warned"], len(bench.split.learnt))],
        "together": [together_summary(methods["rows"])],
        "candidates": [str(recognition["candidates"])],
        "recognition": tables.recognition_table(recognition),
        "recognition_misses": tables.recognition_misses(recognition["translated"])[:MISSES_LISTED] + omitted(recognition),
        "joints": [", ".join(f"`{joint}`" for joint in joints)],
        "arm": [f"`{joints[0]}`"],
        "details": tables.details_table(found["details"]) + refusals(found["details"]),
        "details_summary": [tables.details_summary(found["details"])],
        "unfamiliar": tables.unfamiliar_table(found["unfamiliar"]) + refusals(found["unfamiliar"]),
        "tempi": tables.tempo_table(found["tempi"]),
        "tempi_summary": [tables.tempo_summary(found["tempi"])],
        "identities": tables.identity_table(found["identities"]),
        "version": [bench.version],
        "minutes": [f"{seconds / 60:.1f}"],
        "processor": [processor()],
    }


def omitted(recognition):
    more = len(tables.recognition_misses(recognition["translated"])) - MISSES_LISTED
    return [f"- and {more} more"] if more > 0 else []


def filled(template, parts):
    """The template with every {{NAME}} replaced; KeyError for one that nothing stands for."""
    return re.sub(r"\{\{(\w+)\}\}", lambda name: "\n".join(parts[name.group(1)]), template)


def write(path, found, bench, joints, method_options, seconds):
    parts = sections(found, bench, joints, method_options, seconds)
    path.write_text(filled(TEMPLATE.read_text(encoding="utf-8"), parts), encoding="utf-8")
