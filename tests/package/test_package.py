#!/usr/bin/python3
"""Installs what was built and builds other people's programs on it: by find_package, by pkg-config, and with maille as
a part of their tree. MAILLE_BUILD is the folder of the build, MAILLE_ROOT that of the sources."""

import os
import pathlib
import shlex
import shutil
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["MAILLE_BUILD"])
ROOT = pathlib.Path(os.environ["MAILLE_ROOT"])
HERE = ROOT / "tests/package"
COMPILER = os.environ["CXX"]
ROOMS = ("volmesh", "quality", "refine", "modeler")
# What only modeler and refine need: the mesh alone must do without.
ABSENT = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("CGAL", "muparser")]


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}")
    return done.stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.prefix = cls.folder / "prefix"
        for room in ROOMS:
            run("cmake", "--install", BUILD, "--prefix", cls.prefix, "--component", room)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def configured(self, name, *options):
        folder = self.folder / name
        run("cmake", "-G", "Ninja", "-S", HERE, "-B", folder, f"-DCMAKE_PREFIX_PATH={self.prefix}", *options)
        return folder

    def test_the_mesh_alone(self):
        folder = self.configured("mesh", "-DUSED_ROOMS=volmesh", *ABSENT)
        run("cmake", "--build", folder)
        self.assertEqual(run(folder / "mesh_user", self.folder / "a.vtu"), "right\n")
        self.assertFalse((folder / "model_user").exists())

    def test_all_rooms(self):
        folder = self.configured("model", "-DUSED_ROOMS=modeler;refine")
        run("cmake", "--build", folder, "--target", "model_user")
        model = self.folder / "box.csg"
        model.write_text("cube([1, 2, 3]);\n")
        # The worker of the installed package, not that of the build.
        worker = self.prefix / "libexec/maille/maille-tetgen"
        self.assertTrue(worker.is_file())
        self.assertEqual(run(folder / "model_user", model, env={**os.environ, "MAILLE_TETGEN": str(worker)}), "right\n")

    def test_a_missing_room_is_named(self):
        done = subprocess.run(
            ["cmake", "-G", "Ninja", "-S", HERE, "-B", self.folder / "none", f"-DCMAKE_PREFIX_PATH={self.prefix}",
             "-DUSED_ROOMS=cellar"], capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("cellar", done.stderr)

    def test_pkg_config(self):
        if not shutil.which("pkg-config"):
            self.skipTest("pkg-config isn't installed")
        modules = next(self.prefix.rglob("pkgconfig"))
        environment = {**os.environ, "PKG_CONFIG_PATH": str(modules)}
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", "maille-volmesh", env=environment))
        program = self.folder / "by_pkg_config"
        run(COMPILER, HERE / "mesh_user.cc", *flags, "-o", program)
        self.assertEqual(run(program, self.folder / "b.msh"), "right\n")
        for room in ROOMS:
            libraries = run("pkg-config", "--libs", f"maille-{room}", env=environment)
            self.assertIn(f"-lmaille_{room}", libraries)
            self.assertIn("-lmaille_volmesh", libraries)

    def test_as_a_part_of_another_tree(self):
        folder = self.configured("tree", f"-DMAILLE_SOURCE={ROOT}", "-DMAILLE_ROOMS=volmesh", *ABSENT)
        # One object shows that the target hands its headers on; the whole library would take minutes.
        run("cmake", "--build", folder, "--target", "CMakeFiles/mesh_user.dir/mesh_user.cc.o")
        self.assertNotIn("test_volmesh", run("cmake", "--build", folder, "--target", "help"))


if __name__ == "__main__":
    unittest.main()
