"""Fixtures of the browser tests: a running studio, a browser, and a visitor who draws with a mouse or a finger."""

from __future__ import annotations

import os
import secrets
import shutil
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

for _package in ("fastapi", "uvicorn", "websockets"):
    pytest.importorskip(_package, reason="the studio needs signimit[studio]")
httpx = pytest.importorskip("httpx", reason="the studio's tests need httpx")
playwright = pytest.importorskip("playwright.sync_api", reason="the page is tested with playwright")

from signimit.teaching.composition import compose_loops, compose_path  # noqa: E402
from signimit.teaching.languages import PAPER_LANGUAGE  # noqa: E402
from signimit.teaching.people import Person, synthetic_library  # noqa: E402
from signimit_envs.studio.arm import live_arm  # noqa: E402
from signimit_envs.studio.web.serving import StudioPlan, running_studio  # noqa: E402

Json = dict[str, Any]
Array = NDArray[np.float64]
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
ARGUMENTS = (
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--disable-quic",
    "--disable-frame-rate-limit",  # each input event waits for a frame
    "--disable-gpu-vsync",
    *(["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []),
)
PATIENCE = 30_000  # ms, on a busy machine
SIGN_POINTS, MOVEMENT_POINTS = 8, 18
FINGER = 7  # its number, on the touch screen
HURRY = 4  # times real time, of the simulated arm
TAUGHT = 12  # demonstrations of the session that others begin with


@pytest.fixture(scope="package")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("studio")


@pytest.fixture(scope="package")
def address(folder: Path) -> Iterator[str]:
    """A running studio whose arm is faster than real time, as nobody wants to wait for it."""
    clock = live_arm.RealTimeClock
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(live_arm, "RealTimeClock", lambda period, now: clock(period / HURRY, now))
        patch.setattr(live_arm, "ANSWER_SECONDS", HURRY * live_arm.ANSWER_SECONDS)
        with running_studio(StudioPlan(folder=folder)) as where:
            yield where


@pytest.fixture(scope="package")  # while it is open no test in its thread may run an event loop of its own
def browser() -> Iterator[Any]:
    if CHROMIUM is None:
        pytest.skip("there is no chromium on this machine")
    with playwright.sync_playwright() as driver:
        opened = driver.chromium.launch(executable_path=CHROMIUM, args=list(ARGUMENTS))
        yield opened
        opened.close()


BOX = """(element) => {
  element.scrollIntoViewIfNeeded();
  const { x, y, width, height } = element.getBoundingClientRect();
  return [x, y, width, height];
}"""


@dataclass
class Visitor:
    """Somebody at the page, who draws point by point with input events that carry the time of a real hand."""

    page: Any
    address: str
    touch: bool = False
    problems: list[str] = field(default_factory=list)
    clock: float = 0.0

    def __post_init__(self) -> None:
        self.page.set_default_timeout(PATIENCE)
        self.page.on("console", self._check_console)
        self.page.on("pageerror", lambda error: self.problems.append(str(error)))
        self.page.on("request", lambda request: self._check_origin(request.url))
        self.devtools = self.page.context.new_cdp_session(self.page)

    def _check_console(self, message: Any) -> None:
        if message.type == "error":
            self.problems.append(message.text)

    def _check_origin(self, url: str) -> None:
        own = (self.address, self.address.replace("http", "ws"), "blob:", "data:")
        if not url.startswith(own):
            self.problems.append(f"a request to {url}")

    def open(self, view: str = "teach", session: str = "") -> None:
        self.page.goto(f"{self.address}#{view}/{session}")
        self.page.locator("body[data-ready=yes]").wait_for()

    def api(self, path: str, body: Json | None = None) -> Any:
        """Ask the server beside the page."""
        request = self.page.context.request
        where = f"{self.address}api/{path}"
        answer = request.get(where) if body is None else request.post(where, data=body)
        assert answer.ok, answer.text()
        return answer.json()

    def session(self) -> Json:
        return dict(self.api(f"sessions/{self.page.url.rpartition('/')[2]}"))

    def until_kept(self, place: str) -> None:
        """Wait until the server has what is drawn at a place."""
        script = "async ([where, place]) => (await (await fetch(where)).json()).draft.drawn[place]?.length > 0"
        self.page.wait_for_function(script, arg=[f"api/sessions/{self.page.url.rpartition('/')[2]}", place], polling=50)

    def see(self, selector: str, text: str) -> None:
        playwright.expect(self.page.locator(selector)).to_contain_text(text, timeout=PATIENCE)

    def draw(self, selector: str, places: Array, times: Array, lift: bool = True) -> None:
        """Draw over an element, at places in shares of its width and height, as time goes by."""
        left, top, width, height = self.page.locator(selector).evaluate(BOX)
        points = [(left + width * x, top + height * y) for x, y in places]
        begun = max(self.clock, time.time())
        for (x, y), at in zip(points, times - times[0], strict=True):
            self.event("Move" if at else "Start", x, y, begun + at)
        self.clock = begun + times[-1] - times[0] + 0.1
        if lift:
            self.event("End", *points[-1], self.clock)

    def event(self, what: str, x: float, y: float, at: float) -> None:
        if self.touch:
            touching = [] if what in ("End", "Cancel") else [{"x": x, "y": y, "id": FINGER}]
            event = {"type": f"touch{what}", "touchPoints": touching, "timestamp": at}
            self.devtools.send("Input.dispatchTouchEvent", event)
            return
        name = {"Start": "mousePressed", "Move": "mouseMoved", "End": "mouseReleased"}[what]
        event = {"type": name, "x": x, "y": y, "button": "left", "buttons": int(what != "End"), "timestamp": at}
        self.devtools.send("Input.dispatchMouseEvent", {**event, "clickCount": int(what != "Move")})

    def sign(self, view: str, number: int, points: Array) -> None:
        """Draw a sign, y up, in a pad."""
        middle, size = (points.max(axis=0) + points.min(axis=0)) / 2, np.ptp(points, axis=0).max()
        thinned = points[np.linspace(0, len(points) - 1, SIGN_POINTS).astype(int)]
        places = 0.5 + (thinned - middle) / size * 0.7 * np.array([1, -1])
        self.draw(f"#{view}-pads figure:nth-child({number}) canvas", places, np.linspace(0, 0.6, SIGN_POINTS))

    def hand(self, path: Array, period: float = 0.02) -> None:
        """Draw a movement on the table of Teach, m, samples so many seconds apart."""
        self.page.locator("#teach-stage .stage:not(.waiting)").wait_for()
        kept = np.linspace(0, len(path) - 1, min(len(path), MOVEMENT_POINTS)).astype(int)
        self.draw("#teach-stage .sheet", shares(self.api("studio")["picture"], path[kept]), period * kept)


def shares(picture: Json, places: Array, plane: str = "table") -> Array:
    """Return where places on the table are in the picture, in shares of its width and height."""
    size = np.array([picture["width"], picture["height"]])
    offset = (places - picture["centre"]) / picture["metres_per_pixel"][plane] * [1, -1]
    return np.asarray(0.5 + offset / size)


class Actor:
    """A synthetic interactant and demonstrator; speaks the paper's language and remembers the loops drawn."""

    def __init__(self, seed: int) -> None:
        self.rng = np.random.default_rng(seed)
        self.signer = Person.sample(self.rng)
        self.movements = synthetic_library(PAPER_LANGUAGE.movements, samples=12, rng=self.rng)
        self.templates: list[list[Array]] = [[] for _ in PAPER_LANGUAGE.movements]

    def speak(self, visitor: Visitor, view: str, request: Json) -> None:
        labels = PAPER_LANGUAGE.focus_signs[request["focus"]], PAPER_LANGUAGE.movement_signs[request["movement"]]
        for number, label in enumerate(labels, 1):
            visitor.sign(view, number, self.signer.draw(label, self.rng).points)

    def path(self, session: Json) -> Array:
        """Draw the movement that the prompt asks for."""
        request, scene = session["next"]["prompt"], session["next"]["scene"]
        loops = compose_loops(PAPER_LANGUAGE, self.movements, request["movement"], self.rng)
        self.templates[request["movement"]] += loops
        about = np.array(scene["objects"][request["focus"]])
        return compose_path(np.array(scene["hand"]), [loop + about for loop in loops])

    def demonstrate(self, visitor: Visitor, session: Json) -> None:
        """Follow the prompt in the page, and teach it."""
        self.speak(visitor, "teach", session["next"]["prompt"])
        visitor.hand(self.path(session))
        visitor.page.locator("#teach-it").click()
        visitor.see("#teach-count", f"Demonstration {len(session['demonstrations']) + 2}")


@pytest.fixture(scope="module")
def actor() -> Callable[[int], Actor]:
    return Actor


@pytest.fixture(scope="module")
def in_picture() -> Callable[..., Array]:
    return shares


@pytest.fixture
def visit(browser: Any, address: str) -> Iterator[Callable[..., Visitor]]:
    """Opens pages; when the test is over none of them may have complained or looked elsewhere."""
    contexts, visitors = [], []

    def come(touch: bool = False, address: str = address, **options: Any) -> Visitor:
        context = browser.new_context(has_touch=touch, is_mobile=touch, reduced_motion="reduce", **options)
        contexts.append(context)
        visitors.append(Visitor(context.new_page(), address, touch))
        return visitors[-1]

    yield come
    problems = [problem for visitor in visitors for problem in visitor.problems]
    for context in contexts:
        context.close()
    assert not problems


@pytest.fixture(scope="package")
def journal(address: str, folder: Path) -> list[str]:
    """Lines of the journal of a session that built-in people taught."""
    with httpx.Client(base_url=f"{address}api/", timeout=60, trust_env=False) as server:

        def post(path: str, body: Json) -> Json:
            return dict(server.post(path, json=body).raise_for_status().json())

        session = post("sessions", {"seed": 5, "title": "A test"})
        where = f"sessions/{session['id']}"
        for attempt in range(TAUGHT):
            request = {name: session["next"]["prompt"][name] for name in ("movement", "focus")}
            more = {**request, "attempt": attempt}
            drawn = {**post(f"{where}/people", {"part": "signs", **more})}
            drawn |= post(f"{where}/people", {"part": "movement", **more})
            session = post(f"{where}/demonstrations", {"revision": session["revision"], **drawn})
    return (folder / str(session["id"]) / "journal.jsonl").read_text().splitlines(keepends=True)


@pytest.fixture
def new_session(folder: Path, journal: list[str]) -> Callable[..., str]:
    """Begins a session as the first lines of the journal, so that nobody has to teach it again. Gives its name."""

    def begin(demonstrations: int = 0, folder: Path = folder) -> str:
        name = f"20000101-000000-{secrets.token_hex(4)}"
        (folder / name).mkdir()
        (folder / name / "journal.jsonl").write_text("".join(journal[: 1 + demonstrations]))
        return name

    return begin
