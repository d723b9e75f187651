#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The quality table: learn a style from some takes, translate others, and say how near the result comes to real takes.

    bench/quality/translate_table.py --data FOLDER --cell walk/elderly --cell walk/active
    bench/quality/translate_table.py --data FOLDER                                        (all 21 cells)

FOLDER holds dataset-2_CONTENT_STYLE_TAKE.bvh files (Bandai-Namco-Research-Motiondataset-2). In every cell, takes 001-012
of the style `normal` and of the wanted style are paired and learnt from, takes 013-017 of `normal` are translated, and
takes 013-017 of the wanted style are what the result is held against. Needs nothing but Python's standard library.

Columns
  identity    mean distance of the untranslated clips to the real takes, cm (strut measure)
  retake      mean distance of other real takes of the style (001, 005, 009) to them, cm
  translated  mean distance of the translated clips to them, cm
  gap         (identity - translated) / (identity - retake): 0 = nothing done, 1 = as near as another recording
  cadence     steps per second of the translated clips over that of the real takes and retakes; - where nobody travels
  speed       the same for the speed of the hips over the ground
  foot        how fast the toes still slide when they are slowest, cm/s; foot_real the same for real takes and retakes
  jerk        mean jerk of the translated clips over that of real takes and retakes
  learn       seconds `strut learn` takes; translate: mean seconds of a `strut translate`, each as a whole process.
              With more than one job the cells share the processor: take times from a run with --jobs 1.

With --judge, a program that measures the same figures independently is run on the same files and its table follows; it
is called as `JUDGE --json --input F... --real F... --retake F... --translated F...` and prints one JSON object.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

CONTENTS = ["walk", "walk-turn-left", "walk-turn-right", "run",
            "wave-left-hand", "wave-both-hands", "raise-up-right-hand"]
STYLES = ["elderly", "active", "feminine"]
INPUT_STYLE = "normal"
LEARNT_TAKES = range(1, 13)
JUDGED_TAKES = range(13, 18)
RETAKES = (1, 5, 9)
LEAST_TRAVEL = 1.0  # metres in every real take, for cadence and speed to mean something
FIGURES = ["identity", "retake", "translated", "gap", "cadence", "speed", "foot", "foot_real", "jerk"]
TIMES = ["learn", "translate"]


class Refused(Exception):
    """A step of a cell failed: which one, and the last line it said."""


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


def translate_cell(args, folder, content, style, inputs):
    """Learns the style and translates `inputs`: the translated files, seconds to learn, seconds per translation."""
    pairs, model = folder / "pairs.toml", folder / "style.strut"
    run("pair", [args.strut, "pair", "--input", *takes(args, content, INPUT_STYLE, LEARNT_TAKES),
                 "--output", *takes(args, content, style, LEARNT_TAKES), "-o", pairs, *args.pair_options])
    learn_seconds = run("learn", [args.strut, "learn", pairs, "-o", model, *args.learn_options])[1]
    translated, seconds = [], []
    for clip in inputs:
        translated.append(folder / f"translated_{clip.name}")
        command = [args.strut, "translate", model, clip, "-o", translated[-1], *args.translate_options]
        seconds.append(run("translate", command)[1])
    return translated, learn_seconds, statistics.fmean(seconds)


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


def do_cell(args, parent, cell):
    """The cell's rows: {"measure": row, "judge": row or absent}, or {"refused": why}."""
    content, style = cell
    folder = parent / f"{content}_{style}"
    folder.mkdir(parents=True)
    try:
        inputs, real = takes(args, content, INPUT_STYLE, JUDGED_TAKES), takes(args, content, style, JUDGED_TAKES)
        retakes = takes(args, content, style, RETAKES)
        translated, learn, translate = translate_cell(args, folder, content, style, inputs)
        rows = {"measure": figures(args, inputs, real, retakes, translated) | {"learn": learn, "translate": translate}}
        if args.judge:
            rows["judge"] = judge_cell(args, inputs, real, retakes, translated)
        return rows
    except Refused as why:
        return {"refused": str(why)}


