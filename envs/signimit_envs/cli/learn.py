"""Learn from a file of demonstrations, say what was understood, and write the model."""

from __future__ import annotations

from pathlib import Path

from signimit.demonstrations import DemonstrationSet
from signimit.io.safe_files import replaced_path
from signimit.learners import DEFAULT_METHOD
from signimit.learning import learn
from signimit.policies import DEFAULT_POLICY
from signimit.strokes import StrokeLibrary
from signimit.teaching.languages import PAPER_LANGUAGE
from signimit_envs.cli.command_line import check_output_file

PICTURES = (".png", ".pdf", ".svg", ".jpg")


def main(
    demonstrations: Path,
    /,
    *,
    prototypes: Path | None = None,
    labels: tuple[str, ...] = PAPER_LANGUAGE.prototypes,
    method: str = DEFAULT_METHOD,
    policy: str = DEFAULT_POLICY,
    seed: int = 0,
    out: Path = Path("model.npz"),
    why: Path | None = None,
    object_names: tuple[str, ...] | None = None,
    movement_names: tuple[str, ...] | None = None,
) -> None:
    """Learn from demonstrations, and write what was understood to a model file.

    Args:
        demonstrations: Demonstrations as `make-demonstrations` and DemonstrationSet.save write them.
        prototypes: Stroke library with the prototype signs; the methods "paper" and "paper-literal" need it.
        labels: Which signs of that library are prototypes; the first stroke of each is taken.
        method: How to learn: joint, paper, or paper-literal, the paper's algorithm as it is printed.
        policy: Kind of policy for the responses: path-following, knn, ilo-gmr, gmr or dmp.
        seed: Of what the method draws at random.
        out: Model file to write, .npz.
        why: Picture of the reasons to write, .png, .pdf, .svg or .jpg, with the default method: probabilities, lexicon,
            evidence.
        object_names: What to call each object where words are printed, e.g. "cup plate spoon"; left out, by its colour,
            or as the file calls it.
        movement_names: What to call each movement, in the order in which they were found; left out, a shape is named
            where it is beyond doubt.
    """
    check_output_file(out, ".npz")
    if why is not None:
        check_output_file(why, *PICTURES)
    demos = DemonstrationSet.load(demonstrations)
    library = None if prototypes is None else StrokeLibrary.load(prototypes)
    strokes = None if library is None else [library.select(label)[0] for label in labels]
    model = learn(demos, strokes, method, policy, seed).with_names(movement_names, object_names)
    print(model.summary() if why is None else model.explain())
    if why is not None:
        from signimit.plots.explanation import draw_explanation

        with replaced_path(why, why.suffix) as beside:
            draw_explanation(model).savefig(beside, dpi=110)
    model.save(out)
    print(f"The model is in {out}.")
