#!/usr/bin/python3
"""The page that `maille quality --html` writes, in a browser. Exit status 77 (skipped) where there is none."""

import re
import sys
import unittest

import browser
from maille_case import MailleCase

if browser.PROGRAM is None:
    print("skipped: Chromium isn't installed")
    sys.exit(77)

import meshio
import numpy as np

MODEL = """
fragment() {
    name("ball") material("rubber") translate([1, 1, 1]) sphere(0.7);
    name("box") material("steel") cube([2.2, 2, 1.9]);
}
"""
# The colours of the canvas, and how many pixels have each; asked for in the frame that has just been drawn.
COLORS_OF_CANVAS = """new Promise((done) => {
    const canvas = document.getElementById('canvas');
    canvas.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));
    requestAnimationFrame(() => {
        const copy = Object.assign(document.createElement('canvas'), {width: canvas.width, height: canvas.height});
        const pen = copy.getContext('2d');
        pen.drawImage(canvas, 0, 0);
        const counts = {};
        for (const color of new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer))
            counts[color] = (counts[color] ?? 0) + 1;
        done(counts);
    });
})"""
BLUE, ORANGE = 0xffa7794e, 0xff2b8ef2  # as red, green, blue, alpha lie in memory
SETS_OF_EDGES = """$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
0 1 "load"
1 2 "rim"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
4
1 15 2 1 1 4
2 1 2 2 1 1 2
3 1 2 2 1 2 3
4 4 2 3 1 1 2 3 4
$EndElements
"""


class Tets:
    """The mesh as meshio reads it: what the page shows is counted anew."""

    def __init__(self, path):
        mesh = meshio.read(path)
        index = [block.type for block in mesh.cells].index("tetra")
        self.cells = mesh.cells[index].data
        self.points = mesh.points
        self.centroids = mesh.points[self.cells].mean(axis=1)
        self.sets = {name: blocks[index].astype(bool) for name, blocks in mesh.cell_data.items()
                     if set(np.unique(blocks[index])) <= {0, 1}}

    def shell(self, chosen):
        """How many faces of the chosen cells are not between two of them."""
        faces = np.sort(self.cells[chosen][:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]].reshape(-1, 3), axis=1)
        _, counts = np.unique(faces, axis=0, return_counts=True)
        return int((counts == 1).sum())


