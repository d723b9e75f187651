#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""How good translations are: learn styles from some takes, translate others, and say how near the results come to real
takes; writes the page docs/quality.md.

    ./dev quality FOLDER                         everything, into the page
    ./dev quality FOLDER --split validation      the takes that settings are chosen on, a short table
    ./dev quality FOLDER --cell walk/elderly     some cells, printed
    ./dev quality FOLDER --split validation --page FILE     everything about those takes, into another page

FOLDER holds dataset-2_CONTENT_STYLE_TAKE.bvh files (Bandai-Namco-Research-Motiondataset-2). In every cell, takes 001-012
of the style `normal` and of the wanted style are paired and learnt from, takes 013-017 of `normal` are translated, and
takes 013-017 of the wanted style are what the result is held against, with 001, 005 and 009 as retakes. The validation
split learns from 001-008 and judges on 009-012 (retakes: 001, 004, 007): settings may be chosen on it, never on 013-017.
The page tells what every figure means.

With --judge, a program that measures the same figures independently is run on the same files; it is called as
`JUDGE --json --input F... --real F... --retake F... --translated F...` and prints one JSON object.
Needs nothing but Python's standard library.
"""
import argparse
import json
import os
import pathlib
import shlex
import sys
import tempfile
import time

import cells
import other_inputs
import page
import recognition
import tables
from bench import SPLITS, Bench, Refused

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEFAULT_SPLIT = "test"
METHODS_BESIDE_THE_DEFAULT = {"paper": ("--method", "paper"), "no context": ("--context", "0")}  # options of learn


class Progress:
    """A line on standard error per step, with the seconds it took."""

    def __init__(self):
        self.begin = time.monotonic()

    def __call__(self, step, work, *arguments, **named):
        begin = time.monotonic()
        result = work(*arguments, **named)
        print(f"quality: {step}: {time.monotonic() - begin:.1f} s", file=sys.stderr)
        return result

    def seconds(self):
        return time.monotonic() - self.begin


def do_cells(bench, some_cells, judge, jobs):
    """The default method's rows by cell, and all that other studies need of it."""
    references = bench.each(lambda cell: cells.reference(bench, cell), some_cells)
    learnt = bench.each(lambda cell: cells.learn_cell(bench, cell), some_cells, jobs)
    rows = cells.rows(bench, references, learnt)
    by_judge = cells.judge_rows(bench, judge, references, learnt) if judge else None
    return {"references": references, "learnt": learnt, "rows": rows, "judge": by_judge}


def do_methods(bench, some_cells, default, progress):
    """Rows by method and cell; and the cells in which learning from one pair warned. One cell at a time, for times."""
    rows = {"recording again": cells.recorded_again(bench, default["references"]), "default": default["rows"]}

    def keep(name, learnt):
        rows[name] = cells.rows(bench, default["references"], learnt)
        return learnt
    for name, options in METHODS_BESIDE_THE_DEFAULT.items():
        keep(name, progress(name, bench.each, lambda cell: cells.learn_cell(bench, cell, name, options), some_cells, 1))
    one_pair = keep("one pair", progress("one pair", bench.each,
                                         lambda cell: cells.learn_from_one_pair(bench, cell), some_cells, 1))
    keep("together", progress("all contents together", cells.learn_together, bench, some_cells))
    return {"rows": rows, "warned": [cell for cell, found in one_pair.items()
                                     if not isinstance(found, Refused) and found.warned]}


def do_everything(bench, args, progress):
    default = progress("cells", do_cells, bench, args.cells, args.judge, 1)  # times are taken one cell at a time
    learnt, references = default["learnt"], default["references"]
    return {"cells": default["rows"], "judge": default["judge"],
            "methods": do_methods(bench, args.cells, default, progress),
            "recognition": progress("recognition", recognition.recognize_all, bench, args.cells, learnt),
            "details": progress("details", other_inputs.details, bench, learnt, args.joints),
            "unfamiliar": progress("unfamiliar inputs", other_inputs.unfamiliar, bench, learnt, references,
                                   args.joints[0]),
            "tempi": progress("tempi", other_inputs.tempi, bench, learnt, references),
            "identities": progress("no style", other_inputs.identities, bench,
                                   list(dict.fromkeys(content for content, _ in args.cells)))}


def cell_name(text):
    content, slash, style = text.partition("/")
    if not (content and slash and style):
        raise argparse.ArgumentTypeError(f"expected CONTENT/STYLE, e.g. walk/elderly, found '{text}'")
    return content, style


