"""Every public name under attack: what a call gets in place of each argument is taken, or refused in one good line."""

import pytest
from entry_engine import attack
from entry_rows import ROWS
from sizes import LONG


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    """Texts are names of files too."""
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("name", ROWS)
def test_every_argument_is_taken_or_refused_by_name(name):
    tally = attack(name, ROWS[name], 0 if LONG else None)
    print(f"{name}: {tally.tried} tried, {tally.taken} taken, {len(tally.failures)} failures")
    assert not tally.failures, "\n".join([f"{len(tally.failures)} of {tally.tried}:", *tally.failures[:20]])
    assert tally.tried > 0
