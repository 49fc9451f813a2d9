# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Ridgeway authors
"""manual.py PROGRAM FOLDER: man pages and bash completion of the command line.

All of it comes from `PROGRAM --help --json`, what the program itself parses by, so that none can
say another thing than the program does.
"""

import json
import pathlib
import subprocess
import sys


def troff(text):
    """Text as troff takes it: no letter of it is a command."""
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\n".join("\\&" + line if line.startswith((".", "\\(aq")) else line for line in text.split("\n"))


def placeholder(option):
    if "choices" in option:
        return "|".join(option["choices"]) + (",..." if option["type"] == "choices" else "")
    return {
        "path": "PATH", "number": "NUMBER", "numbers": "NUMBER,...", "whole": "N", "wholes": "N,...",
        "point": "X,Y,Z", "box": "X0,Y0,Z0,X1,Y1,Z1", "transform": "TRANSFORM", "tuple": "NUMBER,...",
    }.get(option["type"], option["type"].upper())


def usage(option):
    """The option as it is written, in troff."""
    if option["positional"]:
        return "\\fI%s\\fR%s" % (troff(option["name"].upper()), "..." if option["repeated"] else "")
    names = [option[key] for key in ("short", "name") if key in option]
    text = ", ".join("\\fB%s\\fR" % troff(name) for name in names)
    return text if option["type"] == "flag" else text + " \\fI%s\\fR" % troff(placeholder(option))


def described(option):
    facts = [option["help"] + ("" if option["help"].endswith(".") else ".")]
    if option["required"] and not option["positional"]:
        facts.append("Required.")
    if option["repeated"]:
        facts.append("May be given several times.")
    if "default" in option:
        facts.append("Default: %s." % option["default"])
    return ".TP\n%s\n%s\n" % (usage(option), troff(" ".join(facts)))


def page(words, command, version, others, shared):
    """One man page, of the program or of one of its commands."""
    name = "-".join(words)
    text = '.TH "%s" 1 "" "ridgeway %s" "Ridgeway"\n' % (troff(name.upper()), version)
    text += ".SH NAME\n%s \\- %s\n" % (troff(name), troff(command["help"]))
    text += ".SH SYNOPSIS\n.B %s\n" % troff(" ".join(words))
    for option in command["options"]:
        if option["required"]:
            text += usage(option) + "\n"
    text += "[\\fIOPTIONS\\fR]\n" if not command["commands"] else "\\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
    for title, listed in (("COMMANDS", command["commands"]),):
        if listed:
            text += ".SH %s\n" % title
            text += "".join(".TP\n\\fB%s\\fR\n%s\n" % (troff(c["name"]), troff(c["help"])) for c in listed)
    options = command["options"] + (shared if len(words) > 1 else [])
    if options:
        text += ".SH OPTIONS\n" + "".join(described(option) for option in options)
    if "footer" in command:
        text += ".SH NOTES\n.nf\n%s\n.fi\n" % troff(command["footer"])
    if others:
        text += ".SH SEE ALSO\n%s\n" % ",\n".join("\\fB%s\\fR(1)" % troff(other) for other in others)
    return text


def every_command(command, words):
    yield words, command
    for inner in command["commands"]:
        yield from every_command(inner, words + [inner["name"]])


def completion(program):
    """A bash function that knows every command, option and choice."""
    shared = program["options"]
    cases, values = [], []
    for words, command in every_command(program, ["ridgeway"]):
        known = [c["name"] for c in command["commands"]]
        known += [o["name"] for o in command["options"] + (shared if len(words) > 1 else [])
                  if not o["positional"]] + ["--help"]
        cases.append('    "%s") words="%s" ;;' % (" ".join(words), " ".join(known)))
        for option in command["options"]:
            if option["positional"] or option["type"] == "flag":
                continue
            names = "|".join('"%s %s"' % (" ".join(words), option[key]) for key in ("short", "name") if key in option)
            what = "-W '%s'" % " ".join(option["choices"]) if "choices" in option else "-f" if option["type"] == "path" else "-W ''"
            values.append('    %s) COMPREPLY=($(compgen %s -- "$current")); return ;;' % (names, what))
        for option in command["options"]:
            if option["positional"] and "choices" in option:
                cases[-1] = cases[-1].replace('words="', 'words="%s ' % " ".join(option["choices"]))
    commands = " ".join('"%s"' % " ".join(words) for words, _ in every_command(program, ["ridgeway"]))
    return """# bash completion of ridgeway, made from its own description
_ridgeway() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=ridgeway word words known
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    for known in %s; do
      [[ "$command $word" != "$known" ]] || command=$known
    done
  done
  case "$command $before" in
%s
  esac
  case "$command" in
%s
  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
  [[ $current == -* ]] || COMPREPLY+=($(compgen -f -- "$current"))
}
complete -o filenames -F _ridgeway ridgeway
""" % (commands, "\n".join(values), "\n".join(cases))


def main():
    binary, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    program = json.loads(subprocess.run([binary, "--help", "--json"], check=True, capture_output=True).stdout)
    version = subprocess.run([binary, "--version"], check=True, capture_output=True, text=True).stdout.split()[-1]
    folder.mkdir(parents=True, exist_ok=True)
    pages = list(every_command(program, ["ridgeway"]))
    names = ["-".join(words) for words, _ in pages]
    for words, command in pages:
        name = "-".join(words)
        others = names[1:] if name == "ridgeway" else ["ridgeway"]
        (folder / (name + ".1")).write_text(page(words, command, version, others, program["options"]))
    (folder / "ridgeway.bash").write_text(completion(program))


main()
