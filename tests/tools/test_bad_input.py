#!/usr/bin/python3
"""Bad input: one clear line on stderr, exit status 2, no output file, no crash."""

import math
import random
import re
import unittest

from maille_case import MailleCase

CUBE = "cube(1);"


class BadInput(MailleCase):
    def refuse(self, *arguments, says=()):
        before = self.files()
        done = self.run_maille(*arguments)
        self.assertEqual(done.returncode, 2, done)
        self.assertEqual(done.stdout, "")
        self.assertRegex(done.stderr, r"\Amaille: error: [^\n]+\n\Z")
        for words in says:
            self.assertIn(words, done.stderr)
        self.assertEqual(self.files(), before)
        return done.stderr

    def refuse_model(self, text, message):
        stderr = self.refuse("mesh", self.model(text), "--size", "0.5", "-o", "out.vtu")
        self.assertEqual(stderr, f"maille: error: part.csg:{message}\n")

    def test_missing_file(self):
        self.refuse("mesh", "none.csg", "-o", "out.vtu", says=["none.csg"])
        self.refuse("refine", "none.vtu", "--size", "1", "-o", "out.vtu", says=["none.vtu"])
        for command in ("info", "validate", "quality"):
            self.refuse(command, "none.vtu", says=["none.vtu"])
        self.refuse("convert", "none.vtu", "out.msh", says=["none.vtu"])
        self.refuse("merge", "none.vtu", "none.vtu", "--op", "union", "-o", "out.vtu", says=["none.vtu"])

    def test_a_folder_is_no_file(self):
        self.refuse("mesh", ".", "-o", "out.vtu")
        self.refuse("info", ".")

    def test_syntax_error(self):
        self.refuse_model("cube(1", "1:7: expected ',' or ')' but found the end of the file")
        self.refuse_model("cube(1);\n}", "2:1: expected a node but found '}'")

    def test_unknown_node(self):
        self.refuse_model("\n  cubee(1);", "2:3: unknown node 'cubee' (did you mean 'cube'?)")
        self.refuse_model("minkowski() { cube(1); sphere(1); }", "1:1: 'minkowski' is not supported")

    def test_negative_radius(self):
        self.refuse_model("sphere(r = -1);", "1:12: sphere: the radius must be greater than 0")

    def test_empty_model(self):
        self.refuse_model("", " the model is empty: it has no solid")

    def test_empty_result(self):
        text = "intersection() { cube(1); translate([5, 0, 0]) cube(1); }"
        self.refuse("mesh", self.model(text), "--size", "0.5", "-o", "out.vtu", says=["empty"])
        self.refuse("mesh", self.model("difference() { cube(1); translate([-1, -1, -1]) cube(3); }"), "--size", "0.5",
                    "-o", "out.vtu", says=["empty"])

    def test_too_much_work(self):
        """Thousands of needles through one place: each of their triangles is near every other."""
        generator = random.Random(1)
        needles = []
        for _ in range(2600):
            x, y, z = (generator.gauss(0, 1) for _ in range(3))
            length = math.sqrt(x * x + y * y + z * z) / 10
            tip = [x / length, y / length, z / length]
            beside = [[generator.gauss(0, 0.1) for _ in range(3)] for _ in range(2)]
            corners = [tip, [-t for t in tip], [0.9 * t + b for t, b in zip(tip, beside[0])],
                       [b - 0.9 * t for t, b in zip(tip, beside[1])]]
            needles.append(f"tetrahedron({corners});")
        block = "translate([-20, -20, -20]) cube(40);"
        model = self.model("difference() {" + block + "\n".join(needles) + "}")
        stderr = self.refuse("mesh", model, "--size", "40", "-o", "out.vtu", says=["it would hardly end"])
        told = re.search(r"the surfaces of (\w+) and (\w+) near \((.*), (.*), (.*)\) are among so many", stderr)
        self.assertIsNotNone(told, stderr)
        self.assertNotEqual(told[1], told[2])
        for name in told.group(1, 2):
            self.assertRegex(name, r"^tetrahedron\d+$")
            self.assertLessEqual(int(name[len("tetrahedron"):]), len(needles))
        self.assertLess(math.hypot(*map(float, told.group(3, 4, 5))), 11)

    def test_bad_sizes(self):
        model = self.model(CUBE)
        for size in ("0", "-1", "1/0", "x-x", "0/0", "", "1+", "q*2", "sin(", "none.vtu:h", "1e-300"):
            self.refuse("mesh", model, "--size", size, "-o", "out.vtu")
            self.refuse("mesh", model, "--size", "0.5", "--refine", size, "-o", "out.vtu")
            self.refuse("refine", model, "--size", size, "-o", "out.vtu")

    def test_output_folder_that_is_not_there(self):
        self.refuse("mesh", self.model(CUBE), "--size", "0.5", "-o", "no/such/out.vtu", says=["no/such"])
        self.refuse("mesh", self.model(CUBE), "--size", "0.5", "-o", "out.vtu", "--png", "no/such/out.png",
                    says=["no/such"])

    def test_output_of_unknown_format(self):
        self.refuse("mesh", self.model(CUBE), "--size", "0.5", "-o", "out.docx", says=[".docx"])
        self.refuse("mesh", self.model(CUBE), "--size", "0.5", "-o", "out", says=["out"])
        self.refuse("mesh", self.model(CUBE), "--size", "0.5", "-o", "out.msh", "--format", "msh1")

    def test_truncated_meshes(self):
        self.mesh(CUBE, "0.6", "whole.vtu")
        self.maille("convert", "whole.vtu", "whole.msh")
        self.maille("convert", "whole.vtu", "whole.mesh")
        for extension in ("vtu", "msh", "mesh"):
            data = (self.folder / f"whole.{extension}").read_bytes()
            for part in (0, 10, len(data) // 3, len(data) // 2, len(data) - len(data) // 10):
                (self.folder / f"cut.{extension}").write_bytes(data[:part])
                self.refuse("info", f"cut.{extension}", says=[f"cut.{extension}"])

    def test_not_a_mesh(self):
        (self.folder / "text.vtu").write_text("hello")
        self.refuse("validate", "text.vtu")
        (self.folder / "text.doc").write_text("hello")
        self.refuse("validate", "text.doc")

    def test_usage(self):
        model = self.model(CUBE)
        self.refuse()
        self.refuse("frobnicate")
        self.refuse("mesh")
        self.refuse("mesh", model)
        self.refuse("mesh", model, "-o")
        self.refuse("mesh", model, "-o", "out.vtu", "--frobnicate")
        self.refuse("mesh", model, "-o", "out.vtu", "--facets", "square")
        self.refuse("mesh", model, "-o", "out.vtu", "--threads", "0")
        self.refuse("mesh", model, "-o", "out.vtu", "-q", "-v")
        self.refuse("refine", model, "-o", "out.vtu", says=["--size", "--uniform"])
        self.refuse("refine", model, "-o", "out.vtu", "--uniform", "0")
        self.refuse("refine", model, "-o", "out.vtu", "--uniform", "1", "--size", "1")
        self.refuse("refine", model, "-o", "out.vtu", "--uniform", "1", "--smooth")
        self.refuse("refine", model, "-o", "out.vtu", "--uniform", "9", says=["9 levels make"])
        self.refuse("refine", model, "-o", "out.vtu", "--size", "1", "--method", "magic")
        self.refuse("refine", model, "-o", "out.vtu", "--size", "1", "--order", "random")
        self.refuse("refine", model, "-o", "out.vtu", "--size", "1", "--ratio", "-1")
        self.refuse("refine", model, "-o", "out.vtu", "--size", "1", "--max-iterations", "0")
        self.refuse("merge", model, model, "--op", "xor", "-o", "out.vtu")
        self.refuse("paper", "3")


if __name__ == "__main__":
    unittest.main()
