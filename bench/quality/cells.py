# SPDX-License-Identifier: MIT
"""Cells of the quality table: which takes they are made of, and learning, translating and measuring one by the program.

A cell is one content (say, walk) in one style. A split says which takes are learnt from, which are translated and which
the results are held against; takes learnt from are never judged.
"""
import concurrent.futures
import dataclasses
import json
import statistics
import subprocess
import time

CONTENTS = ["walk", "walk-turn-left", "walk-turn-right", "run",
            "wave-left-hand", "wave-both-hands", "raise-up-right-hand"]
STYLES = ["elderly", "active", "feminine"]
INPUT_STYLE = "normal"
ALL_CELLS = [(content, style) for content in CONTENTS for style in STYLES]
LEAST_TRAVEL = 1.0  # metres in every real take, for cadence and speed to mean something
FIGURES = ["identity", "retake", "translated", "gap", "cadence", "speed", "foot", "foot_real", "jerk"]
TIMES = ["learn", "translate"]


@dataclasses.dataclass(frozen=True)
class Split:
    learnt: tuple   # takes of both styles that are learnt from
    judged: tuple   # takes of the input style that are translated, of the style that the results are held against
    retakes: tuple  # takes of the style that stand for recording once more


# Settings are chosen on the validation split alone: it leaves the takes that the test split judges untouched.
SPLITS = {"test": Split(tuple(range(1, 13)), tuple(range(13, 18)), (1, 5, 9)),
          "validation": Split(tuple(range(1, 9)), tuple(range(9, 13)), (1, 4, 7))}


class Refused(Exception):
    """A step failed: which one, and the last line it said."""


def run(step, command):
    """Standard output of a command and the seconds it took."""
    begin = time.monotonic()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    seconds = time.monotonic() - begin
    if done.returncode != 0:
        said = [line for line in done.stderr.splitlines() if line.strip() and not line.startswith("hint:")]
        raise Refused(f"{step} ended with exit code {done.returncode}: {said[-1] if said else 'no message'}")
    return done.stdout, seconds


def takes(args, content, style, numbers):
    """The clips of a content and style that exist."""
    names = [args.data / args.pattern.format(content=content, style=style, take=take) for take in numbers]
    found = [name for name in names if name.exists()]
    if not found:
        raise Refused(f"there is no file like {names[0]}")
    return found


def measure(args, clips, against=()):
    command = [args.strut, "measure", *clips, "--json"] + (["--against", *against] if against else [])
    return json.loads(run("measure", command)[0])


def mean(report, key):
    return statistics.fmean(clip[key] for clip in report["clips"])


def translate(args, model, inputs, folder):
    """The translated files and the mean seconds per clip."""
    translated, seconds = [], []
    for clip in inputs:
        translated.append(folder / f"translated_{clip.name}")
        command = [args.strut, "translate", model, clip, "-o", translated[-1], *args.translate_options]
        seconds.append(run("translate", command)[1])
    return translated, statistics.fmean(seconds)


def pair(args, inputs, outputs, pairs):
    run("pair", [args.strut, "pair", "--input", *inputs, "--output", *outputs, "-o", pairs, *args.pair_options])


def learn(args, pairs, model, options=()):
    """Seconds it took."""
    return run("learn", [args.strut, "learn", pairs, "-o", model, *args.learn_options, *options])[1]


def figures(args, inputs, real, retakes, translated):
    """One row of the table, by strut measure."""
    of_inputs, of_retakes = measure(args, inputs, real), measure(args, retakes, real)
    of_real, of_translated = measure(args, real), measure(args, translated, real)
    of_style = {"clips": of_real["clips"] + of_retakes["clips"]}
    row = {"identity": of_inputs["distance_cm"], "retake": of_retakes["distance_cm"],
           "translated": of_translated["distance_cm"]}
    row["gap"] = (row["identity"] - row["translated"]) / (row["identity"] - row["retake"])
    travels = min(clip["travel_m"] for clip in of_real["clips"]) > LEAST_TRAVEL
    for name, key in (("cadence", "cadence_per_s"), ("speed", "speed_m_per_s")):
        row[name] = mean(of_translated, key) / mean(of_style, key) if travels and mean(of_style, key) > 0 else None
    row["foot"] = mean(of_translated, "foot_slide_cm_per_s")
    row["foot_real"] = mean(of_style, "foot_slide_cm_per_s")
    row["jerk"] = mean(of_translated, "jerk_m_per_s3") / mean(of_style, "jerk_m_per_s3")
    return row


def judge_cell(args, inputs, real, retakes, translated):
    """The same row by the independent program."""
    interpreter = ["/usr/bin/python3"] if args.judge.suffix == ".py" else []
    return json.loads(run("judge", [*interpreter, args.judge, "--json", "--input", *inputs, "--real", *real,
                                    "--retake", *retakes, "--translated", *translated])[0])


def do_cell(args, split, parent, cell):
    """The cell's rows: {"measure": row, "judge": row or absent}, or {"refused": why}."""
    content, style = cell
    folder = parent / f"{content}_{style}"
    folder.mkdir(parents=True)
    try:
        inputs, real = takes(args, content, INPUT_STYLE, split.judged), takes(args, content, style, split.judged)
        retakes = takes(args, content, style, split.retakes)
        pairs, model = folder / "pairs.toml", folder / "style.strut"
        pair(args, takes(args, content, INPUT_STYLE, split.learnt), takes(args, content, style, split.learnt), pairs)
        learn_seconds = learn(args, pairs, model)
        translated, translate_seconds = translate(args, model, inputs, folder)
        rows = {"measure": figures(args, inputs, real, retakes, translated) |
                {"learn": learn_seconds, "translate": translate_seconds}}
        if args.judge:
            rows["judge"] = judge_cell(args, inputs, real, retakes, translated)
        return rows
    except Refused as why:
        return {"refused": str(why)}


def do_cells(args, split, parent, cells):
    with concurrent.futures.ThreadPoolExecutor(max(1, args.jobs)) as pool:
        return dict(zip(cells, pool.map(lambda cell: do_cell(args, split, parent, cell), cells)))
