"""Lightsieve as an engine for `run_corpus.py`, through its Python package.

Also an example of how little an engine must do to be asked: read a JSON object a line, answer one.
"""

from __future__ import annotations

import json
import sys
from functools import cache
from typing import Any

from lightsieve import LightsieveError, lpe


@cache
def context(standard: bool) -> lpe.Context:
    """What expressions are read in."""
    return lpe.Context(standard=standard)


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """The answer to one request of the runner."""
    reply: dict[str, Any] = {"id": request["id"]}
    if request["dialect"] != "arnold" or request["notation"] != "arnold":
        return {**reply, "unsupported": "other dialects and their notation of paths"}
    names = context(request["standard"])
    # `parse` also takes the name of an AOV for its expression; behind a blank it is only a text.
    moved = 1 if request["expression"] in names.names else 0
    try:
        expression = lpe.parse(" " * moved + request["expression"], names)
    except LightsieveError as error:
        first = error.errors[0]
        return {**reply, "error": {"code": first.code, "column": (first.column or 0) - moved}}
    return {**reply, "verdicts": [expression.match(path) for path in request["paths"]]}


if __name__ == "__main__":
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), flush=True)
