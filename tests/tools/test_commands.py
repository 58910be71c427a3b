#!/usr/bin/python3
"""Every subcommand of the program, and what it promises."""

import json
import math
import re
import unittest

from maille_case import ROOT, MailleCase

COMMANDS = ("mesh", "refine", "quality", "info", "validate", "convert", "paper", "merge")
PLATE = """
difference() {
    name("plate") material("steel") cube([3, 3, 1]);
    name("hole") translate([1.5, 1.5, -1]) cylinder(h = 3, r = 0.8);
}
"""
PHASES = {"read", "primitives", "merge", "refine", "improve", "write"}
MEASURES = {"beta", "sigma", "omega", "tau", "kappa", "alpha", "gamma", "phi", "dihedral_min", "dihedral_max",
            "solid_angle_min", "solid_angle_max", "aspect", "condition", "mean_ratio", "scaled_jacobian"}


class Help(MailleCase):
    def test_help_ends_in_an_example(self):
        self.assertIn("Example:", self.maille("--help"))
        for command in COMMANDS:
            text = self.maille(command, "--help")
            self.assertRegex(text, rf"Example:\n  maille {command} [^\n]*\n*\Z")
            for option in ("--quiet", "--verbose", "--version", "--threads"):
                self.assertIn(option, text)

    def test_version(self):
        said = self.maille("--version")
        self.assertRegex(said, r"\Amaille \d+\.\d+\.\d+\n\Z")
        for command in COMMANDS:
            self.assertEqual(self.maille(command, "--version"), said)


