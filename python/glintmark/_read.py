"""Reading folders of results; the schema is described in results/README.md."""

import json
import math
from pathlib import Path

SCHEMA = "glintmark.results/1"

# Of the run, in every row; "lanes" is what files call "width".
_RUN = ("device", "driver", "platform", "cpu", "cores", "date", "git", "peak_gflops", "peak_gbs", "busy")
_RECORD = ("table", "case", "metric", "unit", "median", "min", "p95", "stddev", "n", "paper", "valid", "note", "timer")
_NUMBERS = ("median", "min", "p95", "stddev", "paper")


class ResultsError(ValueError):
    """A folder or file that holds no results this module can read; the message is one sentence."""


def _files(path):
    path = Path(path)
    if path.is_file():
        return [path]
    files = sorted(path.rglob("results.json")) if path.is_dir() else []
    if not files:
        raise ResultsError(f"{path} is no results.json and no folder that has one in or below it")
    return files


def _load(file):
    try:
        results = json.loads(file.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ResultsError(f"{file} is not valid JSON or was cut off ({error})") from error
    schema = results.get("schema") if isinstance(results, dict) else None
    if schema != SCHEMA:
        raise ResultsError(f"{file} has schema {schema!r}, but this module reads {SCHEMA!r}")
    return results


def _rows(file):
    results = _load(file)
    try:
        run = {key: results["run"].get(key, "" if key == "busy" else None) for key in _RUN}
        run["lanes"] = results["run"]["width"]
        for record in results["records"]:
            row = {"source": str(file), **run, **{key: record.get(key) for key in _RECORD}}
            for key in _NUMBERS:
                row[key] = math.nan if row[key] is None else float(row[key])
            row.update({f"config.{key}": value for key, value in record["config"].items()})
            yield row
    except (KeyError, TypeError, AttributeError) as error:
        raise ResultsError(f"{file} lacks a field or has one of the wrong type ({error})") from error


def read(*paths, frame=None):
    """All records of the results files at or below the paths, oldest run first.

    Columns: source, those of the run (device, driver, lanes, date ...), those of a record (table, case,
    metric, unit, median, min, p95, stddev, n, paper, valid, note, timer) and "config.<key>" for each key of
    its configuration. Values are in the row's `unit`; what was not measured is NaN.

    frame: True for a pandas DataFrame, False for a list of dictionaries; by default as pandas is installed.
    """
    rows = [row for path in paths for file in _files(path) for row in _rows(file)]
    rows.sort(key=lambda row: row["date"] or "")
    if frame is False:
        return rows
    try:
        import pandas
    except ImportError:
        if frame:
            raise
        return rows
    table = pandas.DataFrame(rows)
    table.attrs["units"] = units(rows)
    return table


def as_rows(results):
    """The rows of what read() returned."""
    return results if isinstance(results, list) else results.to_dict("records")


def units(results):
    """The unit of every (table, metric)."""
    return {(row["table"], row["metric"]): row["unit"] for row in as_rows(results)}
