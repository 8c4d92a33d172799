"""Tables of what an independent checker says: sessions of real people that another program makes and judges."""

from __future__ import annotations

import json
import re
from pathlib import Path

from signimit.benchmark.statistics import share_text
from signimit.benchmark.tables import markdown_table

IMPERFECT = {
    "plain": "nobody errs: each movement drawn twice, one signer, one mover",
    "plain-mixed": "another person for every sign and every movement",
    "plain-7x6-mixed-once": "another person every time, 7 movements, 6 objects, each pair shown once",
    "once": "each movement drawn once",
    "open": "open strokes, drawn twice",
    "open-once": "open strokes, drawn once",
    "retreat": "the hand goes home after drawing",
    "strangers": "every drawing by another player of Quick, Draw!",
    "strangers-7x4-once": "the same strangers, 7 movements, 4 objects, each pair shown once",
    "strangers-once": "strangers, each movement drawn once",
    "wrong-1": "1 of 12 demonstrations answers something else",
    "wrong-2": "2 of 12 answer something else",
    "wrong-3": "3 of 12 answer something else",
    "mixed-wrong-2": "2 of 12 answer something else, another person for every sign and every movement",
    "irrelevant-1": "1 of 12 is beside the point",
    "irrelevant-2": "2 of 12 are beside the point",
    "irrelevant-3": "3 of 12 are beside the point",
    "idle-1": "1 further stroke that means nothing",
    "idle-4": "4 further strokes",
    "synonyms": "two signs for each object",
    "once-retreat-wrong-1": "drawn once, goes home, 1 of 12 wrong: people with a mouse",
}
CHECKED = {
    "base": "3 movements, 3 objects, one signer, one mover, 12 demonstrations",
    "each": "the same with 6 demonstrations",
    "mixed": "another person for every sign and every movement",
    "six": "6 movements, 4 objects, 18 demonstrations, each pair once",
    "seven": "7 movements, 6 objects, another person every time, 28 demonstrations",
    "paper": "the paper's inference, 12 demonstrations",
    "literal": "Algorithm 1 as printed",
}


def checker(results: Path) -> str:
    """Sessions of real people, as another program than ours makes and judges them."""
    rows = []
    for name, what in CHECKED.items():
        found = json.loads((results / "checker" / f"{name}.json").read_text(encoding="utf-8"))
        rows.append((what, *(_share(found[key]) for key in ("all inferences right", "obeyed"))))
    return markdown_table(("sessions", "every inference right [95 %]", "commands obeyed [95 %]"), rows)


def people_as_they_are(results: Path) -> str:
    """Sessions of real people who do not keep to the rules, as another program than ours makes and judges them."""
    rows = []
    for name, what in IMPERFECT.items():
        found = json.loads((results / "checker" / "people_as_they_are" / f"{name}.json").read_text(encoding="utf-8"))
        shares = (_share(found[key]) for key in ("right", "read", "obeyed"))
        known = (found.get(key) for key in ("trust, area under curve", "confidence, calibration error"))
        rows.append((what, *shares, *("" if value is None else f"{value:g}" for value in known)))
    head = ("what people do", "sessions right [95 %]", "commands read [95 %]", "obeyed [95 %]")
    return markdown_table((*head, "trust, area", "confidence, error"), rows)


def _share(text: str) -> str:
    """Return the share and its interval of a text of the checker's, such as "97.5 % (39/40)"."""
    count, total = re.findall(r"\((\d+)/(\d+)\)", text)[0]
    return share_text(int(count), int(total))