class Page(MailleCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(browser.Browser())

    def open(self, *options, size=0.4):
        """Writes the page of the model and opens it; returns the mesh and the report."""
        self.mesh(MODEL, size)
        report = self.maille_json("quality", "part.vtu", "--html", "part.html", *options)
        self.browser.open(self.folder / "part.html")
        return Tets(self.folder / "part.vtu"), report

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])
        self.assertEqual({re.match(r"\w+", url)[0] for url in self.browser.requests()} - {"file", "data", "blob"}, set())

    def faces_drawn(self):
        return int(re.match(r"([\d,]+) faces drawn", self.browser.text("#status"))[1].replace(",", ""))

    def check_cut(self, tets):
        """Returns whether no cell is so near the cut that rounding decides on which side it is."""
        axis = "xyz".index(self.browser.text("#cut-text")[0])
        distances = tets.centroids[:, axis] - float(self.browser.js("document.getElementById('cut-text').title"))
        if np.abs(distances).min() < 3e-6:
            return False
        below = distances < 0
        self.assertIn(self.faces_drawn(), {tets.shell(below), tets.shell(~below)})
        return True

    def test_the_mesh_is_drawn(self):
        tets, report = self.open()
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))
        self.assertGreater(len(self.browser.js(COLORS_OF_CANVAS)), 500)
        self.assertEqual(self.browser.js("document.title"), "part.vtu - mesh quality")
        self.assertIn(f"{report['cells']:,} elements", self.browser.text("#facts"))
        self.assertIn("carries every element", self.browser.text("#left-out"))
        for name in report["measures"]:
            bars = self.browser.js(f"document.querySelectorAll('[data-quantity={name}] .bar').length")
            self.assertEqual(bars, len(report["measures"][name]["histogram"]) if report["measures"][name] else 0)

    def test_a_click_on_a_bar_shows_its_elements(self):
        tets, report = self.open()
        histogram = report["measures"]["gamma"]["histogram"]
        bar = next(k for k, n in enumerate(histogram) if n)
        selector = f"[data-quantity=gamma] [data-bin='{bar}']"
        self.browser.click(selector)
        self.assertIn(f"; {histogram[bar]:,} elements chosen", self.browser.text("#status"))
        self.assertLessEqual(self.faces_drawn(), 4 * histogram[bar])
        edges = np.array([tets.points[tets.cells[:, j]] - tets.points[tets.cells[:, i]] for i in range(4) for j in range(i)])
        volumes = np.abs(np.linalg.det(tets.points[tets.cells[:, 1:]] - tets.points[tets.cells[:, :1]])) / 6
        gamma = 6 * np.sqrt(2) * volumes / np.sqrt((edges ** 2).sum(-1).mean(0)) ** 3
        self.assertEqual(self.faces_drawn(), tets.shell((gamma * 20).astype(int) == bar))
        self.browser.click(selector)
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))

    def test_a_click_on_a_criterion_shows_what_it_counts(self):
        self.mesh('name("slab") cube([4, 4, 0.1]);', 0.8)
        report = self.maille_json("quality", "part.vtu", "--worst", 10000, "--html", "part.html")
        self.browser.open(self.folder / "part.html")
        tets = Tets(self.folder / "part.vtu")
        bad = report["bad_shape"]["cells"]
        self.assertTrue(0 < bad < len(tets.cells))
        self.browser.click("[data-band='bad shape'] button")
        self.assertIn(f"; {bad:,} elements chosen", self.browser.text("#status"))
        below = [w["cell"] for w in report["worst"] if w["sigma"] < 0.4]
        self.browser.click("[data-band='r/Lmax<0.4'] button")
        self.assertIn(f"; {len(below):,} elements chosen", self.browser.text("#status"))
        self.assertEqual(self.faces_drawn(), tets.shell(below))

    def test_more_bars_are_chosen_with_the_shift_key(self):
        tets, report = self.open()
        histogram = report["measures"]["alpha"]["histogram"]
        first = next(k for k, n in enumerate(histogram) if n)
        last = next(k for k in reversed(range(len(histogram))) if histogram[k])
        self.browser.click(f"[data-quantity=alpha] [data-bin='{first}']")
        self.browser.click(f"[data-quantity=alpha] [data-bin='{last}']", shift=True)
        self.assertIn(f"; {len(tets.cells):,} elements chosen", self.browser.text("#status"))
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))

    def test_the_keyboard_chooses_a_bar(self):
        _, report = self.open()
        histogram = report["measures"]["tau"]["histogram"]
        bar = next(k for k, n in enumerate(histogram) if n)
        self.browser.js("document.querySelector('[data-quantity=tau] svg').focus()")
        for _ in range(bar):
            self.browser.press("ArrowRight")
        self.browser.press("Enter")
        self.assertIn(f"; {histogram[bar]:,} elements chosen", self.browser.text("#status"))
        self.browser.js("document.getElementById('canvas').focus()")
        self.browser.press("Escape")
        self.assertNotIn("chosen", self.browser.text("#status"))

    def test_a_cut_shows_whole_elements(self):
        tets, _ = self.open()
        self.browser.js("document.getElementById('canvas').focus()")
        checked = 0
        for key in "xyz":
            self.browser.press(key)
            for _ in range(3):
                self.browser.press("]")
                checked += self.check_cut(tets)
        self.assertGreater(checked, 3)
        before = self.faces_drawn()
        self.browser.click("#cut-flip")
        self.assertNotEqual(self.faces_drawn(), before)
        self.browser.click("[data-along='view']")
        self.assertNotEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))
        self.browser.click("[data-along='']")
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))

    def test_sets_are_hidden_and_shown(self):
        tets, _ = self.open()
        for name in ("ball", "steel"):
            self.browser.click(f"[data-set={name}] input")
            self.assertEqual(self.faces_drawn(), tets.shell(~tets.sets[name]), name)
            self.browser.click(f"[data-set={name}] input")
            self.browser.click(f"[data-set={name}] button")
            self.assertEqual(self.faces_drawn(), tets.shell(tets.sets[name]), name)
            self.browser.click(f"[data-set={name}] button")
        sizes = {s["name"]: s["size"] for s in self.info("part.vtu")["sets"] if s["kind"] == "face"}
        self.browser.click("[data-set='box/x-'] button")
        self.assertEqual(self.faces_drawn(), sizes["box/x-"])
        self.browser.click("[data-set='box/x-'] button")
        self.browser.click("[data-set='box/z+'] input")
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)) - sizes["box/z+"])

    def test_sets_of_vertices_and_edges_are_shown(self):
        (self.folder / "part.msh").write_text(SETS_OF_EDGES)
        self.maille("quality", "part.msh", "--html", "part.html")
        self.browser.open(self.folder / "part.html")
        for name, color in (("load", BLUE), ("rim", ORANGE)):
            self.assertEqual(self.browser.js(COLORS_OF_CANVAS).get(str(color), 0), 0)
            self.browser.click(f"[data-set={name}] input")
            self.assertGreater(self.browser.js(COLORS_OF_CANVAS).get(str(color), 0), 20)

    def test_an_element_is_told(self):
        tets, report = self.open("--size", "0.4")
        worst = report["worst"][0]
        self.browser.click("#lists tr[data-cell]")
        self.assertEqual(self.told(), (worst["cell"], ", ".join(worst["sets"])))
        values = dict(re.findall(r"(sigma|phi)(-?[\d.]+)", self.browser.text("#element .values")))
        self.assertAlmostEqual(float(values["sigma"]), worst["sigma"], 3)
        self.browser.click("#element .buttons button:last-child")
        self.browser.click("#element input")
        self.browser.call("Input.insertText", text="17")
        self.browser.press("Enter")
        self.assertEqual(self.told()[0], 17)
        self.browser.click("#reset")
        self.browser.click("#canvas")
        cell, sets = self.told()
        place = [float(x) for x in re.findall(r"-?[\d.]+", self.browser.text("[data-fact=at]"))]
        np.testing.assert_allclose(place, tets.centroids[cell], atol=2e-3)
        self.assertEqual(set(sets.split(", ")), {name for name, members in tets.sets.items() if members[cell]})

    def told(self):
        return int(self.browser.text("[data-fact=number]").replace(",", "")), self.browser.text("[data-fact=in]")

    def test_part_of_a_large_mesh(self):
        tets, report = self.open("--html-cells", 18000, size=0.15)
        carried = int(re.search(r"carries ([\d,]+) of", self.browser.text("#left-out"))[1].replace(",", ""))
        self.assertLess(carried, report["cells"] / 2)
        self.assertEqual(self.faces_drawn(), tets.shell(np.full(len(tets.cells), True)))
        # Every cut, and sets taken away, look as if all cells were there.
        self.browser.js("document.getElementById('canvas').focus()")
        checked = 0
        for key in "xyz":
            self.browser.press(key)
            places = int(self.browser.js("document.getElementById('cut-place').max")) + 1
            for _ in range(places):
                self.browser.press("[")
            for _ in range(places):
                checked += self.check_cut(tets)
                self.browser.press("]")
        self.assertGreater(checked, 4)
        self.browser.press("Escape")
        self.browser.click("[data-set=ball] input")
        self.assertEqual(self.faces_drawn(), tets.shell(~tets.sets["ball"]))
        # The worst are there.
        for worst in report["worst"]:
            self.assertTrue(self.browser.js(f"!!document.querySelector('#lists tr[data-cell=\"{worst['cell']}\"]')"))

    def test_critical_elements(self):
        self.mesh('name("slab") cube([4, 4, 0.1]);', 0.8)
        mesh = meshio.read(self.folder / "part.vtu")
        cells = next(block for block in mesh.cells if block.type == "tetra").data
        meshio.write_points_cells(self.folder / "error.vtu", mesh.points, [("tetra", cells)],
                                  cell_data={"eta": [np.random.default_rng(3).exponential(size=len(cells))]})
        report = self.maille_json("quality", "part.vtu", "--error", "error.vtu:eta", "--html", "part.html")
        self.browser.open(self.folder / "part.html")
        self.assertIn("error", self.browser.text("#histograms"))
        self.assertIn(f"critical{report['critical']['cells']:,}", self.browser.text("#bands"))
        self.assertGreater(report["critical"]["cells"], 0)
        self.browser.click("[data-band=critical] button")
        self.assertIn(f"; {report['critical']['cells']:,} elements chosen", self.browser.text("#status"))
        self.assertNotIn("of them in this page", self.browser.text("#status"))

    def test_meshes_without_extent(self):
        tet = "1 4 0\n1 1 2 3 4\n"
        for name, nodes, cells in (("flat", "4 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n", tet),
                                   ("point", "4 3 0 0\n1 7 7 7\n2 7 7 7\n3 7 7 7\n4 7 7 7\n", tet),
                                   ("none", "0 3 0 0\n", "0 4 0\n")):
            (self.folder / f"{name}.node").write_text(nodes)
            (self.folder / f"{name}.ele").write_text(cells)
            self.maille("quality", f"{name}.node", "--size", 1, "--html", f"{name}.html")
            self.browser.open(self.folder / f"{name}.html")
            self.assertEqual(self.faces_drawn(), 0 if name == "none" else 4)
            self.assertEqual(self.browser.complaints(), [], name)

    def test_names_do_no_harm(self):
        self.mesh('name("<!--<script><i>&amp;") cube(1);', 0.6, "a<b>.vtu")
        self.maille("quality", "a<b>.vtu", "--html", "part.html")
        self.browser.open(self.folder / "part.html")
        self.assertEqual(self.browser.text("h1"), "a<b>.vtu")
        self.assertEqual(self.browser.js("document.title"), "a<b>.vtu - mesh quality")
        self.assertIn("<!--<script><i>&amp;", self.browser.text("#sets"))

    def test_the_same_bytes_for_any_number_of_threads(self):
        self.mesh(MODEL, 0.4)
        pages = []
        for threads in (1, 2):
            self.maille("quality", "part.vtu", "--threads", threads, "--html", "part.html", "--html-cells", 1000)
            pages.append((self.folder / "part.html").read_bytes())
        self.assertEqual(*pages)


if __name__ == "__main__":
    unittest.main()
