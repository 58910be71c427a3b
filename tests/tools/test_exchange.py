#!/usr/bin/python3
"""Other programs read what maille writes: gmsh the groups by name, meshio the same counts."""

import os
import re
import subprocess
import unittest

import meshio

from maille_case import MailleCase

MODEL = """
fragment() {
    name("ball") material("lead") sphere(r = 0.5);
    name("block") material("resin") translate([0, -1, -1]) cube(2);
}
"""
GROUPS_3D = {"ball", "block", "lead", "resin"}
GROUPS_2D = {"ball/surface", "ball/surface/inner", "block/x-", "block/x+", "block/y-", "block/y+", "block/z-",
             "block/z+"}


class Exchange(MailleCase):
    def setUp(self):
        super().setUp()
        self.mesh(MODEL, "0.35")
        self.figures = self.info("part.vtu")

    def gmsh(self, script):
        """Runs gmsh on a script of its own language; returns what it printed."""
        (self.folder / "script.geo").write_text(script)
        environment = {**os.environ, "HOME": str(self.folder)}
        done = subprocess.run(["gmsh", "script.geo", "-parse_and_exit", "-nopopup"], cwd=self.folder, text=True, env=environment,
                              capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, done)
        return done.stdout + done.stderr

    def test_gmsh_opens_msh(self):
        for options in ([], ["--format", "msh22"]):
            self.maille("convert", "part.vtu", "part.msh", *options)
            said = self.gmsh('Merge "part.msh";')
            self.assertNotRegex(said, "(?i)error|warning")
            self.assertRegex(said, rf"\b{self.figures['vertices']} nodes")
            # Written again by gmsh, every group is there by name and dimension.
            done = subprocess.run(["gmsh", "part.msh", "-save", "-format", "msh41", "-save_all", "-o", "again.msh"], cwd=self.folder,
                                  text=True, capture_output=True, timeout=60,
                                  env={**os.environ, "HOME": str(self.folder)})
            self.assertEqual(done.returncode, 0, done)
            names = re.search(r"\$PhysicalNames\n(.*?)\$End", (self.folder / "again.msh").read_text(errors="replace"), re.S).group(1)
            groups = {(int(d), n) for d, n in re.findall(r'^(\d) \d+ "(.*)"$', names, re.M)}
            self.assertEqual({n for d, n in groups if d == 3}, GROUPS_3D)
            self.assertEqual({n for d, n in groups if d == 2}, GROUPS_2D)

    def test_meshio_reads_vtu(self):
        mesh = meshio.read(self.folder / "part.vtu")
        self.check_counts(mesh)
        for name in GROUPS_3D:
            self.assertIn(name, mesh.cell_data)

    def test_meshio_reads_msh(self):
        self.maille("convert", "part.vtu", "part.msh", "--format", "msh22")
        mesh = meshio.read(self.folder / "part.msh")
        self.check_counts(mesh)
        self.assertLessEqual(GROUPS_3D | GROUPS_2D, set(mesh.field_data))

    def test_meshio_reads_msh41(self):
        self.maille("convert", "part.vtu", "part.msh")
        mesh = meshio.read(self.folder / "part.msh")
        self.check_counts(mesh)
        self.assertLessEqual(GROUPS_3D | GROUPS_2D, set(mesh.field_data))

    def check_counts(self, mesh):
        self.assertEqual(len(mesh.points), self.figures["vertices"])
        tetrahedra = [tuple(sorted(cell)) for block in mesh.cells if block.type == "tetra" for cell in block.data]
        self.assertEqual(len(set(tetrahedra)), self.figures["cells"])


if __name__ == "__main__":
    unittest.main()
