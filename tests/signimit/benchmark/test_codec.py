"""Sessions survive as small whole numbers."""

import numpy as np
import pytest

from signimit.benchmark.codec import GRID, decode_sessions, digest, encode_sessions
from signimit.benchmark.sessions import BenchmarkSession, compose_session
from signimit.benchmark.splits import SPLITS


@pytest.fixture(scope="module", params=["paper", "filler-word", "counterfactual"])
def sessions(request: pytest.FixtureRequest) -> list[BenchmarkSession]:
    return [compose_session(SPLITS[request.param], seed) for seed in (0, 1)]


def test_what_comes_back_is_what_went_in_to_half_the_grid(sessions: list[BenchmarkSession]) -> None:
    back = decode_sessions(sessions[0].split, encode_sessions(sessions))
    assert [s.seed for s in back] == [0, 1]
    for ours, theirs in zip(back, sessions, strict=True):
        for a, b in zip(ours.demonstrations, theirs.demonstrations, strict=True):
            for x, y in zip((*a.signs, a.hand, a.objects), (*b.signs, b.hand, b.objects), strict=True):
                np.testing.assert_allclose(x, y, rtol=0, atol=0.5001 * GRID)
            np.testing.assert_array_equal(a.times, b.times)
        for c, d in zip(ours.commands, theirs.commands, strict=True):
            for x, y in zip((*c.signs, c.objects, c.hand), (*d.signs, d.objects, d.hand), strict=True):
                np.testing.assert_allclose(x, y, rtol=0, atol=0.5001 * GRID)
            assert (c.request, c.family) == (d.request, d.family)
        for x, y in zip(ours.prototypes, theirs.prototypes, strict=True):
            np.testing.assert_allclose(x, y, rtol=0, atol=0.5001 * GRID)


def test_the_drawings_to_judge_by_are_found_again_in_the_paths(sessions: list[BenchmarkSession]) -> None:
    back = decode_sessions(sessions[0].split, encode_sessions(sessions))
    for ours, theirs in zip(back, sessions, strict=True):
        assert ours.truth.requests == theirs.truth.requests
        for a, b in zip(ours.truth.templates, theirs.truth.templates, strict=True):
            for x, y in zip(a, b, strict=True):
                np.testing.assert_allclose(x, y, rtol=0, atol=1.0001 * GRID)


def test_coding_again_changes_nothing(sessions: list[BenchmarkSession]) -> None:
    arrays = encode_sessions(sessions)
    assert digest(encode_sessions(decode_sessions(sessions[0].split, arrays))) == digest(arrays)


def test_nothing_that_an_entry_sees_can_be_written_to(sessions: list[BenchmarkSession]) -> None:
    (session, _) = decode_sessions(sessions[0].split, encode_sessions(sessions))
    seen = [*session.prototypes, *(a for c in session.commands for a in (*c.signs, c.objects, c.hand))]
    seen += [a for d in session.demonstrations for a in (*d.signs, d.objects, d.hand, d.times)]
    assert not any(array.flags.writeable for array in seen)


def test_the_digest_knows_every_number_but_not_the_byte_order(sessions: list[BenchmarkSession]) -> None:
    arrays = encode_sessions(sessions)
    swapped = {name: a.astype(a.dtype.newbyteorder(">")) for name, a in arrays.items()}
    assert digest(swapped) == digest(arrays)
    for name, array in arrays.items():
        changed = array.copy()
        changed.flat[-1] += 1
        assert digest(arrays | {name: changed}) != digest(arrays)
