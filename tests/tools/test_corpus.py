"""What the corpus runner says of models that are right, wrong, broken or slow."""

import json
import math
import subprocess
import sys
import unittest

from maille_case import MAILLE, ROOT, MailleCase

RUNNER = ROOT / "tools" / "corpus" / "run_corpus"


class Corpus(MailleCase):
    def setUp(self):
        super().setUp()
        (self.folder / "reference.jsonl").touch()

    def add(self, name, text, **figures):
        """A model and, where figures are given, its reference."""
        models = self.folder / "models"
        models.mkdir(exist_ok=True)
        (models / name).write_text(text)
        if figures:
            with open(self.folder / "reference.jsonl", "a", encoding="utf-8") as lines:
                lines.write(json.dumps({"file": name, **figures}) + "\n")

    def run_corpus(self, *options):
        """The exit status, the last cell of each model's row, and the whole of what was printed."""
        done = subprocess.run([sys.executable, RUNNER, MAILLE, "models", "--reference", "reference.jsonl", *options],
                              cwd=self.folder, capture_output=True, text=True, timeout=600, check=False)
        self.assertEqual(done.stderr, "")
        rows = [[cell.strip() for cell in line.strip("| ").split("|")] for line in done.stdout.splitlines()[2:]
                if line.startswith("|")]
        return done.returncode, {row[0]: row[-1] for row in rows}, done.stdout

    def test_right_wrong_and_broken(self):
        brick = "cube([1, 2, 3]);"
        self.add("right.csg", brick, volume=6, area=22, components=1)
        status, verdicts, text = self.run_corpus()
        self.assertEqual((status, verdicts), (0, {"right.csg": "ok"}))
        self.assertIn("1 of 1 models are right.", text)
        self.add("broken.csg", "cube([1, 2, 3);", volume=6, area=22, components=1)
        self.add("volume.csg", brick, volume=6.01, area=22, components=1)
        self.add("area.csg", brick, volume=6, area=21, components=1)
        self.add("pieces.csg", brick + "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {" + brick + "}",
                 volume=12, area=44, components=1)
        self.add("unknown.csg", brick)
        status, verdicts, text = self.run_corpus()
        self.assertEqual(status, 1)
        self.assertIn("broken.csg:1:14", verdicts.pop("broken.csg"))
        self.assertEqual(verdicts, {"right.csg": "ok", "unknown.csg": "ok", "volume.csg": "volume 6, not 6.01",
                                    "area.csg": "area 22, not 21", "pieces.csg": "2 components, not 1"})
        self.assertIn("2 of 6 models are right.", text)

    def test_round_solids_may_differ_by_their_chords(self):
        facets = 16 * math.sin(math.pi / 16)  # the area of a polygon of 32 edges
        text = "cylinder(h = 1, r1 = 1, r2 = 1, center = false, $fn = 32);"
        polygon = {"area": 2 * facets + 64 * math.sin(math.pi / 32), "components": 1}
        self.add("right.csg", text, volume=facets, **polygon)
        self.add("wrong.csg", text, volume=1.5 * facets, **polygon)
        status, verdicts, _ = self.run_corpus()
        self.assertEqual((status, verdicts["right.csg"]), (1, "ok"))
        self.assertTrue(verdicts["wrong.csg"].startswith("volume 3.12"), verdicts)
        status, verdicts, _ = self.run_corpus("--facets", "round")
        self.assertEqual((status, verdicts["right.csg"]), (1, "ok"))
        self.assertRegex(verdicts["wrong.csg"], r"^volume .* give or take ")

    def test_time_limit(self):
        self.add("slow.csg", "cube(1);")
        status, verdicts, _ = self.run_corpus("--limit", "0.001")
        self.assertEqual((status, verdicts), (1, {"slow.csg": "more than 0.001 s"}))

    def test_models_turned_at_random_are_the_same(self):
        self.add("right.csg", "cube([1, 2, 3]);", volume=6, area=22, components=1)
        status, verdicts, _ = self.run_corpus("--turn", "7")
        self.assertEqual((status, verdicts), (0, {"right.csg": "ok"}))


if __name__ == "__main__":
    unittest.main()
