#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""The pages of the documentation: what stands in them, whether it holds together, and how Doxygen
takes them.

    docs/site/pages.py check         # links, anchors, files and fences of all pages; in ./dev lint
    docs/site/pages.py filter FILE   # a page as Doxygen is to read it; in Doxyfile
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Languages of code. `no-run` after one of them: what a test cannot run (it needs a device, or
# root), and parses alone.
LANGUAGES = ("sh", "python", "cpp", "cmake", "yaml", "json", "csv", "text")
FENCE = re.compile(r"^```(.*)$")
LINK = re.compile(r"(!?)\[((?:[^\[\]`]|`[^`]*`)*)\]\(([^()\s]+)\)")
CODE = re.compile(r"`[^`\n]+`")


def pages():
    """All pages, as paths."""
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard", "*.md"], check=True,
                            capture_output=True, text=True).stdout
    return [ROOT / line for line in listed.splitlines() if (ROOT / line).exists()]


class Block:
    """A fenced block of code."""

    def __init__(self, line, info):
        words = info.split()
        self.line = line  # of its fence
        self.language = words[0] if words else ""
        self.runs = "no-run" not in words[1:]
        self.text = ""


def parse(page):
    """Lines outside of code with their numbers, and the blocks of code."""
    lines, blocks, inside = [], [], None
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        fence = FENCE.match(line)
        if fence and inside is None:
            inside = Block(number, fence[1])
            blocks.append(inside)
        elif fence:
            inside = None
        elif inside is not None:
            inside.text += line + "\n"
        else:
            lines.append((number, line))
    return lines, blocks


def heading(line):
    """Depth and text of a heading, or nothing."""
    found = re.match(r"(#{1,6}) +(.*?) *$", line)
    return (len(found[1]), found[2]) if found else None


def anchor(title):
    """What stands behind # in a link to a heading."""
    words = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).lower())
    return words.strip().replace(" ", "-")


def anchors(lines):
    """Of each line, what its heading is linked to by, or nothing; a second one of a name is NAME-1."""
    seen = {}
    for line in lines:
        depth_and_title = heading(line)
        name = anchor(depth_and_title[1]) if depth_and_title else None
        if name:
            seen[name] = seen.get(name, -1) + 1
            name += f"-{seen[name]}" if seen[name] else ""
        yield name


# --- as Doxygen reads it ----------------------------------------------------------------------------


def page_id(page):
    """The name of a page in the site, and of its file."""
    parts = page.relative_to(ROOT).with_suffix("").parts
    if parts == ("README",):
        return "mainpage"  # Doxygen's word
    return "_".join(parts[1:] if parts[0] == "docs" else parts).lower().replace("-", "_")


def section_id(page, name):
    return page_id(page) + "_" + name.replace("-", "_")


def site_link(page, target):
    """Where a link leads in the site."""
    path, _, name = target.partition("#")
    if re.match(r"[a-z]+:", path):
        return target
    file = (page.parent / path).resolve() if path else page
    if file.suffix == ".md":
        return "@ref " + (section_id(file, name) if name else page_id(file).replace("mainpage", "index"))
    if ROOT / "examples" in file.parents:
        return file.name.replace(".", "_8").replace("_", "__").replace("__8", "_8") + "-example.html"
    return None  # of the repository alone


def filtered_line(page, line, name):
    def replaced(match):
        picture, text, target = match.groups()
        if picture:
            return f"![{text}]({pathlib.PurePath(target).name})"
        where = site_link(page, target)
        return f"[{text}]({where})" if where else text

    if name:
        depth, title = heading(line)
        return "#" * depth + f" {title} {{#{page_id(page) if depth == 1 else section_id(page, name)}}}"
    return LINK.sub(replaced, line)


def filtered(page):
    """Headings with names, links as Doxygen resolves them, fences without words for tests."""
    lines, is_code, text = page.read_text(encoding="utf-8").splitlines(), False, []
    outside = []
    for line in lines:
        is_code ^= bool(FENCE.match(line))
        outside.append("" if is_code else line)
    for line, plain, name in zip(lines, outside, anchors(outside)):
        fence = FENCE.match(line)
        if fence:
            line = "```" + {"python": "py", "cpp": "cpp"}.get((fence[1].split() or [""])[0], "")
        elif plain:
            line = filtered_line(page, line, name)
        text.append(line)
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    if sys.argv[1:2] == ["filter"] and len(sys.argv) == 3:
        sys.stdout.write(filtered((pathlib.Path.cwd() / sys.argv[2]).resolve()))
    else:
        sys.exit(__doc__)
