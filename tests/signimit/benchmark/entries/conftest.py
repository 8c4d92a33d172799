"""Sessions and entries for the tests of entries."""

from collections.abc import Callable

import pytest

from signimit.benchmark.entries import ENTRANTS
from signimit.benchmark.protocol import Entry
from signimit.benchmark.running import make_entry
from signimit.benchmark.shipped_sessions import get_session
from signimit.benchmark.splits import get_split
from signimit.exceptions import MissingDependencyError
from signimit.teaching.sessions import Session

Observed = Callable[[str, Session], Entry]


@pytest.fixture(scope="session")
def paper_session() -> Session:
    return get_session(get_split("paper"), 0)


@pytest.fixture(scope="session")
def observed() -> Observed:
    """Makes an entry that has observed a session as it is, however many demonstrations it would have liked."""

    def make(name: str, session: Session) -> Entry:
        try:
            entry = make_entry(ENTRANTS[name], session)
        except MissingDependencyError as error:
            pytest.skip(str(error))
        entry.observe(session.demonstrations)
        return entry

    return make
