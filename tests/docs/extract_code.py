#!/usr/bin/python3
"""Makes a program of the C++ in a page: extract_code.py PAGE.md PROGRAM.cc. Lines at the page's top that include or use
namespaces go before main, the rest within."""
import pathlib
import re
import sys

page, program = map(pathlib.Path, sys.argv[1:])
blocks = re.findall(r"^```cpp\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
if len(blocks) < 2:
    sys.exit(f"{page}: has no code")
head = "#undef NDEBUG\n#include <algorithm>\n#include <cassert>\n#include <cmath>\n#include <string>\n\n"
program.write_text(f"// From {page.name}.\n{head}{blocks[0]}\nint main() {{\n{''.join(blocks[1:])}}}\n")
