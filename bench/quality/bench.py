# SPDX-License-Identifier: MIT
"""The programs, clips and takes that the quality study works with, and running one on the other."""
import concurrent.futures
import dataclasses
import functools
import json
import pathlib
import statistics
import subprocess
import time

INPUT_STYLE = "normal"


@dataclasses.dataclass(frozen=True)
class Split:
    """Takes learnt from are never judged."""
    learnt: tuple   # takes of both styles that are learnt from
    judged: tuple   # takes of the input style that are translated, of the style that the results are held against
    retakes: tuple  # learnt takes of the style that stand for recording once more


# Settings are chosen on the validation split alone: it leaves the takes that the test split judges untouched.
SPLITS = {"test": Split(tuple(range(1, 13)), tuple(range(13, 18)), (1, 5, 9)),
          "validation": Split(tuple(range(1, 9)), tuple(range(9, 13)), (1, 4, 7))}


class Refused(Exception):
    """A step failed: which one, and the last line it said."""


@dataclasses.dataclass(frozen=True)
class Done:
    out: str
    err: str
    seconds: float


def run(step, command):
    begin = time.monotonic()
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    seconds = time.monotonic() - begin
    if done.returncode != 0:
        said = [line for line in done.stderr.splitlines() if line.strip() and not line.startswith("hint:")]
        raise Refused(f"{step} ended with exit code {done.returncode}: {said[-1] if said else 'no message'}")
    return Done(done.stdout, done.stderr, seconds)


@dataclasses.dataclass
class Bench:
    strut: pathlib.Path
    vary_clip: pathlib.Path
    data: pathlib.Path
    folder: pathlib.Path   # for everything that is made
    split: Split
    pattern: str = "dataset-2_{content}_{style}_{take:03d}.bvh"
    jobs: int = 1
    options: dict = dataclasses.field(default_factory=dict)  # further ones, by command

    def takes(self, content, style, numbers):
        """The clips of a content and style that exist."""
        names = [self.data / self.pattern.format(content=content, style=style, take=take) for take in numbers]
        found = [name for name in names if name.exists()]
        if not found:
            raise Refused(f"there is no file like {names[0].name}")
        return found

    def make_folder(self, *names):
        folder = self.folder.joinpath(*names)
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def pair(self, inputs, outputs, pairs, *options):
        run("pair", [self.strut, "pair", "--input", *inputs, "--output", *outputs, "-o", pairs,
                     *self.options.get("pair", ()), *options])

    def learn(self, pairs, model, *options):
        """Learns from a pair list."""
        return run("learn", [self.strut, "learn", pairs, "-o", model, *self.options.get("learn", ()), *options])

    def translate(self, model, clips, folder, *options):
        """The translated files, and the mean seconds per clip."""
        translated = [folder / f"translated_{clip.name}" for clip in clips]
        seconds = [run("translate", [self.strut, "translate", model, clip, "-o", out,
                                     *self.options.get("translate", ()), *options]).seconds
                   for clip, out in zip(clips, translated)]
        return translated, statistics.fmean(seconds)

    def measure(self, clips, against=()):
        command = [self.strut, "measure", *clips, "--json"] + (["--against", *against] if against else [])
        return json.loads(run("measure", command).out)

    def vary(self, clip, out, *variation):
        """The frames [begin, end) in which the clip at `out` is varied in full."""
        found = json.loads(run("vary_clip", [self.vary_clip, clip, out, *variation]).out)
        return found["begin"], found["end"]

    def compare(self, *words):
        return json.loads(run("vary_clip", [self.vary_clip, *words]).out)

    @functools.cached_property
    def version(self):
        return run("version", [self.strut, "--version"]).out.split()[-1]

    def each(self, work, items, jobs=None):
        """What `work` makes of each item, by item; the Refused where it fails."""
        def attempt(item):
            try:
                return work(item)
            except Refused as why:
                return why
        with concurrent.futures.ThreadPoolExecutor(max(1, jobs or self.jobs)) as pool:
            return dict(zip(items, pool.map(attempt, items)))


def answered(results):
    """Without what was refused."""
    return {item: result for item, result in results.items() if not isinstance(result, Refused)}
