"""How long the engine's answers take: within Python, and as commands with their start-up.

    python bench/lpe_questions.py

Prints the slowest of each kind over the built-in AOVs: [ms] within Python (best of three), and CPU
seconds of a whole process, which do not depend on what else the machine does.
"""

from __future__ import annotations

import itertools
import resource
import subprocess
import sys
import time
from collections.abc import Callable

from lightsieve import lpe

N_TRIES = 3
N_RUNS = 5
COMMANDS = [
    ["explain", "diffuse"],
    ["partition", "direct", "indirect", "emission", "background"],
    ["rest", "diffuse", "specular"],
    ["compare", "sheen", "specular"],
    ["graph", "direct", "indirect"],
]


def milliseconds(question: Callable[[], object]) -> float:
    """The best of a few tries."""
    times = []
    for _ in range(N_TRIES):
        start = time.perf_counter()
        question()
        times.append(time.perf_counter() - start)
    return 1000 * min(times)


def questions() -> dict[str, list[tuple[float, str]]]:
    """Every question about the built-ins, with its time and what was asked."""
    names = [row.name for row in lpe.builtins()]
    sets = lpe.additive_sets()
    subsets = [part for of in sets for n in (1, 2, 3) for part in itertools.combinations(of, n)]
    return {
        "explain": [(milliseconds(lambda n=n: lpe.explain(n)), n) for n in names],
        "graph": [(milliseconds(lambda n=n: lpe.graph(n)), n) for n in names],
        "compare": [
            (milliseconds(lambda a=a, b=b: lpe.compare(a, b)), f"{a} {b}")
            for a, b in itertools.product(names, names)
        ],
        "partition": [(milliseconds(lambda s=s: lpe.partition(*s)), " ".join(s)) for s in sets],
        "rest": [(milliseconds(lambda s=s: lpe.rest(*s)), " ".join(s)) for s in subsets],
    }


def process_seconds(command: list[str]) -> float:
    """CPU time of a command, the best of a few runs."""
    times = []
    for _ in range(N_RUNS):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(
            [sys.executable, "-m", "lightsieve", "lpe", *command],
            stdout=subprocess.DEVNULL,
            check=True,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(times)


def main() -> None:
    """Measures and prints."""
    for kind, asked in questions().items():
        slowest, what = max(asked)
        print(f"{kind:10} {len(asked):5} questions, slowest {slowest:6.2f} ms: {what}")
    for command in COMMANDS:
        print(f"lightsieve lpe {' '.join(command):50} {process_seconds(command):5.2f} s of CPU")


if __name__ == "__main__":
    main()
