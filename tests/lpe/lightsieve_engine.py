"""Lightsieve as an engine for `run_corpus.py`, through its Python package.

Also an example of how little an engine must do to be asked: read a JSON object a line, answer one.
"""

from __future__ import annotations

import json
import sys
from typing import Any

from lightsieve import LightsieveError, lpe


def answer(request: dict[str, Any]) -> dict[str, Any]:
    """The answer to one request of the runner."""
    reply: dict[str, Any] = {"id": request["id"]}
    if request["dialect"] != "arnold":
        return {**reply, "unsupported": f"the dialect {request['dialect']}"}
    try:
        expression = lpe.parse(request["expression"], lpe.Context(standard=request["standard"]))
    except LightsieveError as error:
        first = error.errors[0]
        return {**reply, "error": {"code": first.code, "column": first.column}}
    return {**reply, "verdicts": [expression.match(path) for path in request["paths"]]}


if __name__ == "__main__":
    for line in sys.stdin:
        print(json.dumps(answer(json.loads(line))), flush=True)
