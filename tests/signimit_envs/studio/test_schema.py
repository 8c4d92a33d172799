"""Whatever the API's own description allows, the server answers with a code and a sentence, and never fails."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

schemathesis = pytest.importorskip("schemathesis", reason="schemathesis is not installed (signimit[test])")
SLOW = r"film\.mp4|figures|scene\.jpg|similarities"  # have their own tests; they would only take long here


@pytest.fixture
def operations(page: Any) -> list[Any]:
    schema = schemathesis.openapi.from_dict(page.browser.get("openapi.json").json())
    return [found.ok() for found in schema.exclude(path_regex=SLOW).get_all_operations()]


@pytest.mark.slow
def test_no_request_that_the_description_allows_makes_the_server_fail(
    operations: list[Any], page: Any, session: Any
) -> None:
    assert len(operations) > 15
    seen: set[int] = set()

    def ask(case: Any) -> None:
        if "session_id" in (case.path_parameters or {}):
            case.path_parameters["session_id"] = session["id"]
        answer = case.call(base_url=page.address)
        seen.add(answer.status_code)
        assert answer.status_code < 500, answer.text
        if answer.status_code >= 400:
            assert set(json.loads(answer.content)) - {"revision"} == {"error"}

    how = settings(max_examples=3, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
    for operation in operations:
        fuzzed: Any = given(operation.as_strategy())
        how(fuzzed(ask))()
    assert {200, 201, 422} <= seen
