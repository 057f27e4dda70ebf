"""The standard figures, by matplotlib, which is imported only here."""

from ._read import ResultsError, as_rows

# What a table's score is made of: docs/runs.md.
_METRICS = {
    "zk16": "shading_event_ms",
    "tao21": "shading_ms",
    "tan05": "shading_ms",
    "effects": "shading_ms",
    "msbrdf": "simulate_500m_ms",
    "glints": "ns_per_px",
    "scaling": "ns_per_px",
}


def _axes(axes, height):
    if axes is not None:
        return axes
    from matplotlib import pyplot

    return pyplot.subplots(figsize=(9, height), layout="constrained")[1]


def _run(row):
    return f"{row['device']}, {row['lanes']} lanes, {str(row['date'])[:10]}"


def series(results, table, metric=None):
    """(metric, unit, {run: {case: median}}) of one metric of a table, the table's score metric by default."""
    metric = metric or _METRICS.get(table)
    runs, unit = {}, None
    for row in as_rows(results):
        if row["table"] == table and row["metric"] == metric and row["median"] == row["median"]:
            runs.setdefault(_run(row), {})[row["case"]] = row["median"]
            unit = row["unit"]
    if not runs:
        raise ResultsError(f"no record of metric {metric!r} in table {table!r}")
    return metric, unit, runs


def plot(results, table, metric=None, axes=None):
    """Bars of a metric over the table's cases, a colour per run, on a logarithmic scale; returns the axes."""
    metric, unit, runs = series(results, table, metric)
    cases = list(dict.fromkeys(case for values in runs.values() for case in values))
    axes = _axes(axes, 1.2 + 0.28 * len(cases) * max(1, len(runs)) ** 0.5)
    height = 0.8 / len(runs)
    for index, (run, values) in enumerate(runs.items()):
        at = [y + (index - (len(runs) - 1) / 2) * height for y in range(len(cases))]
        axes.barh(at, [values.get(case, float("nan")) for case in cases], height, label=run)
    axes.set_yticks(range(len(cases)), cases)
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xlabel(metric if unit in ("", "1") else f"{metric} [{unit}]")
    axes.legend(fontsize="small", loc="lower left", bbox_to_anchor=(0, 1))
    return axes


def pareto(points):
    """Those of (cost, error, name) that no other beats in both, by rising cost."""
    front, best = [], float("inf")
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            front.append(point)
    return front


def tradeoff(results, effect, axes=None):
    """Error over time of the settings of an effect in table `accuracy`, its Pareto front; returns the axes."""
    cases = {}
    for row in as_rows(results):
        # What has more parts is of one scene, or one kind of pixels.
        parts = row["case"].split("/")
        if row["table"] == "accuracy" and len(parts) == 2 and parts[0] == effect:
            cases.setdefault(parts[1], {})[row["metric"]] = row["median"]
    points = [
        (values["time_ratio"], values["error"], name)
        for name, values in cases.items()
        if values.get("time_ratio", 0) > 0 and values.get("error", 0) > 0
    ]
    if not points:
        raise ResultsError(f"no setting of {effect!r} in table 'accuracy' has a time and an error")
    axes = _axes(axes, 5)
    axes.scatter([p[0] for p in points], [p[1] for p in points], s=14)
    front = pareto(points)
    axes.plot([p[0] for p in front], [p[1] for p in front], "--", linewidth=1)
    for cost, error, name in front:
        axes.annotate(name, (cost, error), fontsize="x-small")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("time / default")
    axes.set_ylabel("error")
    return axes
