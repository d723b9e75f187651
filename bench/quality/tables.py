# SPDX-License-Identifier: MIT
"""What the quality study found, as lines of Markdown; and which goals hold."""
import statistics

from bench import Refused, answered
from cells import FIGURES
from other_inputs import TEMPI

LEAST_GAP, MEDIAN_GAP = 1.0, 1.15
RATIO = (0.95, 1.05)  # of cadence and speed
JERK = (0.85, 1.15)
FOOT_ABOVE_REAL = 1.0  # cm/s
LEARN_SECONDS = 2.0
LEAST_SHARE, LEAST_CORRELATION = 0.9, 0.9  # of details
MOST_JERK = 1.2  # of an unfamiliar input's
MOST_APART = 1.1  # of how far a familiar input is moved; the tenth is for the frames being others
JUDGE_TOLERANCE = 0.01
TIMES = ["learn", "translate"]
COMPACT = ["gap", "cadence", "speed", "foot", "jerk", "learn"]
WORST_LISTED = 3


def outside(value, bounds):
    return 0.0 if value is None else max(bounds[0] - value, value - bounds[1])


# By figure: the goal, and by how much a row misses it; nothing or less where it holds.
GOALS = {"gap": ("at least 1.0", lambda row: LEAST_GAP - row["gap"]),
         "cadence": ("0.95 to 1.05", lambda row: outside(row["cadence"], RATIO)),
         "speed": ("0.95 to 1.05", lambda row: outside(row["speed"], RATIO)),
         "foot": ("at most foot_real + 1", lambda row: row["foot"] - row["foot_real"] - FOOT_ABOVE_REAL),
         "jerk": ("0.85 to 1.15", lambda row: outside(row["jerk"], JERK)),
         "learn": ("under 2 s", lambda row: row["learn"] - LEARN_SECONDS)}


def holds(figure, row):
    return GOALS[figure][1](row) <= 0.0


def shown(value, decimals=2):
    return "-" if value is None else f"{value:.{decimals}f}"