def table(results, judge, columns):
    """Markdown lines of one judge's rows."""
    lines = ["| cell | " + " | ".join(columns) + " |", "| --- |" + " ---: |" * len(columns)]
    for (content, style), rows in results.items():
        if "refused" in rows:
            lines.append(f"| {content} {style} | {rows['refused']} |" + " |" * (len(columns) - 1))
            continue
        values = (rows[judge].get(column) for column in columns)
        lines.append(f"| {content} {style} | " + " | ".join("-" if v is None else f"{v:.2f}" for v in values) + " |")
    return lines


def summary(results, judge):
    gaps = [rows[judge]["gap"] for rows in results.values() if judge in rows]
    if not gaps:
        return f"No cell of {len(results)} was translated."
    return (f"{len(gaps)} of {len(results)} cells translated; gap: median {statistics.median(gaps):.2f}, "
            f"lowest {min(gaps):.2f}, at least 1.0 in {sum(gap >= 1.0 for gap in gaps)}.")


def print_tables(results, with_judge):
    print("By `strut measure`:\n")
    print("\n".join(table(results, "measure", FIGURES + TIMES)))
    print("\n" + summary(results, "measure"))
    if with_judge:
        print("\nBy the independent judge:\n")
        print("\n".join(table(results, "judge", FIGURES)))
        print("\n" + summary(results, "judge"))


def cell_name(text):
    content, slash, style = text.partition("/")
    if not (content and slash and style):
        raise argparse.ArgumentTypeError(f"expected CONTENT/STYLE, e.g. walk/elderly, found '{text}'")
    return content, style


def parse_arguments():
    root = pathlib.Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="folder of the clips")
    parser.add_argument("--strut", type=pathlib.Path, default=root / "build/release/strut",
                        help="the program (default: build/release/strut)")
    parser.add_argument("--judge", type=pathlib.Path, help="independent program to measure with as well")
    parser.add_argument("--cell", type=cell_name, action="append", dest="cells", metavar="CONTENT/STYLE",
                        help="a cell to do, repeatable (default: all 21)")
    parser.add_argument("--pattern", default="dataset-2_{content}_{style}_{take:03d}.bvh",
                        help="names of the clips (default: %(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cells at a time (default: all cores)")
    parser.add_argument("--keep", type=pathlib.Path, help="new folder for pairs, models and translated clips "
                        "(default: a temporary one, removed at the end)")
    parser.add_argument("--json", action="store_true", help="print JSON instead of tables")
    for step in ("pair", "learn", "translate"):
        parser.add_argument(f"--{step}-options", type=shlex.split, default=[], metavar="OPTIONS",
                            help=f"further options for strut {step}, in one argument: --{step}-options='--x 1'")
    args = parser.parse_args()
    for path, what in ((args.data, "folder of clips"), (args.strut, "strut program"), (args.judge, "judge")):
        if path is not None and not path.exists():
            parser.error(f"{path}: there is no such {what}")
    if args.keep is not None and args.keep.exists():
        parser.error(f"{args.keep}: is there already")
    args.strut = args.strut.resolve()
    return args


def main():
    args = parse_arguments()
    cells = list(dict.fromkeys(args.cells or [(content, style) for content in CONTENTS for style in STYLES]))
    with tempfile.TemporaryDirectory(prefix="strut_table_") as temporary, \
            concurrent.futures.ThreadPoolExecutor(max(1, args.jobs)) as pool:
        parent = args.keep or pathlib.Path(temporary)
        results = dict(zip(cells, pool.map(lambda cell: do_cell(args, parent, cell), cells)))
    if args.json:
        print(json.dumps({f"{content}/{style}": rows for (content, style), rows in results.items()}, indent=2))
    else:
        print_tables(results, args.judge is not None)
    return 1 if any("refused" in rows for rows in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
