"""What the paper's method needs: the promises of the study, on few sessions."""

from dataclasses import replace

import numpy as np

from signimit.benchmark.scoring import same_partition
from signimit.benchmark.studies.paper_conditions import (
    RUNS,
    group_many_times,
    judge_groups,
    judge_policy,
    run_ideal_gamma,
    run_levels,
    score_levels,
)
from signimit.benchmark.studies.paper_levels import (
    Level,
    factor_levels,
    ladder_levels,
    policy_levels,
    sense_levels,
    study_levels,
)
from signimit.benchmark.studies.varied_demonstrations import (
    CIRCLE_AGAINST,
    ONE_SENSE,
    Variation,
    choose_mover,
    compose_varied,
)
from signimit.grouping import group_movements

SEEDS = (0, 1, 2)


def right_runs(variation: Variation, first: str = "random") -> float:
    results = [judge_groups(compose_varied(choose_mover(None, s), variation, s), first, s) for s in SEEDS]
    return sum(r.right for r in results) / (len(SEEDS) * RUNS)


def test_many_runs_at_once_are_the_runs_of_algorithm_1() -> None:
    rng = np.random.default_rng(0)
    movement = np.repeat(np.arange(3), 4)
    gamma = np.where(movement[:, None] == movement, 2.5, 1.0) * np.exp(0.5 * rng.normal(size=(12, 12)))
    gamma = gamma + gamma.T
    np.fill_diagonal(gamma, 0.0)
    seeds = range(20)
    alone = [group_movements(gamma, rng=seed).labels for seed in seeds]
    for together, one in zip(group_many_times(gamma, seeds), alone, strict=True):
        assert same_partition(together, one)


def test_ideal_movements_with_the_circle_against_are_told_apart_by_most_runs() -> None:
    assert right_runs(Variation(shape="ideal", senses=CIRCLE_AGAINST)) > 0.7


def test_what_people_draw_in_one_sense_is_merged_and_the_circle_is_in_it() -> None:
    for seed in SEEDS:
        session = compose_varied(choose_mover(None, seed), Variation(senses=ONE_SENSE), seed)
        result = judge_groups(session, "random", seed)
        assert result.right < 0.2 * RUNS
        assert result.circle_merged > 0.8 * RUNS


def test_evenly_spaced_points_help() -> None:
    usual = Variation(senses=ONE_SENSE)
    assert right_runs(replace(usual, pace="even")) > right_runs(usual) + 0.2


def test_nearest_points_draw_better_after_reaches_that_glide_into_the_movement() -> None:
    shares = []
    for reach in ("to the beginning", "to the nearest point"):
        level = Level("", "", Variation(reach=reach, density=2.5))
        verdicts = [judge_policy(compose_varied(choose_mover(None, s), level.variation, s), level, s) for s in SEEDS]
        shares.append(sum(obeyed for _, obeyed, _ in verdicts))
    assert shares[1] > shares[0]


def test_made_up_similarities_are_grouped_right_where_contrast_is_high_and_spread_low() -> None:
    good, flat, uneven = run_ideal_gamma((5.0, 1.2, 2.0), (0.1,), matrices=2)
    assert good.right > 0.9 * good.runs
    assert flat.right < 0.2 * flat.runs
    assert good.right > uneven.right > flat.right


def test_the_same_seeds_give_the_same_results_and_scores_have_intervals() -> None:
    levels = [*sense_levels()[2:], *policy_levels()[:1]]
    alone, again = (list(run_levels(levels, 2)) for _ in range(2))
    assert str(alone) == str(again)  # NaN is not equal to itself
    scores = score_levels([row for rows in alone for row in rows])
    assert [(s.sessions, s.people) for s in scores] == [(2, "built-in")] * 3
    assert all(s.right_low <= s.right <= s.right_high for s in scores)
    assert np.isnan(scores[0].obeyed)
    assert 0 <= scores[1].obeyed_low <= scores[1].obeyed <= scores[1].obeyed_high <= 1


def test_every_factor_has_the_usual_value_and_the_ladder_ends_with_all_conditions() -> None:
    levels = factor_levels(CIRCLE_AGAINST)
    for factor in {level.factor for level in levels}:
        usual = [x for x in levels if x.factor == factor and (x.variation, x.first) == (Variation(), "random")]
        assert len(usual) == 1
    top = [x for x in ladder_levels() if x.factor == "added one by one"][-1]
    assert (top.variation.pace, top.variation.senses, top.first, top.steady) == (
        "even",
        (1, 1, -1),
        "near identity",
        True,
    )
    keys = [(x.variation.senses, x.factor, x.value) for x in study_levels()]
    assert len(keys) == len(set(keys))
