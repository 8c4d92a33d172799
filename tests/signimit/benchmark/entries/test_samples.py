"""What cloning learns from."""

import numpy as np

from signimit.benchmark.entries.samples import SIGN_SAMPLES, samples_of, utterance_features
from signimit.signs import normalised_sign
from signimit.teaching.sessions import Session


def test_every_moment_of_every_demonstration_is_there(paper_session: Session) -> None:
    demonstrations = paper_session.demonstrations
    samples = samples_of(demonstrations)
    for number, shown in enumerate(demonstrations):
        own = samples.demonstration == number
        assert np.array_equal(samples.hand[own], shown.hand)
        moved = (samples.velocity[own][:-1] + samples.velocity[own][1:]) / 2 * np.diff(shown.times)[:, None]
        np.testing.assert_allclose(shown.hand[0] + moved.sum(axis=0), shown.hand[-1], atol=0.02)


def test_an_utterance_is_described_free_of_place_and_size(paper_session: Session) -> None:
    signs = paper_session.demonstrations[0].signs
    moved = [3.0 * sign + 7.0 for sign in signs]
    np.testing.assert_allclose(utterance_features(moved), utterance_features(signs), atol=1e-9)


def test_the_distance_of_utterances_is_that_of_their_points(paper_session: Session) -> None:
    a, b = (paper_session.demonstrations[i].signs for i in (0, 1))
    points = [(normalised_sign(x, SIGN_SAMPLES), normalised_sign(y, SIGN_SAMPLES)) for x, y in zip(a, b, strict=True)]
    expected = sum(((x - y) ** 2).sum(axis=1).mean() for x, y in points)
    assert np.isclose(np.linalg.norm(utterance_features(a) - utterance_features(b)) ** 2, expected)
