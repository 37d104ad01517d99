#!/usr/bin/env python3
"""check_goal_kinds.py ROOT: checks that a kind of goal has separate folders, and that no other file of the program
names it."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
# Folders and files with code that several kinds of goals share.
shared = {"app/goals/ribs/": ("helmet", "surface"), "app/goals/strip_remedies": ("curve", "space_curve")}
# Folder with the search of a kind, if the kind has no separate one.
search_folders = {"helmet": "optim/ribs"}
kinds = sorted(path.name for path in (root / "app/goals").iterdir() if path.is_dir() and f"app/goals/{path.name}/" not in shared)
registries = {"app/goals/registry.cpp", "app/report/js/goals.js", "app/viewer/src/studio/goals.js"}


def separate_pages(kind):
    return f"app/report/js/goals/{kind}.js", f"app/viewer/src/studio/goals/{kind}.js"


def is_local(file, kind):
    return file.startswith((f"app/goals/{kind}/", *(folder for folder, of in shared.items() if kind in of))) or file in separate_pages(kind)


def type_name(kind):
    return "".join(word.capitalize() for word in kind.split("_"))


def namings(kind):
    """Matches includes of its folders, its types, members and literals. A label of the summary and the ending of a
    file do not count."""
    return re.compile(rf"(?:goals|optim|targets)/{kind}/|\b{type_name(kind)}[A-Z]\w+|(?:\.|->){kind}\b(?! *\(|\")|"
                      rf"(?<!line\()[\"']{kind}[\"']|\b{kind}(?:_kind|Goal|Section|Verdict)\b")


wrong = []
if not namings("space_curve").search("SpaceCurveOutcome") or namings("curve").search("SpaceCurveOutcome"):
    wrong.append("this check does not see the types of a kind of two words")
for kind in kinds:
    for folder in (search_folders.get(kind, f"optim/{kind}"), *separate_pages(kind)):
        if not (root / folder).exists():
            wrong.append(f"{folder} is not there")
    for registry in registries:
        lines = [line for line in (root / registry).read_text().splitlines()
                 if re.match(rf"\s*&?{kind}(_kind|Goal),(\s*//)?$", line)]
        if len(lines) != 1:
            wrong.append(f"{registry} has {len(lines)} lines for {kind} instead of one")

patterns = {kind: namings(kind) for kind in kinds}
type_names = {kind: type_name(kind) for kind in kinds}
files = [path for path in (root / "app").rglob("*") if path.suffix in (".cpp", ".hpp", ".js")]
for path in files:
    file = str(path.relative_to(root))
    if file in registries:
        continue
    lines = [line.split("///")[0] for line in path.read_text().splitlines()]
    for kind in kinds:
        if is_local(file, kind):
            continue
        for number, line in enumerate(lines, 1):
            # Every pattern contains one of the two names. A search for a word is faster than one for a pattern.
            found = (kind in line or type_names[kind] in line) and patterns[kind].search(line)
            if found:
                wrong.append(f"{file}:{number}: names the kind {kind}: {found[0]}")

if len(kinds) < 4 or len(files) < 100:
    sys.exit(f"found only {len(kinds)} kinds and {len(files)} files: is the path right?")
print("\n".join(wrong) or f"{len(files)} files, and only its own name each of {', '.join(kinds)}")
sys.exit(1 if wrong else 0)
