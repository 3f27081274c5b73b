"""Every parameter that claims to act does, as its probe predicts; the others say why not."""

from __future__ import annotations

from pathlib import Path

import pytest

from lightsieve.scene import Node
from tests.probes.predictions import judge
from tests.probes.probing import Renderer, all_nodes, probed_params, probes

NODES = list(all_nodes().values())


@pytest.mark.parametrize("node", NODES, ids=[node.name for node in NODES])
def test_parameters_act_as_predicted(node: Node, tmp_path: Path) -> None:
    renderer = Renderer(tmp_path)
    wrong = [text for probe in probes(node) if (text := judge(probe, renderer))]
    assert not wrong, "\n" + "\n".join(wrong)


def test_every_parameter_that_claims_to_act_has_a_probe() -> None:
    missing = [
        f"{node.name}.{param.name}"
        for node in NODES
        for param in node.params
        if param.status == "supported" and param.name not in probed_params(node)
    ]
    assert not missing, f"{len(missing)} without a probe in tests/probes/tables: {missing}"
