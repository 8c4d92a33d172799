"""Sessions: what is composed, what the imitator does with it, and the verdicts."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from signimit.benchmark.scoring import judge_inference
from signimit.benchmark.statistics import Share
from signimit.evaluation import NOTHING
from signimit.exceptions import InvalidInputError
from signimit.inference import WordOrder
from signimit.learners import DEFAULT_METHOD
from signimit.policies import DEFAULT_POLICY
from signimit.strokes import StrokeLibrary
from signimit.teaching.people.choosing import People
from signimit.teaching.sessions import Command
from signimit_envs.sessions.many_sessions import repeats_paper, session_outcome, study_report, study_table
from signimit_envs.sessions.report import restarts_line, session_report, session_table, truth_text
from signimit_envs.sessions.scores import failing_stage, obeyed_shares, restart_grouping
from signimit_envs.sessions.session import SessionPlan, SessionResult, run_session

PLAN = SessionPlan()


def test_every_pair_is_asked_for_and_three_of_nine_were_never_shown(result: SessionResult) -> None:
    requests = [r.command.request for r in result.reproductions]
    assert requests == list(PLAN.language.requests)
    shown = set(result.session.truth.requests)
    assert shown == set(PLAN.language.seen)
    assert [request in shown for request in requests].count(False) == 3


def test_signs_of_commands_were_never_used_before(result: SessionResult) -> None:
    used = {s.tobytes() for d in result.session.demonstrations for s in d.signs}
    used |= {p.points.tobytes() for p in result.session.prototypes}
    heard = [s.tobytes() for r in result.reproductions for s in r.command.signs]
    assert not used & set(heard)
    assert len(set(heard)) == len(heard)


def test_the_simulated_hand_starts_where_it_is_put_and_goes_on_for_as_long_as_planned(result: SessionResult) -> None:
    for reproduction in result.reproductions:
        np.testing.assert_allclose(reproduction.answer.path[0], reproduction.command.hand, atol=1e-3)
        assert len(reproduction.answer.path) == len(reproduction.answer.joints) == result.plan.seconds * 50 + 1


def test_a_session_obeys_most_commands_when_its_inferences_are_right(result: SessionResult) -> None:
    assert judge_inference(result.model, result.session.truth).all_right
    assert obeyed_shares(result)["all"].count >= 8


@pytest.fixture(scope="module")
def report(results: dict[str, SessionResult], people: People[StrokeLibrary]) -> dict[str, Any]:
    return session_report(results, people)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_session_and_progress_is_told_command_by_command(
    results: dict[str, SessionResult], people: People[StrokeLibrary], report: dict[str, Any]
) -> None:
    result = results["ours"]
    seen = []

    def track(commands: Sequence[Command]) -> Iterator[Command]:
        for command in commands:
            seen.append(command.request)
            yield command

    again = run_session(result.plan, result.plan.compose(people), track)
    assert seen == list(result.plan.language.requests)
    for a, b in zip(result.reproductions, again.reproductions, strict=True):
        assert a.answer.path.tobytes() == b.answer.path.tobytes()
    assert session_report({**results, "ours": again}, people) == report


def test_the_seed_changes_the_session(people: People[StrokeLibrary]) -> None:
    first, second = (replace(PLAN, seed=s).compose(people).commands[0].hand for s in (0, 1))
    assert not np.array_equal(first, second)


@pytest.mark.parametrize("wrong", [{"seed": -1}, {"attempts": 0}, {"seconds": 0.5}, {"seconds": float("nan")}])
def test_a_plan_without_anything_to_see_is_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(InvalidInputError, match=next(iter(wrong))):
        replace(PLAN, **wrong)


def test_the_first_restart_is_the_sessions_own_grouping(result: SessionResult) -> None:
    assert restart_grouping(result, restarts=1) == Share(1, 1)
    assert restart_grouping(result, restarts=5).total == 5


def test_the_failing_stage_is_the_first_that_went_wrong(result: SessionResult, monkeypatch: pytest.MonkeyPatch) -> None:
    reproduction = result.reproductions[0]
    model, failed = result.model, reproduction._replace(performance=NOTHING)
    understood, answer = model.understanding, reproduction.answer
    labels, focus = np.zeros_like(model.labels), (model.focus + 1) % 3
    order = WordOrder(model.word_order.movement, model.word_order.focus)

    def stage(**changes: Any) -> str:
        other = replace(model, understanding=understood._replace(**changes))
        return failing_stage(SessionResult(result.plan, result.session, other, result.reproductions), failed)

    assert failing_stage(result, reproduction) == ""
    assert stage(labels=labels, focus=focus, word_order=order) == "grouping"
    assert stage(focus=focus, word_order=order) == "focus"
    assert stage(word_order=order) == "word order"
    assert failing_stage(result, failed._replace(answer=answer._replace(focus=(answer.focus + 1) % 3))) == "sign"
    assert failing_stage(result, failed) == "physics"  # a point obeys, so that only the arm is left
    monkeypatch.setattr("signimit_envs.sessions.scores.run_policy", lambda policy, hand, seconds: np.zeros((100, 2)))
    assert failing_stage(result, failed) == "policy"


def test_the_report_is_json_and_says_of_each_imitator_what_the_table_says(
    results: dict[str, SessionResult], report: dict[str, Any]
) -> None:
    plan = results["ours"].plan
    report = json.loads(json.dumps(report, allow_nan=False))
    assert report["format"] == 3
    assert report["plan"] == {"seed": plan.seed, "attempts": 1, "seconds": 6.0}
    assert (report["demonstrations"], report["commands"]) == (12, 9)
    assert {"python", "numpy", "mujoco", "mink", "platform"} <= set(report["versions"])
    assert list(report["imitators"]) == ["the paper", "ours"]
    table = session_table(results)
    for name, said in report["imitators"].items():
        assert (said["method"], said["policy"]) == (results[name].plan.method, results[name].plan.policy)
        assert said["inference"]["grouping right"]
        obeyed = sum(entry["obeyed"] for entry in said["reproductions"])
        assert said["obeyed"]["all"]["count"] == obeyed
        low, high = said["obeyed"]["all"]["wilson 95 %"]
        assert f"{obeyed} of 9 [{100 * low:.0f} to {100 * high:.0f} %]" in table
    assert restarts_line(results["the paper"]).startswith("Algorithm 1, paper, from 51 starts: right in ")


def test_both_imitators_saw_and_were_asked_the_same_and_the_paper_is_the_paper(
    results: dict[str, SessionResult],
) -> None:
    paper, ours = results["the paper"], results["ours"]
    assert (paper.plan.method, paper.plan.policy) == ("paper", "knn")
    assert (ours.plan.method, ours.plan.policy) == (DEFAULT_METHOD, DEFAULT_POLICY)
    assert paper.session is ours.session
    assert [r.command for r in paper.reproductions] == list(ours.session.commands)


def test_the_truth_is_told_demonstration_by_demonstration(result: SessionResult) -> None:
    truth = json.loads(truth_text(result.session))
    assert truth["word order"] == {"focus": 0, "movement": 1}
    names = [entry["movement"] for entry in truth["demonstrations"]]
    assert names == list(result.session.truth.movement_names)


def test_a_session_repeats_the_paper_if_all_is_obeyed_and_50_of_51_groupings_are_right(result: SessionResult) -> None:
    outcome = session_outcome(result)._replace(stages=(), restarts=Share(50, 51))
    assert repeats_paper(outcome)
    assert not repeats_paper(outcome._replace(restarts=Share(49, 51)))
    assert not repeats_paper(outcome._replace(stages=("sign",)))
    assert not repeats_paper(outcome._replace(verdict=outcome.verdict._replace(word_order=False)))


def test_a_study_adds_sessions_up_and_names_what_failed(result: SessionResult) -> None:
    outcome = session_outcome(result)
    failed = outcome._replace(
        seed=99, obeyed={k: Share(0, v.total) for k, v in outcome.obeyed.items()}, stages=("sign",) * 9
    )
    table = study_table([outcome, failed])
    assert "not obeyed because of sign: 9, in sessions 99 (9)" in table
    report = study_report([outcome, failed], "paper", "knn")
    assert report["shares"]["obeyed"]["total"] == 18
    assert [s["seed"] for s in report["sessions"]] == [result.plan.seed, 99]


def test_figures_of_the_paper_are_drawn_of_the_papers_session_only(
    results: dict[str, SessionResult], tmp_path: Path
) -> None:
    figures = pytest.importorskip("signimit_envs.sessions.figures", reason="figures need signimit[scripts]")
    with pytest.raises(InvalidInputError, match="method of the paper's session: expected one with Algorithm 1"):
        figures.write_figures(results["ours"], results["ours"], tmp_path)
    assert list(tmp_path.iterdir()) == []
