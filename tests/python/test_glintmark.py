"""The package python/glintmark on results files, with and without pandas and matplotlib."""

import importlib.util
import json
import math
import os
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["GLINTMARK_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "python"))

import glintmark  # noqa: E402
from glintmark._figures import pareto, series  # noqa: E402


def has(module):
    return importlib.util.find_spec(module) is not None


class Read(unittest.TestCase):
    def test_published_results(self):
        rows = glintmark.read(SOURCE / "results", frame=False)
        files = list((SOURCE / "results").rglob("results.json"))
        self.assertEqual(len(rows), sum(len(json.loads(file.read_text())["records"]) for file in files))
        self.assertEqual(rows, sorted(rows, key=lambda row: row["date"]))
        one = [
            row for row in rows
            if row["device"] == "NVIDIA H200" and row["case"] == "sponza/grazing" and row["metric"] == "shading_ms"
            and row["table"] == "zk16"
        ]
        self.assertEqual(len(one), 1)
        self.assertEqual(one[0]["unit"], "ms")
        self.assertEqual(one[0]["paper"], 5.9)
        self.assertEqual(one[0]["lanes"], 1)
        self.assertEqual(one[0]["config.size"], "1920x1080")
        self.assertEqual(glintmark.units(rows)["zk16", "ns_per_cell"], "ns")

    def test_bad_input_is_one_sentence(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "results.json"
            for text in (None, "{", "[]", '{"schema": "glintmark.results/9"}', '{"schema": "glintmark.results/1"}'):
                if text is not None:
                    file.write_text(text)
                with self.assertRaises(glintmark.ResultsError) as raised:
                    glintmark.read(folder, frame=False)
                self.assertIn(folder, str(raised.exception))
                self.assertNotIn("\n", str(raised.exception))

    def test_null_is_nan(self):
        source = json.loads(next((SOURCE / "results").rglob("results.json")).read_text())
        source["records"] = source["records"][:1]
        source["records"][0].update(median=None, paper=None)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "results.json").write_text(json.dumps(source))
            row = glintmark.read(folder, frame=False)[0]
        self.assertTrue(math.isnan(row["median"]) and math.isnan(row["paper"]))

    @unittest.skipUnless(has("pandas"), "pandas is not installed")
    def test_frame(self):
        frame = glintmark.read(SOURCE / "results")
        rows = glintmark.read(SOURCE / "results", frame=False)
        self.assertEqual(len(frame), len(rows))
        self.assertEqual(frame.attrs["units"], glintmark.units(rows))
        self.assertEqual(frame["median"].dtype.kind, "f")


class Figures(unittest.TestCase):
    def test_series_have_a_run_each(self):
        rows = glintmark.read(SOURCE / "results", frame=False)
        metric, unit, runs = series(rows, "zk16")
        self.assertEqual((metric, unit), ("shading_event_ms", "ms"))
        self.assertGreaterEqual(len(runs), 3)
        self.assertTrue(all("snow/steep" in values for values in runs.values()))
        with self.assertRaises(glintmark.ResultsError):
            series(rows, "zk16", "none")

    def test_front(self):
        points = [(2, 1, "c"), (1, 3, "a"), (3, 2, "worse"), (1.5, 2, "b"), (4, 1, "slower")]
        self.assertEqual([name for _, _, name in pareto(points)], ["a", "b", "c"])

    def test_metrics_are_the_programs_scores(self):
        from glintmark._figures import _METRICS

        found = {}
        for file in (SOURCE / "host/experiment").rglob("*_table.cpp"):
            text = file.read_text()
            if ".score = " in text:
                found[text.split('.name = "')[1].split('"')[0]] = text.split('.score = "')[1].split('"')[0]
        self.assertEqual(_METRICS, found)

    @unittest.skipUnless(has("matplotlib"), "matplotlib is not installed")
    def test_draws(self):
        import matplotlib

        matplotlib.use("Agg")
        rows = glintmark.read(SOURCE / "results", frame=False)
        self.assertEqual(len(glintmark.plot(rows, "zk16").containers), len(series(rows, "zk16")[2]))
        self.assertEqual(glintmark.tradeoff(rows, "gmm").get_xscale(), "log")


if __name__ == "__main__":
    unittest.main()