class Mesh(MailleCase):
    def check_summary(self, summary):
        self.assertLessEqual({"cells", "vertices", "iterations", "projection", "cpu_seconds", "wall_seconds"}, set(summary))
        self.assertEqual(set(summary["projection"]), {"moved", "short_of_target"})
        for clock in ("cpu_seconds", "wall_seconds"):
            self.assertEqual(set(summary[clock]), PHASES)
            self.assertGreaterEqual(min(summary[clock].values()), 0)

    def test_mesh_of_a_model(self):
        summary = self.maille_json("mesh", self.model(PLATE), "--size", "0.6", "-o", "plate.vtu")
        self.check_summary(summary)
        self.assertEqual(summary["iterations"], 0)
        info = self.info("plate.vtu")
        self.assertEqual(info["cells"], summary["cells"])
        self.assertEqual(info["vertices"], summary["vertices"])
        self.assertEqual(info["components"], 1)
        self.assertAlmostEqual(info["bbox"][1][0], 3)
        self.assertTrue(9 - math.pi * 0.64 < info["volume"] < 9 - math.pi * 0.64 + 0.3)
        faces = self.sets("plate.vtu", "face")
        self.assertEqual(set(faces), {f"plate/{axis}{sign}" for axis in "xyz" for sign in "-+"} | {"hole/side"})
        self.assertAlmostEqual(faces["plate/x-"], 3, 9)
        self.assertAlmostEqual(sum(faces.values()), info["area"], 9)
        cells = self.sets("plate.vtu", "cell")
        self.assertEqual(set(cells), {"plate", "steel"})
        self.assertAlmostEqual(cells["steel"], info["volume"], 9)
        self.maille("validate", "plate.vtu")

    def test_vertices_short_of_their_surfaces(self):
        holes = {f"hole{i}": (1 + 2 * i, 0.3 + 0.05 * i) for i in range(7)}  # place along x, radius
        solids = "".join(f'name("{name}") translate([{x}, 1, -1]) cylinder(h = 3, r = {r:.2f}); '
                         for name, (x, r) in holes.items())
        model = self.model("difference() { cube([14, 2, 1]); " + solids + "}")
        # No move is good enough for such elements.
        done = self.run_maille("mesh", model, "--size", "0.5", "--refine", "0.3", "--ratio", "1.2", "--min-shape", "1",
                               "--max-iterations", "1", "--no-improve", "-o", "holes.vtu")
        self.assertEqual(done.returncode, 0)
        total = int(re.search(r"^\d+ vert(?:ex|ices) moved onto their surfaces, (\d+) short of them$", done.stdout,
                              re.MULTILINE).group(1))
        told = [line for line in done.stderr.splitlines() if " short of " in line]
        self.assertEqual(len(told), 1)
        *groups, rest = told[0].removeprefix("maille: warning: ").split("; ")
        self.assertEqual(len(groups), 5)
        counts = []
        for group in groups:
            count, verb, surfaces, distance, place = re.fullmatch(
                r"(\d+) (vertex is|vertices are) short of (.*), the farthest by (\S+) at \((.*)\)", group).groups()
            counts.append(int(count))
            self.assertEqual(verb, "vertex is" if count == "1" else "vertices are")
            x, y, z = map(float, place.split(", "))
            *flat, side = surfaces.split(" and ")
            axis, radius = holes[side.removesuffix("/side")]
            self.assertEqual(flat, {0: ["cube1/z-"], 1: ["cube1/z+"]}.get(z, []))
            self.assertAlmostEqual(float(distance), abs(math.hypot(x - axis, y - 1) - radius), 3)
        self.assertEqual(counts, sorted(counts, reverse=True))
        self.assertEqual(rest, f"and {total - sum(counts)} more vertices of others")
        self.assertGreater(total, sum(counts))

    def test_corners_that_are_one_but_for_rounded_coordinates(self):
        # Mirror images of each other, whose rims cross, but for what six digits leave of that.
        frames = ("[[-0.67549, -0.722768, -0.146014, -0.146014], [-0.737369, 0.662114, 0.13376, 0.13376], "
                  "[0, 0.19802, -0.980198, -0.980198], [0, 0, 0, 1]]",
                  "[[0.996171, 0.0839651, 0.0243607, 0.0243607], [0.0874275, -0.956719, -0.277572, -0.277572], "
                  "[0, 0.278639, -0.960396, -0.960396], [0, 0, 0, 1]]")
        model = self.model("".join(f"multmatrix({frame}) cylinder(h = 0.6, r = 0.2, center = true);" for frame in frames))
        done = self.run_maille("mesh", model, "--facets", "round", "-o", "two.vtu")
        self.assertEqual(done.returncode, 0)
        count, off = re.fullmatch(
            r"maille: warning: (\d) vertices are short of cylinder1/side and cylinder1/bottom and cylinder2/side and "
            r"cylinder2/bottom, the farthest off one of them, which have no common point nearby, by (\S+) at \(.*\)\n",
            done.stderr).groups()
        self.assertEqual(count, "2")
        self.assertLess(float(off), 1e-6)
        self.maille("validate", "two.vtu")

    def test_improvement(self):
        model = self.model(PLATE)
        for refined in ((), ("--refine", "0.1+0.1*x")):
            plain, better = (self.maille_json("mesh", model, "--size", "0.4", *refined, *option, "-o", out)
                             for option, out in ((("--no-improve",), "plain.vtu"), ((), "better.vtu")))
            self.assertEqual(plain["edits"], 0)
            self.assertEqual(plain["cpu_seconds"]["improve"], 0)
            self.assertGreater(better["edits"], 100)
            self.assertGreater(better["cpu_seconds"]["improve"], 0)
            measures = [self.maille_json("quality", name)["measures"] for name in ("plain.vtu", "better.vtu")]
            self.assertGreater(measures[1]["beta"]["mean"], measures[0]["beta"]["mean"] + 0.02)
            self.assertGreater(measures[1]["dihedral_min"]["min"], max(18, measures[0]["dihedral_min"]["min"]))
            self.assertLess(measures[1]["dihedral_max"]["max"], min(150, measures[0]["dihedral_max"]["max"]))
            plain_sets, better_sets = (self.sets(name, "face") for name in ("plain.vtu", "better.vtu"))
            self.assertEqual(plain_sets.keys(), better_sets.keys())
            for side in ("x-", "x+", "y-", "y+"):
                self.assertAlmostEqual(better_sets[f"plate/{side}"], 3, 12)
            # On the hole, no farther from the true area.
            area = 2 * math.pi * 0.8
            self.assertLess(abs(better_sets["hole/side"] - area), 1.01 * abs(plain_sets["hole/side"] - area))
            self.maille("validate", "better.vtu")

    def test_mesh_refined_and_projected(self):
        summary = self.maille_json("mesh", self.model(PLATE), "--size", "0.6", "--refine", "0.2+0.02*r", "-o", "plate.vtu")
        self.check_summary(summary)
        self.assertGreater(summary["iterations"], 2)
        self.assertGreater(summary["projection"]["moved"], 10)
        self.assertEqual(summary["projection"]["short_of_target"], 0)
        self.maille("validate", "plate.vtu")
        report = self.maille_json("quality", "plate.vtu", "--size", "0.2+0.02*r")
        self.assertLessEqual(report["measures"]["phi"]["max"], 1.5)
        self.assertEqual(report["inverted"], 0)
        coarse = abs(self.info(self.mesh(PLATE, "0.6", "coarse.vtu"))["volume"] - (9 - math.pi * 0.64))
        self.assertLess(abs(self.info("plate.vtu")["volume"] - (9 - math.pi * 0.64)), coarse)

    def test_refine_uniformly(self):
        start = self.info(self.mesh(PLATE, "0.6", "start.vtu"))
        hole = 2 * math.pi * 0.8
        errors = [abs(self.sets("start.vtu", "face")["hole/side"] - hole)]
        for levels in (1, 2):
            summary = self.maille_json("refine", "start.vtu", "--model", self.model(PLATE), "--uniform", str(levels), "-o", "fine.vtu")
            self.check_summary(summary)
            self.assertEqual(summary["iterations"], levels)
            self.assertEqual(summary["cells"], 8**levels * start["cells"])
            self.assertEqual(summary["projection"]["short_of_target"], 0)
            self.maille("validate", "fine.vtu")
            errors.append(abs(self.sets("fine.vtu", "face")["hole/side"] - hole))
        for coarse, fine in zip(errors, errors[1:]):
            self.assertGreater(math.log2(coarse / fine), 1.9)
        flat = self.maille_json("refine", "start.vtu", "--uniform", "1", "-o", "flat.vtu")
        self.assertEqual(flat["projection"]["moved"], 0)
        self.assertAlmostEqual(self.info("flat.vtu")["volume"], start["volume"])

    def test_sizes_by_sets_and_curvature(self):
        model = self.model(PLATE)
        size = "min(0.6, 0.1+0.3*d('hole/side'))"
        near = self.maille_json("mesh", model, "--size", "0.6", "--refine", size, "-o", "near.vtu")
        everywhere = self.maille_json("mesh", model, "--size", "0.6", "--refine", "0.1", "-o", "everywhere.vtu")
        self.assertLess(near["cells"], everywhere["cells"] / 3)
        # The refined mesh's hole is not quite where the start mesh's was.
        report = self.maille_json("quality", "near.vtu", "--size", f"{size}+0.02")
        self.assertLessEqual(report["measures"]["phi"]["max"], 1.5)
        several = self.maille_json("mesh", model, "--size", "0.6", "--refine", "0.6", "--refine", "0.1+0.3*d('hole/side')",
                                   "-o", "several.vtu")
        self.assertEqual(several["cells"], near["cells"])
        self.maille("mesh", model, "--size", "0.6", "--refine", "curvature(40)", "-o", "round.vtu")
        missing = abs(self.sets("round.vtu", "face")["hole/side"] - 2 * math.pi * 0.8)
        # Edges of up to 1.5 times a 40th of the circle: 1 - sin(t)/t, t = 1.5 pi / 40.
        self.assertLess(missing / (2 * math.pi * 0.8), (1.5 * math.pi / 40) ** 2 / 6)
        stderr = self.run_maille("mesh", model, "--size", "0.6", "--refine", "d('hull')", "-o", "no.vtu").stderr
        self.assertIn('no set named "hull"', stderr)
        self.assertIn("hole/side", stderr)

    def test_gradation(self):
        size = "x < 0.2 ? 0.04 : 1"
        counts = [self.maille_json("mesh", self.model("cube(1);"), "--size", "0.5", "--refine", size, "-o", "cube.vtu",
                                   "--no-improve", *gradation)["cells"] for gradation in ((), ("--gradation", "0.2"))]
        self.assertGreater(counts[1], 1.2 * counts[0])
        self.maille("validate", "cube.vtu")

    def test_sizes_of_the_model_count(self):
        coarse = self.info(self.mesh("cube(1);", "0.5"))["cells"]
        fine = self.info(self.mesh("size(0.2) cube(1);", "0.5"))["cells"]
        self.assertGreater(fine, 4 * coarse)
        self.maille("mesh", self.model("cube(1);"), "-o", "default.vtu")
        self.assertGreater(self.info("default.vtu")["cells"], coarse)

    def test_facets(self):
        model = self.model("cylinder($fn = 6, h = 1, r = 1);")
        volumes = {}
        for facets in ("auto", "keep", "round"):
            self.maille("mesh", model, "--size", "0.3", "--facets", facets, "-o", "part.vtu")
            volumes[facets] = self.info("part.vtu")["volume"]
        self.assertAlmostEqual(volumes["auto"], 1.5 * math.sqrt(3), 9)
        self.assertAlmostEqual(volumes["keep"], 1.5 * math.sqrt(3), 9)
        self.assertGreater(volumes["round"], 3)

    def test_threads_and_runs_do_not_change_the_bytes(self):
        model = self.model(PLATE)
        outputs = []
        for threads in (1, 2, 2):
            self.maille("mesh", model, "--size", "0.6", "--refine", "0.25", "--threads", threads, "-o", "plate.vtu")
            outputs.append((self.folder / "plate.vtu").read_bytes())
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(outputs[1], outputs[2])

    def test_picture(self):
        self.mesh(PLATE, "0.6", "plate.vtu", "--png", "plate.png")
        self.assertEqual((self.folder / "plate.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(self.files(), ["part.csg", "plate.png", "plate.vtu"])

    def test_quiet_and_verbose(self):
        model = self.model("cube(1);")
        self.assertEqual(self.maille("mesh", model, "--size", "0.5", "-o", "part.vtu", "-q"), "")
        self.assertNotEqual(self.maille("mesh", model, "--size", "0.5", "-o", "part.vtu"), "")
        done = self.run_maille("mesh", model, "--size", "0.5", "-o", "part.vtu", "-v")
        self.assertEqual(done.returncode, 0)
        self.assertIn("maille: ", done.stderr)


class Refine(MailleCase):
    def test_refine_a_mesh(self):
        # Plain bisection need not end; of this mesh it does.
        self.mesh("cube(1);", "0.6", "part.vtu", "--no-improve")
        for method in ("rivara", "bisection"):
            for order in ("longest", "shape", "none"):
                summary = self.maille_json("refine", "part.vtu", "--size", "0.2", "--method", method, "--order", order,
                                           "-o", "fine.msh")
                self.assertGreater(summary["iterations"], 2)
                self.maille("validate", "fine.msh")
                self.assertAlmostEqual(self.info("fine.msh")["volume"], 1, 12)
                self.assertAlmostEqual(self.sets("fine.msh", "face")["cube1/z+"], 1, 12)

    def test_a_rule_for_ties_decides_what_is_split(self):
        # Four cells round an inner axis that is as long as the edges of the boundary round the equator.
        self.model("6 3 0 0\n0 1 -1 0\n1 1 1 0\n2 -1 1 0\n3 -1 -1 0\n4 0 0 -1\n5 0 0 1\n", "octahedron.node")
        self.model("4 4 0\n0 0 1 4 5\n1 1 2 4 5\n2 2 3 4 5\n3 3 0 4 5\n", "octahedron.ele")
        cells = {}
        for ties in ("order", "fewest", "boundary"):
            done = self.run_maille("refine", "octahedron.node", "--size", "1.3+10*(x>-0.4)", "--method", "bisection",
                                   "--max-iterations", "1", "--ties", ties, "-o", "split.msh", "--json")
            cells[ties] = json.loads(done.stdout)["cells"]
        self.assertEqual(cells, {"order": 8, "fewest": 5, "boundary": 5})

    def test_refine_a_model(self):
        summary = self.maille_json("refine", ROOT / "examples/lens.csg", "--size", "0.25", "-o", "lens.msh")
        self.assertGreater(summary["projection"]["moved"], 0)
        self.assertEqual(summary["projection"]["short_of_target"], 0)
        self.assertLess(abs(self.info("lens.msh")["volume"] - 2.87979326579064), 0.08)

    def test_projection_needs_a_model_and_can_be_left_out(self):
        model = self.model("sphere(1);")
        self.maille("mesh", model, "--size", "0.8", "-o", "ball.vtu")
        start = self.info("ball.vtu")["volume"]
        self.maille("refine", "ball.vtu", "--size", "0.3", "-o", "flat.vtu")
        self.assertAlmostEqual(self.info("flat.vtu")["volume"], start, 12)
        self.maille("refine", "ball.vtu", "--size", "0.3", "--model", model, "-o", "round.vtu")
        self.assertGreater(self.info("round.vtu")["volume"], start + 0.1)
        summary = self.maille_json("refine", model, "--size", "0.3", "--no-project", "-o", "plain.vtu")
        self.assertEqual(summary["projection"]["moved"], 0)

    def test_limits(self):
        self.mesh("cube(1);", "0.6")
        done = self.run_maille("refine", "part.vtu", "--size", "0.05", "--max-iterations", "2", "-o", "fine.vtu", "--json")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(json.loads(done.stdout)["iterations"], 2)
        self.assertIn("stopped after 2 passes", done.stderr)
        strict = self.maille_json("refine", "part.vtu", "--size", "0.3", "--ratio", "1", "-o", "fine.vtu")
        usual = self.maille_json("refine", "part.vtu", "--size", "0.3", "-o", "fine.vtu")
        self.assertGreater(strict["cells"], usual["cells"])

    def test_size_from_a_field(self):
        import meshio
        self.mesh("cube(1);", "0.4")
        mesh = meshio.read(self.folder / "part.vtu")
        mesh.point_data["h"] = 0.1 + 0.2 * mesh.points[:, 0]
        mesh.cell_data = {}
        mesh.cells = [block for block in mesh.cells if block.type == "tetra"]
        mesh.write(self.folder / "field.vtu")
        by_field = self.maille_json("refine", "part.vtu", "--size", "field.vtu:h", "-o", "a.vtu")
        by_expression = self.maille_json("refine", "part.vtu", "--size", "0.1+0.2*x", "-o", "b.vtu")
        self.assertLess(abs(by_field["cells"] / by_expression["cells"] - 1), 0.01)

    def test_smooth(self):
        self.mesh("sphere(1);", "0.7")
        plain = self.maille_json("refine", "part.vtu", "--size", "0.1+0.1*z*z", "-o", "plain.vtu")
        smooth = self.maille_json("refine", "part.vtu", "--size", "0.1+0.1*z*z", "--smooth", "-o", "smooth.vtu")
        self.assertEqual(plain["edits"], 0)
        self.assertEqual(plain["cpu_seconds"]["improve"], 0)
        self.assertGreater(smooth["edits"], 0)
        self.assertGreater(smooth["cpu_seconds"]["improve"], 0)
        before, after = (self.maille_json("quality", name, "--size", "0.1+0.1*z*z")["measures"]
                         for name in ("plain.vtu", "smooth.vtu"))
        self.assertGreater(after["dihedral_min"]["min"], before["dihedral_min"]["min"])
        self.assertLessEqual(after["phi"]["max"], 1.5)
        self.maille("validate", "smooth.vtu")


class Quality(MailleCase):
    def test_report(self):
        self.mesh("cube(1);", "0.4")
        report = self.maille_json("quality", "part.vtu", "--size", "0.4")
        self.assertEqual(set(report["measures"]), MEASURES)
        self.assertEqual(report["cells"], self.info("part.vtu")["cells"])
        for name, measure in report["measures"].items():
            self.assertLessEqual({"min", "mean", "max", "histogram"}, set(measure))
            self.assertLessEqual(measure["min"], measure["mean"], name)
            self.assertLessEqual(measure["mean"], measure["max"], name)
            self.assertEqual(sum(measure["histogram"]), report["cells"], name)
        self.assertTrue(report["criteria"])
        self.assertIn("sigma", self.maille("quality", "part.vtu"))

    def test_improve(self):
        self.mesh(PLATE, "0.5", "part.vtu", "--no-improve")
        before = self.maille_json("quality", "part.vtu")
        after = self.maille_json("quality", "part.vtu", "--improve", "better.vtu", "--model", "part.csg")
        self.assertEqual(after, self.maille_json("quality", "better.vtu"))
        self.assertGreaterEqual(after["measures"]["gamma"]["min"], before["measures"]["gamma"]["min"])
        self.assertNotEqual(after, before)
        self.maille("validate", "better.vtu")

    def test_improvement_keeps_to_the_size(self):
        # Plain bisection's mesh has slivers to cure.
        self.maille("mesh", self.model(PLATE), "--size", "0.5", "--no-improve", "--refine", "0.12+0.1*x", "-o", "part.vtu")
        size = ("--size", "0.12+0.1*x")
        before = self.maille_json("quality", "part.vtu", *size)
        after = self.maille_json("quality", "part.vtu", *size, "--improve", "better.vtu")
        self.assertLessEqual(before["measures"]["phi"]["max"], 1.5)
        self.assertLessEqual(after["measures"]["phi"]["max"], 1.5)
        self.assertGreater(after["measures"]["dihedral_min"]["min"], before["measures"]["dihedral_min"]["min"])
        free = self.maille_json("quality", "part.vtu", "--improve", "free.vtu")
        self.assertNotEqual(free["measures"]["gamma"], after["measures"]["gamma"])


class Info(MailleCase):
    def test_figures(self):
        self.mesh("cube([1, 2, 3]);", "0.7")
        info = self.info("part.vtu")
        self.assertEqual(set(info), {"vertices", "edges", "faces", "cells", "boundary_faces", "volume", "area", "bbox",
                                     "components", "euler", "sets"})
        self.assertAlmostEqual(info["volume"], 6, 12)
        self.assertAlmostEqual(info["area"], 22, 12)
        self.assertEqual(info["bbox"], [[0, 0, 0], [1, 2, 3]])
        self.assertEqual(info["components"], 1)
        self.assertEqual(info["euler"], 1)
        self.assertEqual(info["vertices"] - info["edges"] + info["faces"] - info["cells"], 1)
        self.assertEqual(2 * info["faces"], 4 * info["cells"] + info["boundary_faces"])
        for entry in info["sets"]:
            self.assertEqual(set(entry), {"name", "kind", "size", "measure"})
        text = self.maille("info", "part.vtu")
        self.assertRegex(text, r"volume +6\n")
        self.assertRegex(text, r"cube1/x- +face ")

    def test_parts_and_tunnels(self):
        self.assertEqual(self.info(self.mesh("cube(1); translate([2, 0, 0]) cube(1);", "0.7"))["components"], 2)
        self.assertEqual(self.info(self.mesh(PLATE, "0.7"))["euler"], 0)


class Validate(MailleCase):
    NODES = "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 {}\n"

    def test_a_flat_cell_is_found(self):
        (self.folder / "one.ele").write_text("1 4 0\n1 1 2 3 4\n")
        (self.folder / "one.node").write_text(self.NODES.format("1"))
        self.assertIn("valid", self.maille("validate", "one.node"))
        (self.folder / "one.node").write_text(self.NODES.format("0"))
        done = self.run_maille("validate", "one.node")
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn("one.node: ", done.stdout)


class Convert(MailleCase):
    def test_there_and_back(self):
        self.mesh(PLATE, "0.6")
        figures = self.info("part.vtu")
        for name, options in (("a.msh", []), ("b.msh", ["--format", "msh22"]), ("c.mesh", []), ("d.node", []),
                              ("e.vtu", [])):
            self.maille("convert", "part.vtu", name, *options)
            back = self.info(name)
            self.assertEqual({**back, "sets": sorted(back["sets"], key=str)},
                             {**figures, "sets": sorted(figures["sets"], key=str)}, name)

    def test_boundary(self):
        self.mesh("cube(1);", "0.6")
        figures = self.info("part.vtu")
        self.maille("convert", "part.vtu", "part.off")
        header = (self.folder / "part.off").read_text().split()
        self.assertEqual(header[0], "OFF")
        self.assertEqual(int(header[2]), figures["boundary_faces"])
        for name in ("part.stl", "part.obj", "part.ply"):
            self.maille("convert", "part.vtu", name)
            self.assertGreater((self.folder / name).stat().st_size, 100)


class Paper(MailleCase):
    def test_the_first_example(self):
        runs = self.maille_json("paper", "1")
        self.assertEqual([(r["method"], r["order"]) for r in runs],
                         [("bisection", "none"), ("bisection", "longest"), ("rivara", "none"), ("rivara", "longest")])
        for run in runs:
            self.assertLessEqual({"iterations", "cells", "vertices", "sigma", "tau", "phi", "criteria", "seconds"}, set(run))
        rivara = runs[2]
        self.assertEqual(rivara["iterations"], 7)
        self.assertLess(abs(rivara["cells"] - 3517), 30)
        self.assertEqual(rivara["criteria"]["2/3<L/Lbar<3/2"], 100)
        text = self.maille("paper", "1")
        self.assertRegex(text, r"cells +\d+")
        self.assertIn("3517", text)


class Merge(MailleCase):
    def test_operations(self):
        self.mesh("name(\"a\") cube(2);", "0.8", "a.vtu")
        self.mesh("name(\"b\") translate([1, 0.5, -0.5]) cube([2, 1, 2]);", "0.8", "b.vtu")
        common = 1 * 1 * 1.5
        for operation, volume in (("union", 12 - common), ("intersection", common), ("difference", 8 - common),
                                  ("fragment", 12 - common)):
            summary = self.maille_json("merge", "a.vtu", "b.vtu", "--op", operation, "-o", "c.vtu")
            info = self.info("c.vtu")
            self.assertEqual(summary["cells"], info["cells"])
            self.assertAlmostEqual(info["volume"], volume, 9)
            self.maille("validate", "c.vtu")
        cells = self.sets("c.vtu", "cell")
        self.assertAlmostEqual(cells["a"], 8, 9)
        self.assertAlmostEqual(cells["b"], 4 - common, 9)


class Examples(MailleCase):
    VOLUMES = {"two_materials": 8, "lens": 2.87979326579064, "bicylinder": 16 / 3,
               "napkin_ring": math.pi / 6 * 1.2 ** 3, "stacked_boxes": 24, "die": 7.27798947049472}

    def test_every_example_can_be_meshed(self):
        for path in sorted((ROOT / "examples").glob("*.csg")):
            with self.subTest(path.stem):
                diagonal = {"bracket": 6, "tee": 0.2}.get(path.stem, 0.3)
                self.maille("mesh", path, "--size", diagonal, "-o", "part.vtu", "-q")
                self.maille("validate", "part.vtu")
                if path.stem in self.VOLUMES:
                    self.assertLess(abs(self.info("part.vtu")["volume"] / self.VOLUMES[path.stem] - 1), 0.06)

    def test_comments_give_the_volumes(self):
        for name, volume in self.VOLUMES.items():
            text = (ROOT / f"examples/{name}.csg").read_text()
            numbers = [float(n) for n in re.findall(r"\d+\.?\d*", text)]
            self.assertTrue(any(abs(n - volume) < 1e-9 for n in numbers), name)


if __name__ == "__main__":
    unittest.main()
