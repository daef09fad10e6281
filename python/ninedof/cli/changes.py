"""The option --set: values of variables, or changes by per cent."""

from __future__ import annotations

from collections.abc import Sequence


def changes_option(texts: Sequence[str]) -> dict[str, float | str]:
    """Return the values of NAME=VALUE, and the texts of NAME=+10%."""
    changes: dict[str, float | str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals or name in changes:
            raise ValueError(f"--set: got {text!r}, expected NAME=VALUE or NAME=+10%, each name once")
        changes[name] = value if value.endswith("%") else _number(text, value)
    return changes


def _number(text: str, value: str) -> float:
    try:
        if value.startswith("+"):
            raise ValueError
        return float(value)
    except ValueError:
        raise ValueError(f"--set: got {text!r}, expected NAME=VALUE without a plus, or NAME=+10%") from None
