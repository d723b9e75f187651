# SPDX-License-Identifier: MIT
"""The cells of the quality table, one content (say, walk) in one style each: learnt, translated and measured.

A cell's style is learnt by several methods; all are held against the same takes.
"""
import dataclasses
import json
import re
import statistics
import tomllib

from bench import INPUT_STYLE, Refused, answered, run

CONTENTS = ["walk", "walk-turn-left", "walk-turn-right", "run",
            "wave-left-hand", "wave-both-hands", "raise-up-right-hand"]
STYLES = ["elderly", "active", "feminine"]
ALL_CELLS = [(content, style) for content in CONTENTS for style in STYLES]
LEAST_TRAVEL = 1.0  # metres in every real take, for cadence and speed to mean something
FIGURES = ["identity", "retake", "translated", "gap", "cadence", "speed", "foot", "foot_real", "jerk"]
ONE_PAIR_SECONDS = (2.0, 3.0)  # what one pair should last
ALL_NEIGHBOURS = 100           # more than any cell has: every pair that can be made


@dataclasses.dataclass(frozen=True)
class Reference:
    """What a cell's clips are held against."""
    real: list
    retakes: list
    retake_cm: float
    travels: bool
    means: dict  # over real takes and retakes, by key of strut measure


@dataclasses.dataclass(frozen=True)
class Learnt:
    """A model, what it made of the cell's input clips, and seconds per learning and per clip."""
    model: object
    inputs: list
    translated: list
    learn: float
    translate: float
    warned: bool


def mean(report, key):
    return statistics.fmean(clip[key] for clip in report["clips"])


def reference(bench, cell):
    real, retakes = bench.takes(*cell, bench.split.judged), bench.takes(*cell, bench.split.retakes)
    of_real, of_retakes = bench.measure(real), bench.measure(retakes, real)
    of_style = {"clips": of_real["clips"] + of_retakes["clips"]}
    keys = ("cadence_per_s", "speed_m_per_s", "foot_slide_cm_per_s", "jerk_m_per_s3")
    return Reference(real, retakes, of_retakes["distance_cm"],
                     min(clip["travel_m"] for clip in of_real["clips"]) > LEAST_TRAVEL,
                     {key: mean(of_style, key) for key in keys})


def figures(bench, held_against, inputs, translated):
    """One row of the table, by strut measure."""
    of_translated = bench.measure(translated, held_against.real)
    row = {"identity": bench.measure(inputs, held_against.real)["distance_cm"], "retake": held_against.retake_cm,
           "translated": of_translated["distance_cm"]}
    row["gap"] = (row["identity"] - row["translated"]) / (row["identity"] - row["retake"])

    def ratio(key):
        return mean(of_translated, key) / held_against.means[key] if held_against.means[key] > 0 else None
    row["cadence"] = ratio("cadence_per_s") if held_against.travels else None
    row["speed"] = ratio("speed_m_per_s") if held_against.travels else None
    row["foot"] = mean(of_translated, "foot_slide_cm_per_s")
    row["foot_real"] = held_against.means["foot_slide_cm_per_s"]
    row["jerk"] = ratio("jerk_m_per_s3")
    return row


# ---- methods --------------------------------------------------------------------------------------------------------

def cell_pairs(bench, cell):
    """The cell's pair list, made once."""
    content, style = cell
    pairs = bench.make_folder(f"{content}_{style}") / "pairs.toml"
    if not pairs.exists():
        bench.pair(bench.takes(content, INPUT_STYLE, bench.split.learnt), bench.takes(*cell, bench.split.learnt), pairs)
    return pairs


def translate_cell(bench, cell, method, model, learning):
    inputs = bench.takes(cell[0], INPUT_STYLE, bench.split.judged)
    folder = bench.make_folder("_".join(cell), method)
    translated, seconds = bench.translate(model, inputs, folder)
    return Learnt(model, inputs, translated, learning.seconds, seconds, "warning:" in learning.err)


def learn_cell(bench, cell, method="default", options=()):
    """From the cell's pairs."""
    model = bench.make_folder("_".join(cell), method) / "style.strut"
    learning = bench.learn(cell_pairs(bench, cell), model, *options)
    return translate_cell(bench, cell, method, model, learning)


def learn_from_one_pair(bench, cell):
    folder = bench.make_folder("_".join(cell), "one pair")
    every_pair, pairs, model = folder / "every_pair.toml", folder / "pairs.toml", folder / "style.strut"
    bench.pair(bench.takes(cell[0], INPUT_STYLE, bench.split.learnt), bench.takes(*cell, bench.split.learnt), every_pair,
               "--neighbours", ALL_NEIGHBOURS)
    write_pair(closest_pair(bench, every_pair), pairs)
    return translate_cell(bench, cell, "one pair", model, bench.learn(pairs, model))