def percent(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else "0 of 0"


def markdown(header, lines):
    """A table whose first column is text and whose others are figures."""
    return ["| " + " | ".join(header) + " |", "| --- |" + " ---: |" * (len(header) - 1),
            *("| " + " | ".join(line) + " |" for line in lines)]


def gap_summary(results):
    gaps = [row["gap"] for row in answered(results).values()]
    if not gaps:
        return f"No cell of {len(results)} was translated."
    return (f"{len(gaps)} of {len(results)} cells translated; gap: median {statistics.median(gaps):.2f}, "
            f"lowest {min(gaps):.2f}, at least 1.0 in {sum(gap >= LEAST_GAP for gap in gaps)}.")


# ---- the cells ------------------------------------------------------------------------------------------------------

def misses(row):
    """The figures that fall short of their goal."""
    return [figure for figure in GOALS if not holds(figure, row)]


def cells_table(results, columns, with_misses=False):
    lines = []
    for cell, row in results.items():
        if isinstance(row, Refused):
            lines.append([" ".join(cell), str(row)] + [""] * (len(columns) - 1 + with_misses))
            continue
        lines.append([" ".join(cell), *(shown(row[column]) for column in columns)] +
                     ([", ".join(misses(row)) or "none"] if with_misses else []))
    return markdown(["cell", *columns] + (["short of the goal"] if with_misses else []), lines)


def goals_table(results):
    """For each goal, in how many cells it holds, and those that miss it by the most."""
    lines = []
    for figure, (goal, shortfall) in GOALS.items():
        rows = {cell: row for cell, row in answered(results).items() if row[figure] is not None}
        short = sorted((cell for cell, row in rows.items() if not holds(figure, row)),
                       key=lambda cell: -shortfall(rows[cell]))
        worst = ", ".join(f"{' '.join(cell)} {shown(rows[cell][figure])}" for cell in short[:WORST_LISTED])
        lines.append([f"{figure} {goal}", f"{len(rows) - len(short)} of {len(rows)}", worst or "-"])
    return markdown(["goal", "holds in", "farthest from it"], lines)


def median_goal(results):
    gaps = [row["gap"] for row in answered(results).values()]
    met = gaps and statistics.median(gaps) >= MEDIAN_GAP
    return f"The goal for the median gap, {MEDIAN_GAP}, is {'met' if met else 'not met'}."


def column_summaries(results, columns):
    """A line each for mean, median, lowest and highest of every column."""
    lines = []
    for name, reduce in (("mean", statistics.fmean), ("median", statistics.median), ("lowest", min), ("highest", max)):
        known = [[row[column] for row in answered(results).values() if row[column] is not None] for column in columns]
        lines.append([f"**{name}**", *(shown(reduce(column) if column else None) for column in known)])
    return lines


def compact_table(results):
    table = cells_table(results, COMPACT)
    return table + ["| " + " | ".join(line) + " |" for line in column_summaries(results, COMPACT)]


# ---- methods --------------------------------------------------------------------------------------------------------

def methods_gaps(by_method):
    """The gap in every cell, a column per method."""
    cells = list(by_method["default"])

    def gap(results, cell):
        return "refused" if isinstance(results[cell], Refused) else shown(results[cell]["gap"])
    return markdown(["cell", *by_method],
                    [[" ".join(cell), *(gap(results, cell) for results in by_method.values())] for cell in cells])


def methods_summary(by_method):
    lines = []
    for name, results in by_method.items():
        rows = list(answered(results).values())
        if not rows:
            lines.append([name, "none"] + ["-"] * 8)
            continue
        gaps = [row["gap"] for row in rows]

        def count(figure):
            measured = [row for row in rows if row[figure] is not None]
            return f"{sum(holds(figure, row) for row in measured)} of {len(measured)}"
        lines.append([name, str(len(rows)), shown(statistics.median(gaps)), shown(min(gaps)),
                      *(count(figure) for figure in ("gap", "cadence", "speed", "foot", "jerk")),
                      shown(statistics.fmean(row["learn"] for row in rows) if "learn" in rows[0] else None)])
    return markdown(["method", "cells", "gap: median", "lowest", "gap holds", "cadence holds", "speed holds",
                     "foot holds", "jerk holds", "learn"], lines)


# ---- recognition ----------------------------------------------------------------------------------------------------

def recognition_table(found):
    lines = []
    for name, clips in (("translated clips", found["translated"]), ("real takes", found["real"])):
        count = len(clips)
        lines.append([name, percent(sum(clip.right_style for clip in clips), count),
                      percent(sum(clip.right_content for clip in clips), count),
                      percent(sum(clip.right_style and clip.right_content for clip in clips), count)])
    return markdown(["", "right style", "right content", "both"], lines)


def recognition_misses(clips):
    wrong = [clip for clip in clips if not (clip.right_style and clip.right_content)]
    return [f"- `{clip.clip}`: nearest to {clip.nearest_content} {clip.nearest_style}, should be "
            f"{clip.content} {clip.style}" for clip in wrong] or ["- none"]


# ---- other inputs ---------------------------------------------------------------------------------------------------

def details_table(found):
    by_detail = {}
    for responses in answered(found).values():
        for detail, response in responses.items():
            by_detail.setdefault(detail, []).append(response)
    return markdown(["joint", "movement added", "clips", "share: median", "lowest", "correlation: median", "lowest",
                     "gain: median", "both goals hold"],
                    [[joint, name, *details_line(responses)] for (joint, name), responses in by_detail.items()])


def detail_holds(response):
    return response["share"] >= LEAST_SHARE and response["correlation"] >= LEAST_CORRELATION


def details_line(responses):
    shares, correlations = ([response[key] for response in responses] for key in ("share", "correlation"))
    return [str(len(responses)), shown(statistics.median(shares)), shown(min(shares)),
            shown(statistics.median(correlations)), shown(min(correlations)),
            shown(statistics.median(response["gain"] for response in responses)),
            f"{sum(map(detail_holds, responses))} of {len(responses)}"]


def details_summary(found):
    responses = [response for of_cell in answered(found).values() for response in of_cell.values()]
    share = sum(response["share"] >= LEAST_SHARE for response in responses)
    correlation = sum(response["correlation"] >= LEAST_CORRELATION for response in responses)
    return (f"At least 90 % of the energy stays in the joint in {percent(share, len(responses))}; it follows with a "
            f"correlation of at least 0.9 in {percent(correlation, len(responses))}; both in "
            f"{percent(sum(map(detail_holds, responses)), len(responses))}.")


def unfamiliar_table(found):
    by_name = {}
    for answers in answered(found).values():
        for name, answer in answers.items():
            by_name.setdefault(name, []).append(answer)
    lines = []
    for name, answers in by_name.items():
        finite = [answer for answer in answers if answer]
        jerks, apart = ([answer[key] for answer in finite if key in answer] for key in ("jerk", "relative"))
        lines.append([name, f"{len(finite)} of {len(answers)}", *extremes(jerks, lambda jerk: jerk <= MOST_JERK),
                      *extremes(apart, lambda relative: relative <= MOST_APART)])
    return markdown(["input", "finite", "jerk: median", "highest", "at most 1.2", "distance: median", "highest",
                     "at most 1.1"], lines)


def extremes(values, is_met):
    if not values:
        return ["-", "-", "-"]
    return [shown(statistics.median(values)), shown(max(values)), f"{sum(map(is_met, values))} of {len(values)}"]


def tempo_table(found):
    return markdown(["cell", *(f"{factor:g} times as long" for factor in TEMPI)],
                    [[" ".join(cell), *([str(gaps)] + [""] * (len(TEMPI) - 1) if isinstance(gaps, Refused) else
                                        [shown(gaps[factor]) for factor in TEMPI])] for cell, gaps in found.items()])


def tempo_summary(found):
    drops = [gaps[1.0] - gaps[factor] for gaps in answered(found).values() for factor in TEMPI if factor != 1.0]
    if not drops:
        return "No cell was translated."
    return (f"Against its own tempo the gap falls by {statistics.median(drops):.2f} in the median and by "
            f"{max(drops):.2f} at most.")


def identity_table(found):
    lines = []
    for content, row in found.items():
        lines.append([content, str(row), "", ""] if isinstance(row, Refused) else
                     [content, shown(row["moved"]), shown(row["takes"]), "yes" if row["moved"] <= row["takes"] else "no"])
    return markdown(["content", "moved by", "two takes", "within"], lines)


# ---- an independent judge -------------------------------------------------------------------------------------------

def judge_table(by_strut, by_judge):
    """Of every figure, the largest relative difference, and where."""
    lines = []
    for figure in FIGURES:
        differences = {}
        for cell, row in answered(by_judge).items():
            mine, theirs = answered(by_strut).get(cell, {}).get(figure), row.get(figure)
            if mine is not None and theirs:
                differences[cell] = abs(mine - theirs) / abs(theirs)
        if differences:
            worst = max(differences, key=differences.get)
            largest = differences[worst]
            lines.append([figure, f"{100 * largest:.4f} %", " ".join(worst), "yes" if largest <= JUDGE_TOLERANCE else "no"])
    return markdown(["figure", "largest difference", "in", "within 1 %"], lines)
