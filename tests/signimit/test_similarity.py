"""The distance of two policies: against the plain loops of the paper, by hand, and what it does not depend on."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from signimit import InvalidInputError, maximum_similarities, policy_distances, policy_similarities
from signimit.similarity import DISTANCE_FLOOR, directed_points

Array = NDArray[np.float64]
scenes = st.tuples(st.integers(1, 4), st.integers(1, 3), st.integers(0, 10_000))
properties = settings(deadline=None, derandomize=True, max_examples=25)


def random_scene(count: int, objects: int, seed: int) -> tuple[list[Array], Array]:
    rng = np.random.default_rng(seed)
    paths = [rng.normal(0.0, 0.03, (int(rng.integers(2, 20)), 2)).cumsum(axis=0) for _ in range(count)]
    return paths, rng.uniform(-0.2, 0.2, (count, objects, 2))


def slow_distances(paths: list[Array], objects: Array) -> Array:
    """The paper's quadruple loop over t, k, i, j, and one over the points p."""
    count, frames = objects.shape[:2]
    one_way = np.zeros((count, count, frames, frames))
    for t, k, i, j in np.ndindex(one_way.shape):
        for p, step in zip(paths[t][:-1], np.diff(paths[t], axis=0), strict=True):
            gaps = np.hypot(*((p - objects[t, i]) - (paths[k][:-1] - objects[k, j])).T)
            other = np.diff(paths[k], axis=0)[gaps.argmin()]
            angle = np.arctan2(step[1], step[0]) - np.arctan2(other[1], other[0])
            one_way[t, k, i, j] += ((angle + np.pi) % (2 * np.pi) - np.pi) ** 2 / (len(paths[t]) - 1)
    return np.minimum(one_way, one_way.transpose(1, 0, 3, 2))


@pytest.mark.parametrize("count", [1, 2, 5])
@pytest.mark.parametrize("objects", [1, 3])
def test_the_distance_is_that_of_the_plain_loops(count: int, objects: int) -> None:
    for seed in range(4):
        paths, places = random_scene(count, objects, seed)
        np.testing.assert_allclose(policy_distances(paths, places), slow_distances(paths, places), atol=1e-12, rtol=0)


def test_paths_longer_than_a_block_are_no_different() -> None:
    rng = np.random.default_rng(0)
    paths = [rng.normal(0.0, 0.01, (n, 2)).cumsum(axis=0) for n in (400, 30)]
    places = rng.uniform(-0.2, 0.2, (2, 2, 2))
    np.testing.assert_allclose(policy_distances(paths, places), slow_distances(paths, places), atol=1e-12, rtol=0)


