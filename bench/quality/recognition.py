# SPDX-License-Identifier: MIT
"""Which real take a clip is nearest to, over all contents and styles: whether it is recognized as what it should be."""
import dataclasses

from bench import INPUT_STYLE, Refused, answered


@dataclasses.dataclass(frozen=True)
class Recognized:
    clip: str       # its file's name
    content: str    # what it should be
    style: str
    nearest_content: str
    nearest_style: str

    @property
    def right_content(self):
        return self.content == self.nearest_content

    @property
    def right_style(self):
        return self.style == self.nearest_style


def candidates(bench, cells):
    """The judged takes of every content in every style, the input style too: (content, style) by file."""
    found = {}
    for content in dict.fromkeys(content for content, _ in cells):
        for style in [INPUT_STYLE, *dict.fromkeys(style for _, style in cells)]:
            try:
                found |= {take: (content, style) for take in bench.takes(content, style, bench.split.judged)}
            except Refused:
                continue
    return found


def recognize(bench, among, cell, clips):
    """Each clip's nearest take, itself left out."""
    found = []
    for measured in bench.measure(clips, list(among))["clips"]:
        distances = {take: other["distance_cm"] for take, other in zip(among, measured["against"])
                     if str(take) != measured["path"]}
        nearest = among[min(distances, key=distances.get)]
        found.append(Recognized(measured["path"].rpartition("/")[2], *cell, *nearest))
    return found


def recognize_all(bench, cells, learnt):
    """Of every cell, its translated clips and its real takes."""
    among = candidates(bench, cells)
    translated = bench.each(lambda cell: recognize(bench, among, cell, learnt[cell].translated), list(answered(learnt)))
    real = bench.each(lambda cell: recognize(bench, among, cell, bench.takes(*cell, bench.split.judged)), cells)
    return {"candidates": len(among), "translated": sum(answered(translated).values(), []),
            "real": sum(answered(real).values(), [])}
