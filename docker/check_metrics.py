"""Checks the dashboard, and that every metric which dashboard, alerts and autoscalers name is in a text of /metrics.

python3 docker/check_metrics.py [METRICS]; without the text only the dashboard's form is checked.
"""

import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
NAME = re.compile(r"\bverne_[a-z0-9_]+\b")
# Made of others by the adapter's rule.
DERIVED = {"verne_jobs_open"}


def dashboard() -> list[str]:
    """The expressions of the dashboard, which must be one that Grafana shows."""
    board = json.loads((HERE / "grafana/verne.json").read_text())
    panels = board["panels"]
    assert panels and len({panel["id"] for panel in panels}) == len(panels), "each panel has an id of its own"
    sources = (HERE / "grafana/provisioning/datasources/prometheus.yaml").read_text()
    expressions = []
    for panel in panels:
        place = panel["gridPos"]
        assert place["x"] + place["w"] <= 24, f"{panel['title']} is wider than the page"
        assert f"uid: {panel['datasource']['uid']}" in sources, f"{panel['title']} asks a source that is not there"
        assert panel["targets"], f"{panel['title']} shows nothing"
        expressions += [target["expr"] for target in panel["targets"]]
    return expressions


def rules(path: str) -> list[str]:
    """The lines of a file that hold expressions."""
    lines = (HERE / path).read_text().splitlines()
    return [line for line in lines if re.search(r"(expr|query|metricsQuery|seriesQuery): ", line)]


def series(text: str) -> set[str]:
    """What can be asked for: the names of samples, and of metrics without any."""
    names = {re.split(r"[{ ]", line)[0] for line in text.splitlines() if line and not line.startswith("#")}
    for kind in re.finditer(r"^# TYPE (\S+) (\S+)$", text, re.MULTILINE):
        ends = {"counter": ["_total"], "histogram": ["_bucket", "_sum", "_count"]}.get(kind[2], [""])
        names |= {kind[1] + end for end in ends}
    return names


def main() -> None:
    expressions = dashboard()
    for path in ("prometheus/alerts.yml", "kubernetes/autoscaling.yaml", "kubernetes/hpa.yaml"):
        found = rules(path)
        assert found, f"{path} holds no expression"
        expressions += found
    named = {name for expression in expressions for name in NAME.findall(expression)} - DERIVED
    assert named, "no metric is named"
    if len(sys.argv) > 1:
        missing = named - series(Path(sys.argv[1]).read_text())
        if missing:
            sys.exit(f"no such metric: {', '.join(sorted(missing))}")
    print(f"{len(named)} metrics in {len(expressions)} expressions")


if __name__ == "__main__":
    main()