def test_the_work_is_told_in_pairs_of_points_over_all_pairs_of_frames(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[tuple[str, float]] = []

    def none(module: str, seconds: float) -> None:
        asked.append((module, seconds))

    monkeypatch.setattr("signimit.similarity.find_twin", none)
    policy_distances([np.eye(2), np.diag([1.0, 1.0, 2.0])[:, :2]], np.zeros((2, 3, 2)))
    # 1 and 2 directed points, each about 3 objects: (3 (1 + 2))² pairs of points, a nanosecond each
    ((module, seconds),) = asked
    assert module == "signimit.similarity_numba"
    assert seconds == pytest.approx(81e-9)


def test_a_right_angle_by_hand() -> None:
    right, up = np.array([[0, 0], [1, 0], [2, 0]]), np.array([[0, 0], [0, 1]])
    distance = policy_distances([right, up], np.zeros((2, 1, 2)))[:, :, 0, 0]
    np.testing.assert_allclose(distance, [[0, (np.pi / 2) ** 2], [(np.pi / 2) ** 2, 0]], atol=1e-15)


def test_one_way_back_is_closer_than_the_other_by_hand() -> None:
    corner = np.array([[0, 0], [1, 0], [1, 1]])  # goes right at (0, 0), up at (1, 0)
    right = np.array([[0, 0], [0.4, 0]])  # goes right at (0, 0)
    # from the corner: (0² + (π/2)²) / 2; from the short one, its only point is nearest to the corner's first: 0
    assert policy_distances([corner, right], np.zeros((2, 1, 2)))[0, 1, 0, 0] == 0.0
    # about the second object of the corner at (1, 0), the short path is nearest to where the corner goes up
    objects = [[[0, 0], [1, 0]], [[0, 0], [9, 9]]]
    assert policy_distances([corner, right], objects)[0, 1, 1, 0] == pytest.approx((np.pi / 2) ** 2 / 2)


def test_angles_are_compared_the_short_way_round() -> None:
    almost_left, also = np.array([[0, 0], [-1, 0.1]]), np.array([[0, 0], [-1, -0.1]])
    expected = (2 * np.arctan2(0.1, 1)) ** 2
    assert policy_distances([almost_left, also], np.zeros((2, 1, 2)))[0, 1, 0, 0] == pytest.approx(expected)


@properties
@given(scenes)
def test_swapping_paths_and_frames_changes_nothing(scene: tuple[int, int, int]) -> None:
    distances = policy_distances(*random_scene(*scene))
    assert np.array_equal(distances, distances.transpose(1, 0, 3, 2))


@properties
@given(scenes)
def test_a_path_in_one_frame_is_at_no_distance_from_itself(scene: tuple[int, int, int]) -> None:
    distances = policy_distances(*random_scene(*scene))
    assert not np.einsum("ttii->ti", distances).any()
    assert (distances >= 0).all()
    assert (distances <= np.pi**2).all()


@properties
@given(scenes, st.floats(-1000, 1000), st.floats(-1000, 1000))
def test_moving_a_scene_with_its_path_changes_nothing(scene: tuple[int, int, int], x: float, y: float) -> None:
    paths, places = random_scene(*scene)
    moved = [paths[0] + [x, y], *paths[1:]]
    places_moved = places.copy()
    places_moved[0] += [x, y]
    np.testing.assert_allclose(policy_distances(moved, places_moved), policy_distances(paths, places), atol=1e-6)


@properties
@given(scenes)
def test_demonstrations_and_objects_in_another_order_give_the_same_numbers_there(scene: tuple[int, int, int]) -> None:
    paths, places = random_scene(*scene)
    rng = np.random.default_rng(scene[2])
    order, frames = rng.permutation(scene[0]), rng.permutation(scene[1])
    permuted = policy_distances([paths[t] for t in order], places[order][:, frames])
    original = policy_distances(paths, places)
    np.testing.assert_allclose(permuted, original[np.ix_(order, order, frames, frames)], atol=1e-12)


@properties
@given(scenes, st.floats(0.1, 10), st.floats(-np.pi, np.pi))
def test_turning_and_scaling_everything_changes_nothing(scene: tuple[int, int, int], size: float, angle: float) -> None:
    paths, places = random_scene(*scene)
    turn = size * np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    turned = policy_distances([p @ turn.T for p in paths], places @ turn.T)
    np.testing.assert_allclose(turned, policy_distances(paths, places), atol=1e-9)


def test_a_resting_hand_has_no_direction() -> None:
    moving = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    resting = np.repeat(moving, [3, 1, 4], axis=0)
    assert directed_points(resting).positions.tolist() == [[0, 0], [1, 0]]
    assert directed_points(resting).angles.tolist() == [0.0, np.pi / 2]
    assert policy_distances([moving, resting], np.zeros((2, 1, 2)))[0, 1, 0, 0] == 0.0


def test_similarity_is_the_inverse_and_stays_finite() -> None:
    distances = np.array([[[[0.0]], [[0.5]]], [[[0.5]], [[0.0]]]])
    assert policy_similarities(distances)[0, 1, 0, 0] == 2.0
    assert policy_similarities(distances)[0, 0, 0, 0] == 1 / DISTANCE_FLOOR
    assert maximum_similarities(distances).tolist() == [[0, 2], [2, 0]]


def test_the_best_pair_of_frames_counts() -> None:
    distances = np.full((2, 2, 2, 2), 4.0)
    distances[0, 1, 0, 1] = distances[1, 0, 1, 0] = 0.25
    assert maximum_similarities(distances).tolist() == [[0, 4], [4, 0]]


def test_inputs_may_be_read_only_and_are_not_written_to() -> None:
    paths, places = random_scene(3, 2, 0)
    for array in (*paths, places):
        array.setflags(write=False)
    distances = policy_distances(paths, places)
    distances.setflags(write=False)
    maximum_similarities(distances)


PATH = np.array([[0.0, 0.0], [1.0, 0.0]])


@pytest.mark.parametrize(
    ("paths", "objects", "sentence"),
    [
        ([], np.zeros((0, 1, 2)), "paths: expected at least one, found none."),
        (3, np.zeros((1, 1, 2)), "paths: expected a list, found int."),
        ([PATH, PATH[:1]], np.zeros((2, 1, 2)), "demonstration 1: path: expected at least 2 points, found 1."),
        ([PATH, 0 * PATH], np.zeros((2, 1, 2)), "demonstration 1: path: expected points that move, found 2 points"),
        ([PATH], np.zeros((2, 1, 2)), "objects: expected numbers of shape (1, n, 2), found shape (2, 1, 2)."),
        ([PATH], np.zeros((1, 0, 2)), "objects: expected at least one in each demonstration, found none."),
        ([PATH], [[[0, np.inf]]], "objects: expected finite numbers, found inf at index (0, 0, 1)."),
    ],
)
def test_what_has_no_distance_is_told(paths: Any, objects: Any, sentence: str) -> None:
    with pytest.raises(InvalidInputError) as caught:
        policy_distances(paths, objects)
    assert sentence in str(caught.value)


@pytest.mark.parametrize(
    "distances", [np.zeros((2, 2)), np.zeros((2, 3, 1, 1)), np.zeros((2, 2, 1, 2)), np.zeros((0, 0, 1, 1))]
)
def test_a_table_of_another_shape_is_refused(distances: Array) -> None:
    with pytest.raises(InvalidInputError, match="distances: expected"):
        maximum_similarities(distances)


def test_two_demonstrations_that_are_the_same_are_alike_without_a_limit_being_passed() -> None:
    distances = policy_distances([PATH, PATH], np.zeros((2, 1, 2)))
    assert maximum_similarities(distances)[0, 1] == 1 / DISTANCE_FLOOR


def test_objects_on_top_of_each_other_are_the_same_frame() -> None:
    paths, places = random_scene(3, 2, 0)
    places[:, 1] = places[:, 0]
    distances = policy_distances(paths, places)
    assert np.array_equal(distances[..., 0, 0], distances[..., 1, 1])
    assert np.array_equal(distances[..., 0, 1], distances[..., 1, 0])
