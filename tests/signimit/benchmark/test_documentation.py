"""The page on the benchmark says what the code does."""

from pathlib import Path

import pytest

from signimit.benchmark.splits import SPLITS
from signimit.benchmark.statistics import STAGES

PAGE = Path(__file__).parents[3] / "docs" / "benchmark.md"


@pytest.fixture(scope="module")
def page() -> list[str]:
    if not PAGE.exists():
        pytest.skip("the documentation is not part of what is installed here")
    return PAGE.read_text(encoding="utf-8").splitlines()


def test_every_split_and_every_score_is_described_as_the_code_does(page: list[str]) -> None:
    for split in SPLITS.values():
        assert f"| `{split.name}` | {split.change} |" in page
    for stage in STAGES.values():
        assert f"| {stage.title} | {stage.meaning} |" in page
