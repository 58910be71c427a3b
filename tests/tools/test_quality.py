#!/usr/bin/python3
"""What `maille quality` reports of errors, of the worst cells, and where it refuses."""

import unittest

import meshio
import numpy as np

from maille_case import MailleCase

SLAB = 'name("slab") cube([4, 4, 0.12]);'


class Critical(MailleCase):
    def setUp(self):
        super().setUp()
        self.mesh(SLAB, 0.8, "part.vtu", "--no-improve")
        self.tets = meshio.read(self.folder / "part.vtu")
        self.cells = next(block for block in self.tets.cells if block.type == "tetra").data
        self.errors = np.random.default_rng(1).exponential(size=len(self.cells))

    def write(self, name, cells, **fields):
        meshio.write_points_cells(self.folder / name, self.tets.points, [("tetra", cells)],
                                  cell_data={key: [values] for key, values in fields.items()})

    def expected(self, report):
        """The critical cells of all bad ones, which `report` lists."""
        bad = [w for w in report["worst"] if w["sigma"] < 0.4]
        return [w["cell"] for w in bad if self.errors[w["cell"]] > self.errors.mean()]

    def test_of_a_file_and_of_the_mesh_itself(self):
        self.write("error.vtu", self.cells, eta=self.errors)
        report = self.maille_json("quality", "part.vtu", "--error", "error.vtu:eta", "--worst", len(self.cells))
        self.assertEqual(len(report["worst"]), len(self.cells))
        critical = report["critical"]
        self.assertAlmostEqual(critical["mean_error"], self.errors.mean(), 12)
        self.assertEqual(len(critical["worst"]), critical["cells"])
        self.assertGreater(critical["cells"], 0)
        self.assertLessEqual({w["cell"] for w in critical["worst"]}, set(self.expected(report)))
        self.assertTrue(all(w["error"] > self.errors.mean() for w in critical["worst"]))
        itself = self.maille_json("quality", "error.vtu", "--error", "eta", "--worst", len(self.cells))
        self.assertEqual(itself["critical"]["cells"], critical["cells"])
        text = self.maille("quality", "error.vtu", "--error", "eta", "--worst", "3")
        self.assertIn(f"{critical['cells']} of them critical", text)
        self.assertIn("critical cells", text)

    def test_floats_and_whole_numbers_will_do(self):
        self.write("error.vtu", self.cells, real=self.errors.astype(np.float32), whole=np.arange(len(self.cells)))
        for name in ("real", "whole"):
            self.assertIsNotNone(self.maille_json("quality", "error.vtu", "--error", name)["critical"])

    def test_refused(self):
        self.write("error.vtu", self.cells, eta=self.errors, minus=self.errors - 2)
        self.write("fewer.vtu", self.cells[:-1], eta=self.errors[:-1])
        self.write("turned.vtu", self.cells[::-1], eta=self.errors)
        for error, words in (("error.vtu:theta", "eta, minus"), ("error.vtu:minus", "cell"), ("eta", "no cell field"),
                             ("fewer.vtu:eta", "the same cells"), ("turned.vtu:eta", "not where the mesh has it")):
            done = self.run_maille("quality", "part.vtu", "--error", error)
            self.assertEqual((done.returncode, done.stdout), (2, ""), error)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_pages_are_refused_where_they_cannot_be(self):
        for options in (("--html", "nowhere/part.html"), ("--html", "."), ("--html-cells", "10"),
                        ("--html", "part.html", "--html-cells", "0")):
            done = self.run_maille("quality", "part.vtu", *options)
            self.assertEqual((done.returncode, done.stdout), (2, ""), options)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertEqual(self.files(), ["part.csg", "part.vtu"])


if __name__ == "__main__":
    unittest.main()
