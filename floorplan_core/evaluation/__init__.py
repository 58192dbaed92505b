"""Ground truth and metrics: how near a plan comes to the building.

>>> from floorplan_core.evaluation import evaluate
>>> print(evaluate(Path("plan.geojson"), Path("truth.json")).summary())          # doctest: +SKIP
"""

from floorplan_core.evaluation.compare import compare, evaluate
from floorplan_core.evaluation.plan_file import PlanFile, parse_plan, read_plan
from floorplan_core.evaluation.report import EvaluationReport
from floorplan_core.evaluation.truth import Truth
from floorplan_core.evaluation.truths import load_truth

__all__ = [
    "EvaluationReport",
    "PlanFile",
    "Truth",
    "compare",
    "evaluate",
    "load_truth",
    "parse_plan",
    "read_plan",
]
