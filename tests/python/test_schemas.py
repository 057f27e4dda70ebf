"""What the program writes is as docs/schema/ says. GLINTMARK_PROGRAM and GLINTMARK_SOURCE_DIR are set by ctest."""

import copy
import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from json_schema import faults

SOURCE = Path(os.environ["GLINTMARK_SOURCE_DIR"])
SCHEMAS = {
    schema["properties"]["schema"]["const"]: schema
    for schema in (json.loads(file.read_text()) for file in sorted((SOURCE / "docs/schema").glob("*.json")))
}


def faults_of(document):
    return faults(document, SCHEMAS[document["schema"]])


class Written(unittest.TestCase):
    """By the program, now."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_program(self, *arguments, json_option="--json", codes=(0,)):
        file = Path(self.folder.name) / "out.json"
        done = subprocess.run(
            [os.environ["GLINTMARK_PROGRAM"], *arguments, json_option, str(file)],
            capture_output=True, text=True, check=False)
        self.assertIn(done.returncode, codes, done.stderr)
        document = json.loads(file.read_text())
        self.assertEqual(faults_of(document), [])
        return document

    def test_comparisons(self):
        runs = sorted(str(file) for file in (SOURCE / "results").glob("*/2026-11-2[26]/results.json"))
        self.assertGreaterEqual(len(runs), 3)
        two = self.run_program("compare", "--across-devices", runs[0], runs[1], codes=(0, 1))
        self.assertGreater(len(two["comparisons"]), 10)
        many = self.run_program("compare", "--across-devices", *runs, codes=(0, 1))
        self.assertEqual(len(many["others"]), len(runs) - 1)

    def test_difference(self):
        picture = str(SOURCE / "docs/hero.png")
        self.run_program("diff", picture, picture)

    def test_verification(self):
        self.run_program("verify", "--only", "^maths/exp2$")

    def test_info(self):
        self.run_program("info")


class Kept(unittest.TestCase):
    """Files of this repository."""

    def test_published_results(self):
        files = sorted((SOURCE / "results").rglob("results.json"))
        self.assertTrue(files)
        for file in files:
            self.assertEqual(faults_of(json.loads(file.read_text()))[:5], [], file)

    def test_multiscatter(self):
        self.assertEqual(faults_of(json.loads((SOURCE / "data/multiscatter.json").read_text())), [])

    def test_every_schema_of_the_sources_has_a_file(self):
        named = set()
        for file in (SOURCE / "host").rglob("*.cpp"):
            named |= set(re.findall(r'"(glintmark\.\w+/\d+)"', file.read_text()))
        for file in (SOURCE / "host/report/record").glob("*.h"):
            named |= set(re.findall(r'"(glintmark\.\w+/\d+)"', file.read_text()))
        named.discard("glintmark.simulation/1")  # a binary file's first line
        self.assertEqual(named, set(SCHEMAS))

    def test_faults_are_found(self):
        good = json.loads(next((SOURCE / "results").rglob("results.json")).read_text())
        good["records"] = good["records"][:1]
        for break_it in (
            lambda d: d.update(schema="glintmark.results/2"),
            lambda d: d.update(more=1),
            lambda d: d["run"].pop("device"),
            lambda d: d["run"].update(cores=-1),
            lambda d: d["run"].update(cores=True),
            lambda d: d["records"][0].update(median="1"),
            lambda d: d["records"][0].update(timer="sun"),
            lambda d: d["records"][0]["config"].update(reps=9),
        ):
            broken = copy.deepcopy(good)
            break_it(broken)
            self.assertEqual(len(faults(broken, SCHEMAS["glintmark.results/1"])), 1)
        with self.assertRaises(ValueError):
            faults({}, {"type": "object", "maxProperties": 3})


if __name__ == "__main__":
    unittest.main()