def learn_together(bench, cells):
    """One model per style from the pairs of all its cells: results by cell."""
    lists = bench.each(lambda cell: cell_pairs(bench, cell), cells)
    results = {cell: why for cell, why in lists.items() if isinstance(why, Refused)}
    for style in dict.fromkeys(style for _, style in answered(lists)):
        own = {cell: pairs for cell, pairs in answered(lists).items() if cell[1] == style}
        model = bench.make_folder(f"all_{style}") / "style.strut"
        try:
            learning = bench.learn(together(bench, style, list(own.values())), model)
        except Refused as why:
            results |= {cell: why for cell in own}
            continue
        results |= bench.each(lambda cell: translate_cell(bench, cell, "together", model, learning), list(own))
    return {cell: results[cell] for cell in cells}


def together(bench, style, lists):
    """The pair lists in one."""
    joined = bench.make_folder(f"all_{style}") / "pairs.toml"
    for path in lists:
        for entry in read_pairs(path):
            write_pair(entry, joined)
    return joined


# ---- pairs ----------------------------------------------------------------------------------------------------------

def read_pairs(path):
    """The pairs of a list that strut pair wrote, each with the distance it tells in the comment above the pair."""
    text = path.read_text(encoding="utf-8")
    pairs = tomllib.loads(text)["pair"]
    distances = re.findall(r"^#.*distance ([\d.]+)$", text, re.MULTILINE)
    if len(distances) != len(pairs):
        raise Refused(f"{path.name} tells {len(distances)} distances of {len(pairs)} pairs")
    for entry, distance in zip(pairs, distances):
        entry["distance"] = float(distance)
        for side in ("input", "output"):
            entry[side] = str((path.parent / entry[side]).resolve())
    return pairs


def write_pair(entry, path):
    """Adds a pair to a list."""
    with open(path, "a", encoding="utf-8") as stream:
        stream.write(f'[[pair]]\ninput = "{entry["input"]}"\noutput = "{entry["output"]}"\n'
                     f'input_frames = {entry["input_frames"]}\noutput_frames = {entry["output_frames"]}\n')


def chains(pairs, most_frames):
    """Every pair, and every run of pairs that follow each other without a gap in both clips, as one pair each."""
    following = {(p["input"], p["output"], p["input_frames"][0], p["output_frames"][0]): p for p in pairs}
    for first in pairs:
        links = [first]
        while links:
            last = links[-1]
            yield first | {"input_frames": [first["input_frames"][0], last["input_frames"][1]],
                           "output_frames": [first["output_frames"][0], last["output_frames"][1]],
                           "distance": statistics.fmean(link["distance"] for link in links)}
            link = following.get((last["input"], last["output"], last["input_frames"][1], last["output_frames"][1]))
            links = links + [link] if link and link["input_frames"][1] - first["input_frames"][0] <= most_frames else []


def closest_pair(bench, path):
    """Of all pairs that last 2-3 s in the input style, the two stretches most alike to strut pair: one clip each, in
    which gait cycles follow each other. Where nothing lasts 2-3 s, of what lasts nearest to it."""
    pairs = read_pairs(path)
    rate = bench.measure([pairs[0]["input"]])["clips"][0]["frame_rate"]
    least, most = (seconds * rate for seconds in ONE_PAIR_SECONDS)

    def badness(pair):
        frames = pair["input_frames"][1] - pair["input_frames"][0]
        return max(least - frames, frames - most, 0), pair["distance"]
    return min(chains(pairs, most), key=badness)


# ---- an independent judge -------------------------------------------------------------------------------------------

def judged(judge, held_against, learnt):
    """The row by another program, called as JUDGE --json --input F... --real F... --retake F... --translated F..."""
    interpreter = ["/usr/bin/python3"] if judge.suffix == ".py" else []
    return json.loads(run("judge", [*interpreter, judge, "--json", "--input", *learnt.inputs, "--real",
                                    *held_against.real, "--retake", *held_against.retakes, "--translated",
                                    *learnt.translated]).out)


def rows(bench, references, learnt):
    """The table's row of every cell that was translated, the Refused of the others."""
    def row(cell):
        for needed in (references[cell], learnt[cell]):
            if isinstance(needed, Refused):
                return needed
        of_cell = learnt[cell]
        return figures(bench, references[cell], of_cell.inputs, of_cell.translated) | {
            "learn": of_cell.learn, "translate": of_cell.translate}
    return bench.each(row, list(learnt))


def recorded_again(bench, references):
    """Rows of real takes of the style, learnt takes other than the retakes, in the place of translated clips."""
    numbers = [take for take in bench.split.learnt if take not in bench.split.retakes][:len(bench.split.judged)]

    def row(cell):
        if isinstance(references[cell], Refused):
            return references[cell]
        inputs = bench.takes(cell[0], INPUT_STYLE, bench.split.judged)
        return figures(bench, references[cell], inputs, bench.takes(*cell, numbers))
    return bench.each(row, list(references))


def judge_rows(bench, judge, references, learnt):
    return bench.each(lambda cell: judged(judge, references[cell], learnt[cell]),
                      [cell for cell in answered(learnt) if not isinstance(references[cell], Refused)])
