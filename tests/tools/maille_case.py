"""What the tests of the program share: running it in a folder of its own."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAILLE = os.environ["MAILLE"]


class MailleCase(unittest.TestCase):
    """Each test has a fresh folder, `self.folder`, which the program runs in."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="maille-test-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def run_maille(self, *arguments, timeout=120):
        return subprocess.run([MAILLE, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              timeout=timeout, stdin=subprocess.DEVNULL)

    def maille(self, *arguments):
        """Runs the program, which must succeed and say nothing on stderr; returns its stdout."""
        done = self.run_maille(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def maille_json(self, *arguments):
        return json.loads(self.maille(*arguments, "--json"))

    def model(self, text, name="part.csg"):
        (self.folder / name).write_text(text)
        return name

    def mesh(self, text, size, out="part.vtu", *arguments):
        """Meshes a model given as text; returns the name of the mesh file."""
        self.maille("mesh", self.model(text), "--size", size, "-o", out, *arguments)
        return out

    def info(self, mesh):
        return self.maille_json("info", mesh)

    def sets(self, mesh, kind):
        """Measures of the sets of this kind, by name."""
        return {s["name"]: s["measure"] for s in self.info(mesh)["sets"] if s["kind"] == kind}

    def files(self):
        return sorted(p.name for p in self.folder.rglob("*"))
