"""packaging/phoronix against the program: its menu, what it calls, and the line that it reads."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest
import xml.etree.ElementTree as xml

PROGRAM = os.environ["GLINTMARK_PROGRAM"]
PROFILE = pathlib.Path(os.environ["GLINTMARK_SOURCE_DIR"]) / "packaging/phoronix/glintmark-1.0.0"


def menu(identifier):
    options = xml.parse(PROFILE / "test-definition.xml").iter("Option")
    option = next(one for one in options if one.findtext("Identifier") == identifier)
    return [(option.findtext("ArgumentPrefix") or "") + entry.findtext("Value") for entry in option.iter("Entry")]


def parsers():
    return {one.findtext("MatchToTestArguments"): one
            for one in xml.parse(PROFILE / "results-definition.xml").iter("ResultsParser")}


def score(table, log):
    """The number in the place of #_RESULT_#, as the suite finds it: the last line with the hint, split at blanks."""
    parser = parsers()[table]
    line = [one for one in log.splitlines() if parser.findtext("LineHint") in one][-1].split()
    template = parser.findtext("OutputTemplate").split()
    return float(line[template.index("#_RESULT_#")]), line[3], parser.findtext("ResultScale")


class Phoronix(unittest.TestCase):
    def setUp(self):
        self.home = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.home)
        (self.home / "bin").mkdir()

    def shell(self, *words):
        environment = dict(os.environ, HOME=str(self.home), LOG_FILE=str(self.home / "log"),
                           PATH=f"{self.home / 'bin'}:/usr/bin:/bin")
        return subprocess.run(["sh", *words], cwd=self.home, env=environment, capture_output=True, text=True, check=False)

    def status(self, name):
        return (self.home / name).read_text().strip()

    def test_menu_has_every_table(self):
        help_text = subprocess.run([PROGRAM, "bench", "--help"], capture_output=True, text=True, check=True).stdout
        for table in menu("table"):
            self.assertIn(table, help_text)
        listed = subprocess.run([PROGRAM, "bench", "no_such_table"], capture_output=True, text=True, check=False).stderr
        self.assertEqual(listed.split("tables are ")[1].strip().split(", "), menu("table"))
        self.assertEqual(list(parsers()), menu("table"))

    def test_runs_and_is_read(self):
        os.symlink(PROGRAM, self.home / "bin/glintmark")
        self.assertEqual(self.shell(str(PROFILE / "install.sh")).returncode, 0)
        self.assertEqual(self.status("install-exit-status"), "0")
        words = f"zk16 {menu('size')[0].split()[0]} 64x36 --scene screen_plane --view steep --reps 1".split()
        self.shell("./glintmark", *words)
        log = (self.home / "log").read_text()
        self.assertEqual(self.status("test-exit-status"), "0", log)
        value, unit, scale = score("zk16", log)
        self.assertGreater(value, 0)
        self.assertEqual(unit, scale)
        self.shell("./glintmark", "zk16", "--size", "0x0")
        self.assertEqual(self.status("test-exit-status"), "2")

    def test_says_what_is_missing(self):
        result = self.shell(str(PROFILE / "install.sh"))
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("not in PATH", result.stdout)
        self.assertEqual(self.status("install-exit-status"), "1")


if __name__ == "__main__":
    unittest.main()