def default_data():
    return pathlib.Path(os.environ.get("STRUT_DATA", ROOT.parent / "shared/data")) / "bandai-namco"


def add_arguments(parser):
    parser.add_argument("data", type=pathlib.Path, nargs="?", default=default_data(), metavar="FOLDER",
                        help="folder of the clips (default: bandai-namco in $STRUT_DATA)")
    parser.add_argument("--split", choices=SPLITS, default=DEFAULT_SPLIT,
                        help="which takes are used (default: test)")
    parser.add_argument("--cell", type=cell_name, action="append", dest="cells", metavar="CONTENT/STYLE",
                        help="a cell to do, repeatable (default: all 21)")
    parser.add_argument("--page", type=pathlib.Path, metavar="FILE",
                        help="do everything and write the page there (default: docs/quality.md, unless the cells, the "
                        "split or a command's options are given)")
    parser.add_argument("--judge", type=pathlib.Path, help="independent program to measure with as well")
    parser.add_argument("--joint", action="append", dest="joints", metavar="NAME",
                        help="a joint to which details are added, repeatable; the first is also the arm that is raised "
                        f"(default: {', '.join(other_inputs.DETAIL_JOINTS)})")
    parser.add_argument("--pattern", default=Bench.pattern, help="names of the clips (default: %(default)s)")
    parser.add_argument("--strut", type=pathlib.Path, default=ROOT / "build/release/strut",
                        help="the program (default: build/release/strut)")
    parser.add_argument("--vary-clip", type=pathlib.Path, default=ROOT / "build/release/bench/quality/vary_clip",
                        help="the program that varies clips (default: build/release/bench/quality/vary_clip)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="cells at a time (default: all cores)")
    parser.add_argument("--keep", type=pathlib.Path, help="new folder for pairs, models and clips "
                        "(default: a temporary one, removed at the end)")
    parser.add_argument("--json", action="store_true", help="print JSON instead of a table")
    for step in ("pair", "learn", "translate"):
        parser.add_argument(f"--{step}-options", type=shlex.split, default=[], metavar="OPTIONS",
                            help=f"further options for strut {step}, in one argument: --{step}-options='--x 1'")


def check_paths(parser, args):
    needed = [(args.data, "folder of clips"), (args.strut, "strut program"), (args.judge, "judge")]
    if args.page:
        needed.append((args.vary_clip, "program that varies clips"))
    for path, what in needed:
        if path is not None and not path.exists():
            parser.error(f"{path}: there is no such {what}")
    if args.keep is not None and args.keep.exists():
        parser.error(f"{args.keep}: is there already")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser)
    args = parser.parse_args()
    args.options = {step: getattr(args, f"{step}_options") for step in ("pair", "learn", "translate")}
    if not (args.page or args.json or args.cells or args.split != DEFAULT_SPLIT or any(args.options.values())):
        args.page = ROOT / "docs/quality.md"
    check_paths(parser, args)
    args.cells = list(dict.fromkeys(args.cells or cells.ALL_CELLS))
    args.joints = args.joints or other_inputs.DETAIL_JOINTS
    return args


def print_cells(args, found):
    results = found["rows"]
    if args.json:
        print(json.dumps({"/".join(cell): {"refused": str(row)} if isinstance(row, Refused) else row
                          for cell, row in results.items()}, indent=2))
        return
    columns = cells.FIGURES + tables.TIMES
    table = tables.cells_table(results, columns) if args.split == DEFAULT_SPLIT else tables.compact_table(results)
    print("\n".join([*table, "", tables.gap_summary(results)]))
    if found["judge"]:
        print("\n".join(["", "Beside the independent judge:", "", *tables.judge_table(results, found["judge"])]))


def main():
    args = parse_arguments()
    with tempfile.TemporaryDirectory(prefix="strut_quality_") as temporary:
        bench = Bench(args.strut.resolve(), args.vary_clip.resolve(), args.data, args.keep or pathlib.Path(temporary),
                      SPLITS[args.split], args.pattern, args.jobs, args.options)
        if args.page:
            progress = Progress()
            found = do_everything(bench, args, progress)
            page.write(args.page, found, bench, args.joints, METHODS_BESIDE_THE_DEFAULT, progress.seconds())
            print(tables.gap_summary(found["cells"]) + f"\nwritten {args.page}")
            results = found["cells"]
        else:
            found = do_cells(bench, args.cells, args.judge, args.jobs)
            print_cells(args, found)
            results = found["rows"]
    return 1 if any(isinstance(row, Refused) for row in results.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
