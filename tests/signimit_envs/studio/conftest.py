"""One running studio for all tests, and a session in it that was taught by built-in people."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

pytest.importorskip("fastapi", reason="the studio needs signimit[studio]")
pytest.importorskip("uvicorn", reason="the studio needs signimit[studio]")
pytest.importorskip("websockets", reason="the studio needs signimit[studio]")
httpx = pytest.importorskip("httpx", reason="the studio's tests need httpx")

from signimit.strokes import Stroke  # noqa: E402
from signimit_envs.studio.store.events import DrawnDemonstration  # noqa: E402
from signimit_envs.studio.web.serving import StudioPlan, running_studio  # noqa: E402

Json = dict[str, Any]


@pytest.fixture(scope="package")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with running_studio(StudioPlan(folder=tmp_path_factory.mktemp("studio"))) as where:
        yield where


class Page:
    """Somebody at the page; as nobody waits between two clicks here, clicks are not counted."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.browser = httpx.Client(base_url=address, timeout=60, trust_env=False)

    def ask(self, method: str, path: str, **more: Any) -> Any:
        return self.browser.request(method, f"api/{path}", **more)

    def get(self, path: str) -> Json:
        return self._whole(self.ask("GET", path))

    def post(self, path: str, body: Json) -> Json:
        return self._whole(self.ask("POST", path, json=body))

    def signs(self, session: str, request: Json, attempt: int) -> list[Json]:
        """Let the built-in interactant ask for something."""
        drawn = self.post(f"sessions/{session}/people", {"part": "signs", "attempt": attempt, **request})
        return list(drawn["signs"])

    def demonstration(self, session: Json) -> Json:
        """Let built-in people follow the next prompt; return what a page sends."""
        request = {name: session["next"]["prompt"][name] for name in ("movement", "focus")}
        attempt = session["revision"]
        people = {"part": "movement", "attempt": attempt, **request}
        hand = self.post(f"sessions/{session['id']}/people", people)["hand"]
        return {"revision": attempt, "signs": self.signs(session["id"], request, attempt), "hand": hand}

    def teach(self, session: Json, count: int) -> Json:
        for _ in range(count):
            session = self.post(f"sessions/{session['id']}/demonstrations", self.demonstration(session))
        return session

    @staticmethod
    def _whole(answer: Any) -> Json:
        assert answer.is_success, answer.text
        return dict(answer.json())


@pytest.fixture
def page(address: str, monkeypatch: pytest.MonkeyPatch) -> Iterator[Page]:
    monkeypatch.setattr("signimit_envs.studio.web.guard.Bucket.take", lambda self: True)
    somebody = Page(address)
    yield somebody
    somebody.browser.close()


def _taught(address: str, seed: int, count: int) -> str:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("signimit_envs.studio.web.guard.Bucket.take", lambda self: True)
        somebody = Page(address)
        session = somebody.teach(somebody.post("sessions", {"seed": seed, "title": "taught"}), count)
        somebody.browser.close()
    return str(session["id"])


@pytest.fixture(scope="package")
def taught_id(address: str) -> str:
    """Name of a session with all twelve demonstrations of the paper's language; do not edit it."""
    return _taught(address, 7, 12)


@pytest.fixture(scope="package")
def pair_id(address: str) -> str:
    """Name of a session with two demonstrations; do not edit it."""
    return _taught(address, 3, 2)


@pytest.fixture
def session(page: Page) -> Json:
    """A new session in the paper's language."""
    return page.post("sessions", {"seed": 3})


@pytest.fixture
def shown() -> Callable[[], DrawnDemonstration]:
    """Makes demonstrations, no two alike."""
    numbers = itertools.count()

    def make() -> DrawnDemonstration:
        rng = np.random.default_rng(next(numbers))
        strokes = [Stroke(np.cumsum(rng.normal(0, 0.02, (9, 2)), axis=0), np.linspace(0, 1, 9)) for _ in range(3)]
        return DrawnDemonstration((strokes[0], strokes[1]), rng.uniform(-0.2, 0.2, (3, 2)), strokes[2])

    return make
