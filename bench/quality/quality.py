#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The quality table: learn a style from some takes, translate others, and say how near the result comes to real takes.

    ./dev quality FOLDER                         all 21 cells
    ./dev quality FOLDER --split validation      the takes that settings are chosen on, a short table

FOLDER holds dataset-2_CONTENT_STYLE_TAKE.bvh files (Bandai-Namco-Research-Motiondataset-2). In every cell, takes 001-012
of the style `normal` and of the wanted style are paired and learnt from, takes 013-017 of `normal` are translated, and
takes 013-017 of the wanted style are what the result is held against. The validation split learns from 001-008 and
judges on 009-012: settings may be chosen on it, never on 013-017. Needs nothing but Python's standard library.

Columns
  identity    mean distance of the untranslated clips to the real takes, cm (strut measure)
  retake      mean distance of other real takes of the style (001, 005, 009; validation: 001, 004, 007) to them, cm
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
import json
import os
import pathlib
import shlex
import statistics
import sys
import tempfile

from cells import ALL_CELLS, FIGURES, SPLITS, TIMES, do_cells

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMPACT = ["gap", "cadence", "speed", "foot", "jerk", "learn"]


def shown(value):
    return "-" if value is None else f"{value:.2f}"


def table(results, judge, columns):
    """Markdown lines of one judge's rows."""
    lines = ["| cell | " + " | ".join(columns) + " |", "| --- |" + " ---: |" * len(columns)]
    for (content, style), rows in results.items():
        if "refused" in rows:
            lines.append(f"| {content} {style} | {rows['refused']} |" + " |" * (len(columns) - 1))
            continue
        values = (rows[judge].get(column) for column in columns)
        lines.append(f"| {content} {style} | " + " | ".join(map(shown, values)) + " |")
    return lines


def summary(results, judge):
    gaps = [rows[judge]["gap"] for rows in results.values() if judge in rows]
    if not gaps:
        return f"No cell of {len(results)} was translated."
    return (f"{len(gaps)} of {len(results)} cells translated; gap: median {statistics.median(gaps):.2f}, "
            f"lowest {min(gaps):.2f}, at least 1.0 in {sum(gap >= 1.0 for gap in gaps)}.")


def column_summaries(results, columns):
    """A line each for mean, median, lowest and highest of every column."""
    lines = []
    for name, reduce in (("mean", statistics.fmean), ("median", statistics.median), ("lowest", min), ("highest", max)):
        values = [[rows["measure"][column] for rows in results.values() if "measure" in rows] for column in columns]
        known = [[value for value in column if value is not None] for column in values]
        lines.append(f"| **{name}** | " + " | ".join(shown(reduce(column) if column else None) for column in known) + " |")
    return lines


def print_tables(results, with_judge):
    print("By `strut measure`:\n")
    print("\n".join(table(results, "measure", FIGURES + TIMES)))
    print("\n" + summary(results, "measure"))
    if with_judge:
        print("\nBy the independent judge:\n")
        print("\n".join(table(results, "judge", FIGURES)))
        print("\n" + summary(results, "judge"))


def print_compact(results):
    print("\n".join(table(results, "measure", COMPACT) + column_summaries(results, COMPACT)))
    print("\n" + summary(results, "measure"))


def cell_name(text):
    content, slash, style = text.partition("/")
    if not (content and slash and style):
        raise argparse.ArgumentTypeError(f"expected CONTENT/STYLE, e.g. walk/elderly, found '{text}'")
    return content, style


def default_data():
    return pathlib.Path(os.environ.get("STRUT_DATA", ROOT.parent / "shared/data")) / "bandai-namco"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("data", type=pathlib.Path, nargs="?", default=default_data(), metavar="FOLDER",
                        help="folder of the clips (default: bandai-namco in $STRUT_DATA)")
    parser.add_argument("--split", choices=SPLITS, default="test", help="which takes are used (default: test)")
    parser.add_argument("--strut", type=pathlib.Path, default=ROOT / "build/release/strut",
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
    cells = list(dict.fromkeys(args.cells or ALL_CELLS))
    with tempfile.TemporaryDirectory(prefix="strut_quality_") as temporary:
        results = do_cells(args, SPLITS[args.split], args.keep or pathlib.Path(temporary), cells)
    if args.json:
        print(json.dumps({f"{content}/{style}": rows for (content, style), rows in results.items()}, indent=2))
    elif args.split == "validation":
        print_compact(results)
    else:
        print_tables(results, args.judge is not None)
    return 1 if any("refused" in rows for rows in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
