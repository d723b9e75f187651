# SPDX-License-Identifier: MIT
"""What becomes of inputs unlike the examples: added details, unfamiliar motion, other tempi, and no style at all."""
import statistics

from bench import INPUT_STYLE, Refused, answered
from cells import figures

# Examples: joints of the clips' skeleton, none of which the program knows by name. The first is the arm that is raised.
DETAIL_JOINTS = ["UpperArm_R", "LowerArm_L", "Head", "Spine"]
# Half as large again and more than recorded; and a slow bending at a rhythm that is no step's.
DETAILS = {"exaggerated 1.75 times": ("exaggerate", "JOINT", 1.75),
           "bent 15 degrees, 0.4 times a second, as it moves most": ("bend", "JOINT", "most", 15, 0.4),
           "bent 15 degrees, 0.4 times a second, as it moves least": ("bend", "JOINT", "least", 15, 0.4)}
UNFAMILIAR = {"an arm raised by 140 degrees": ("raise", "JOINT", 140),
              "a duck by a quarter of the leg": ("duck", 0.25),
              "a standstill of 2 s": ("halt", 2.0),
              "a smaller actor, 0.8 times as tall": ("resize", 0.8),
              "a taller actor, 1.25 times as tall": ("resize", 1.25)}
FAMILIAR = "the clip as it is"
OTHER_STYLE = "a clip of another style"
TEMPI = (0.8, 1.0, 1.25)  # how many times as long the clip becomes


def with_joint(variation, joint):
    return [joint if word == "JOINT" else word for word in variation]


def one_translation(bench, model, clip, folder, *options):
    return bench.translate(model, [clip], folder, *options)[0][0]


# ---- details --------------------------------------------------------------------------------------------------------

def details_of_cell(bench, cell, learnt, joints):
    """How the output of the cell's first input clip answers to every detail: by (joint, detail)."""
    clip, folder = learnt.inputs[0], bench.make_folder("_".join(cell), "details")
    plain = one_translation(bench, learnt.model, clip, folder, "--no-retime")
    responses = {}
    for joint in joints:
        for number, (name, variation) in enumerate(DETAILS.items()):
            varied = folder / f"{joint}_{number}.bvh"
            bench.vary(clip, varied, *with_joint(variation, joint))
            out = one_translation(bench, learnt.model, varied, folder, "--no-retime")
            responses[joint, name] = bench.compare("--response", joint, clip, varied, plain, out)
    return responses


def details(bench, learnt, joints):
    return bench.each(lambda cell: details_of_cell(bench, cell, learnt[cell], joints), list(answered(learnt)))


# ---- unfamiliar motion ----------------------------------------------------------------------------------------------

def answer(bench, model, clip, frames, folder):
    """Output's jerk over the input's, and how far it is from the input frame by frame; None where a number in the
    output is not finite or there is no output."""
    try:
        out = one_translation(bench, model, clip, folder)
        before, after = (bench.measure([path])["clips"][0]["jerk_m_per_s3"] for path in (clip, out))
        unretimed = one_translation(bench, model, clip, bench.make_folder(folder, "unretimed"), "--no-retime")
        apart = bench.compare("--distance", clip, unretimed, *frames)["distance_cm"]
    except Refused:
        return None
    return {"jerk": after / before, "apart": apart}


def unfamiliar_inputs(bench, cell, learnt, other_style, arm, folder):
    """By name: the clip and the frames in which it is unfamiliar."""
    clip = learnt.inputs[0]
    whole = (0, bench.measure([clip])["clips"][0]["frames"])
    found = {FAMILIAR: (clip, whole)}
    for number, (name, variation) in enumerate(UNFAMILIAR.items()):
        varied = folder / f"unfamiliar_{number}.bvh"
        found[name] = varied, bench.vary(clip, varied, *with_joint(variation, arm))
    if other_style:
        other = bench.takes(cell[0], other_style, bench.split.judged)[0]
        found[OTHER_STYLE] = other, (0, bench.measure([other])["clips"][0]["frames"])
    return found


def unfamiliar_in_cell(bench, cell, learnt, other_style, arm):
    folder = bench.make_folder("_".join(cell), "unfamiliar")
    answers = {name: answer(bench, learnt.model, clip, frames, folder) for name, (clip, frames)
               in unfamiliar_inputs(bench, cell, learnt, other_style, arm, folder).items()}
    familiar = answers[FAMILIAR]
    for found in answers.values():
        if found and familiar:
            found["relative"] = found["apart"] / familiar["apart"]
    return answers


def unfamiliar(bench, learnt, references, arm):
    """Of the cells that travel: what became of each kind of input."""
    cells = [cell for cell in answered(learnt) if getattr(references[cell], "travels", False)]

    def other_style(cell):
        styles = [style for content, style in cells if content == cell[0]]
        following = styles[(styles.index(cell[1]) + 1) % len(styles)]
        return following if following != cell[1] else None
    return bench.each(lambda cell: unfamiliar_in_cell(bench, cell, learnt[cell], other_style(cell), arm), cells)


# ---- tempo, and no style --------------------------------------------------------------------------------------------

def tempo_of_cell(bench, cell, learnt, held_against):
    """The gap of the input style's own learnt takes, at every tempo."""
    clips = bench.takes(cell[0], INPUT_STYLE, bench.split.retakes)
    gaps = {}
    for factor in TEMPI:
        folder = bench.make_folder("_".join(cell), f"tempo {factor}")
        stretched = [folder / clip.name for clip in clips]
        for clip, out in zip(clips, stretched):
            bench.vary(clip, out, "stretch", factor)
        translated, _ = bench.translate(learnt.model, stretched, folder)
        gaps[factor] = figures(bench, held_against, stretched, translated)["gap"]
    return gaps


def tempi(bench, learnt, references):
    cells = [cell for cell in answered(learnt) if not isinstance(references[cell], Refused)]
    return bench.each(lambda cell: tempo_of_cell(bench, cell, learnt[cell], references[cell]), cells)


def identity_of_content(bench, content):
    """Learnt from half of the input style's learnt takes to the other half: how far judged takes are moved, beside how
    far the style's takes are from each other [cm]."""
    half = len(bench.split.learnt) // 2
    folder = bench.make_folder(f"{content}_{INPUT_STYLE}")
    pairs, model = folder / "pairs.toml", folder / "style.strut"
    first, second = (bench.takes(content, INPUT_STYLE, numbers)
                     for numbers in (bench.split.learnt[:half], bench.split.learnt[half:]))
    bench.pair(first, second, pairs)
    bench.learn(pairs, model)
    inputs = bench.takes(content, INPUT_STYLE, bench.split.judged)
    translated, _ = bench.translate(model, inputs, folder)
    moved = statistics.fmean(bench.measure([out], [clip])["distance_cm"] for clip, out in zip(inputs, translated))
    takes = bench.measure(bench.takes(content, INPUT_STYLE, bench.split.retakes), inputs)["distance_cm"]
    return {"moved": moved, "takes": takes}


def identities(bench, contents):
    return bench.each(lambda content: identity_of_content(bench, content), contents)
