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


# --- whether it holds together ----------------------------------------------------------------------


def faults_of_links(page, lines, names):
    """Links to files and headings that are not there. `names`: the anchors of each page."""
    for number, line in lines:
        for _, _, target in LINK.findall(re.sub(CODE, "", line)):
            path, _, name = target.partition("#")
            if re.match(r"[a-z]+:", path):
                continue
            file = (page.parent / path).resolve() if path else page
            if not file.exists():
                yield number, f"no file {target}"
            elif name and name not in names.get(file, ()):
                yield number, f"no heading {target}"


def faults_of_names(lines):
    """Sources and headers that are named, in `code`, and are not there."""
    for number, line in lines:
        for code in CODE.findall(line):
            name = code.strip("`")
            if re.fullmatch(r"(src|apps|tests|docs|include|ridgeway|worlds|data|examples)/[\w./-]*\.(\w+)", name):
                if not (ROOT / name).exists() and not (ROOT / "include" / name).exists():
                    yield number, f"no file {name}"


def faults_of_blocks(blocks):
    for block in blocks:
        if block.language not in LANGUAGES:
            yield block.line, f"a fence of '{block.language}': one of {', '.join(LANGUAGES)}"


def check():
    """Prints what is wrong in all pages; whether nothing is."""
    found = {page: parse(page) for page in pages()}
    names = {page: set(anchors(line for _, line in lines)) for page, (lines, _) in found.items()}
    layout = (ROOT / "docs/site/layout.xml").read_text(encoding="utf-8")
    good = True
    for page, (lines, blocks) in found.items():
        faults = [*faults_of_links(page, lines, names), *faults_of_names(lines), *faults_of_blocks(blocks)]
        if is_of_site(page) and f'"@ref {page_id(page)}"' not in layout:
            faults.append((1, "is not in docs/site/layout.xml"))
        for number, what in faults:
            print(f"{page.relative_to(ROOT)}:{number}: {what}")
            good = False
    return good


# --- as Doxygen reads it ----------------------------------------------------------------------------


def is_of_site(page):
    return page.parent == ROOT or ROOT / "docs" in page.parents


def page_id(page):
    """The name of a page in the site, and of its file."""
    parts = page.relative_to(ROOT).with_suffix("").parts
    name = "_".join(parts[1:] if parts[0] == "docs" else parts).lower().replace("-", "_")
    return "index" if name == "readme" else name


def section_id(page, name):
    return page_id(page) + "_" + name.replace("-", "_")


def site_link(page, target):
    """Where a link leads in the site; nothing where it leads to a file of the repository alone."""
    path, _, name = target.partition("#")
    if re.match(r"[a-z]+:", path):
        return target
    file = (page.parent / path).resolve() if path else page
    if file.suffix == ".md" and is_of_site(file):
        return "@ref " + (section_id(file, name) if name else page_id(file))
    if ROOT / "examples" in file.parents:
        return file.name.replace("_", "__").replace(".", "_8") + "-example.html"
    return None


def filtered_heading(page, line, name):
    """With a name that links find. Those of the main page would stand in the navigation."""
    depth, title = heading(line)
    title = title.replace("`", "").replace("--", r"\--")
    if depth == 1:
        return f"# {title} {{#{page_id(page).replace('index', 'mainpage')}}}"
    if page_id(page) == "index":
        return f'<h{depth - 1} id="{section_id(page, name)}">{title}</h{depth - 1}>'
    return f"{'#' * depth} {title} {{#{section_id(page, name)}}}"


def filtered_line(page, line):
    def replaced(match):
        picture, text, target = match.groups()
        if picture:
            return f"![{text}]({pathlib.PurePath(target).name})"
        where = site_link(page, target)
        return f"[{text}]({where})" if where else text

    # Two dashes are two dashes, in Doxygen's words; in `code` they are anyway.
    parts = re.split(f"({CODE.pattern})", LINK.sub(replaced, line))
    return "".join(part if part.startswith("`") or "---" in part else part.replace("--", r"\--") for part in parts)


def filtered(page):
    """Headings with names, links as Doxygen resolves them, fences without words for tests."""
    lines, is_code, outside, text = page.read_text(encoding="utf-8").splitlines(), False, [], []
    for line in lines:
        is_fence = bool(FENCE.match(line))
        is_code ^= is_fence
        outside.append("" if is_code or is_fence else line)
    for line, plain, name in zip(lines, outside, anchors(outside)):
        fence = FENCE.match(line)
        if fence:
            line = "```" + {"python": "py", "cpp": "cpp"}.get((fence[1].split() or [""])[0], "")
        elif name:
            line = filtered_heading(page, line, name)
        elif plain:
            line = filtered_line(page, line)
        text.append(line)
    return "\n".join(text) + "\n"


if __name__ == "__main__":
    if sys.argv[1:2] == ["filter"] and len(sys.argv) == 3:
        sys.stdout.write(filtered((pathlib.Path.cwd() / sys.argv[2]).resolve()))
    elif sys.argv[1:] == ["check"]:
        sys.exit(0 if check() else 1)
    else:
        sys.exit(__doc__)
