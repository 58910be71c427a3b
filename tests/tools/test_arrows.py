#!/usr/bin/python3
"""The rooms of the house: which folder may include which."""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAY_INCLUDE = {
    "volmesh": {"volmesh"},
    "quality": {"volmesh", "quality"},
    "refine": {"volmesh", "quality", "refine"},
    "modeler": {"volmesh", "quality", "modeler"},
    "tools": {"volmesh", "quality", "refine", "modeler", "tools"},
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def sources(room):
    return sorted(p for p in (ROOT / room).rglob("*") if p.suffix in {".cc", ".hh", ".h", ".cpp", ".hpp"})


def forbidden_includes(room, text):
    """The includes in a file of the room that point against the arrows."""
    found = []
    for target in INCLUDE.findall(text):
        other = target.split("/")[0]
        if other in MAY_INCLUDE and other not in MAY_INCLUDE[room]:
            found.append(target)
        if room != "modeler" and (other == "CGAL" or target == "tetgen.h"):
            found.append(target)
    return found


class Arrows(unittest.TestCase):
    def test_rooms_are_there(self):
        for room in MAY_INCLUDE:
            self.assertGreater(len(sources(room)), 3, room)

    def test_includes_follow_the_arrows(self):
        for room in MAY_INCLUDE:
            for path in sources(room):
                self.assertEqual(forbidden_includes(room, path.read_text()), [], path)

    def test_own_headers_are_named_from_the_root(self):
        for room in MAY_INCLUDE:
            for path in sources(room):
                for target in re.findall(r'#\s*include\s*"([^"]+)"', path.read_text()):
                    self.assertTrue((ROOT / target).is_file(), f"{path} includes {target}")

    def test_one_file_includes_tetgen(self):
        users = [p for room in MAY_INCLUDE for p in sources(room) if "tetgen.h" in INCLUDE.findall(p.read_text())]
        self.assertEqual(len(users), 1, users)

    def test_links_follow_the_arrows(self):
        for room, allowed in MAY_INCLUDE.items():
            for lists in (ROOT / room).rglob("CMakeLists.txt"):
                linked = set(re.findall(r"maille::(\w+)", lists.read_text()))
                self.assertLessEqual(linked & set(MAY_INCLUDE), allowed, lists)

    def test_the_check_sees_what_is_wrong(self):
        self.assertEqual(forbidden_includes("refine", '#include "modeler/model.hh"'), ["modeler/model.hh"])
        self.assertEqual(forbidden_includes("volmesh", "#include <CGAL/Epeck.h>"), ["CGAL/Epeck.h"])
        self.assertEqual(forbidden_includes("quality", '#include "volmesh/tet_mesh.hh"'), [])


if __name__ == "__main__":
    unittest.main()
