#!/usr/bin/python3
"""Checks the documentation. usage: check_docs.py SOURCE_FOLDER

Every cited page and section exists. Every relative link of a page leads to a file, and every path that a page
names exists. The figures on disk are those that docs/figures/draw.py draws, and each figure is shown on a page.
Every package is in the table of licences.
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

# Folders without documentation. The inputs of fuzzers (corpus) are not text.
SKIPPED = {".git", "build", "results", "__pycache__", "node_modules", "corpus"}
CODE = {".hpp", ".cpp", ".in", ".py", ".cmake", ".sh", ".js", ".mjs", ".html", ".css", ""}
TEXTS = CODE | {".md", ".txt", ".yaml", ".json"}
SELF = "tests/project/check_docs.py"  # cites pages that do not exist, to see that it notices
# Pages and folders that are cited before they are written. Existing ones must not be listed here.
PROMISED = set()
# Fewer than this in the whole repository mean that the patterns below match nothing.
LEAST_CITATIONS, LEAST_LINKS, LEAST_PATHS = 40, 40, 100

CITATION = re.compile(r"(?<![\w$/}.-])((?:[\w.-]+/)*[\w-]+\.md)\b(?:,? section (\d+))?")
LINK = re.compile(r"!?\[(?:[^\[\]]|!?\[[^\]]*\]\([^)]*\))*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.*)$", re.MULTILINE)
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
# Folders at the top of the repository. A path of the repository begins with one of them.
TOPS = "app|benchmarks|cmake|docs|examples|kinetix|model|optim|packages|python|sim|targets|tests"
PATH = re.compile(rf"(?<![\w$/}}.<-])((?:{TOPS})/[\w./*<>-]+)")
# Line breaks inside a comment. A citation may continue over them.
COMMENT_BREAK = re.compile(r"\n\s*(?:///?<?|#|\*)? *")


class Repository:
    def __init__(self, root):
        self.root = Path(root).resolve()
        self.texts = {path.relative_to(self.root).as_posix(): path.read_text(encoding="utf-8")
                      for path in files(self.root)}
        self.pages = [name for name in self.texts if name.endswith(".md")]
        self.citations = self.links = self.paths = 0

    def pages_named(self, name):
        """Returns the pages below docs with a file name."""
        return [page for page in self.pages if page.startswith("docs/") and os.path.basename(page) == name]

    def exists(self, name):
        return name in PROMISED or (self.root / name).exists()


def files(root):
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(set(folders) - SKIPPED)
        for name in sorted(names):
            if Path(name).suffix in TEXTS:
                yield Path(folder) / name


def normal(*parts):
    return os.path.normpath(os.path.join(*parts)).replace(os.sep, "/")


def promises_kept(repository):
    for name in sorted(PROMISED):
        if (repository.root / name).exists():
            yield f"{name} exists now: take it off the list of promised pages in {SELF}"


def citations(repository):
    """Yields citations of pages that do not exist. A citation may be the file name of a page below docs. It may be
    relative to the root, to the citing file's folder, or to docs/reference, where tables of keys go."""
    for name, text in repository.texts.items():
        if name == SELF:
            continue
        for match in CITATION.finditer(COMMENT_BREAK.sub(" ", text)):
            repository.citations += 1
            page, section = match.groups()
            places = [normal(page), normal(os.path.dirname(name), page), normal("docs/reference", page),
                      *repository.pages_named(page)]
            found = next((place for place in places if repository.exists(place)), None)
            if found is None:
                yield f"{name} cites {page}, which does not exist"
            elif section and not has_section(repository.texts.get(found, ""), section):
                yield f"{name} cites section {section} of {found}, which has no such section"


def has_section(page, number):
    return re.search(rf"^#+ {number}\. ", page, re.MULTILINE)


def anchor(heading):
    """Returns the anchor that GitHub makes from a heading."""
    plain = re.sub(r"<[^>]*>|[*`]", "", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")


def anchors(page):
    return {anchor(heading) for heading in HEADING.findall(FENCE.sub("", page))}


def links(repository):
    for name in repository.pages:
        for target in LINK.findall(FENCE.sub("", repository.texts[name])):
            if re.match(r"[a-z]+:", target):
                continue
            repository.links += 1
            path, _, fragment = target.partition("#")
            place = normal(os.path.dirname(name), path) if path else name
            if not repository.exists(place):
                yield f"{name} links to {target}, which does not exist"
            elif fragment and place in repository.pages and fragment not in anchors(repository.texts[place]):
                yield f"{name} links to {target}: {place} has no such heading"


def paths(repository):
    """Yields paths that do not exist in pages and their sources. A path may omit the ending of its file, and may end
    in a <name>."""
    for name in repository.pages + [name for name in repository.texts if name.endswith("page.in")]:
        for path in PATH.findall(repository.texts[name]):
            repository.paths += 1
            known = path.partition("<")[0].rstrip(".,-")
            known = known.rpartition("/")[0] if "<" in path else known
            if not any(list(repository.root.glob(known + ending)) for ending in ("", ".hpp", ".cpp")):
                yield f"{name} names {path}, which does not exist"


def figures(repository):
    folder = repository.root / "docs/figures"
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([sys.executable, "-B", folder / "draw.py", scratch], check=True)
        drawn = {path.name: path.read_bytes() for path in Path(scratch).glob("*.svg")}
    there = {path.name: path.read_bytes() for path in folder.glob("*.svg")}
    for name in sorted(drawn.keys() | there.keys()):
        if name not in drawn:
            yield f"docs/figures/{name} is drawn by nothing: delete it or add it to draw.py"
        elif drawn[name] != there.get(name):
            yield f"docs/figures/{name} is not what draw.py draws: run docs/figures/draw.py"
        elif not any(f"figures/{name}" in repository.texts[page] for page in repository.pages):
            yield f"docs/figures/{name} is shown on no page"


def licences(repository):
    table = repository.texts.get("docs/project/licences.md", "")
    lists = [*repository.root.glob("packages*.txt"), *repository.root.glob("packages/*.txt")]
    if not lists:
        yield "no list of packages found: is the pattern right?"
    for path in sorted(lists):
        for line in path.read_text(encoding="utf-8").splitlines():
            package = line.partition("#")[0].strip()
            if package and not re.search(rf"(?<![\w-]){re.escape(package)}(?![\w-])", table):
                yield f"{path.name}: {package} is not in docs/project/licences.md"


def enough(repository):
    for count, least, what in ((repository.citations, LEAST_CITATIONS, "citations"),
                               (repository.links, LEAST_LINKS, "links"),
                               (repository.paths, LEAST_PATHS, "paths")):
        if count < least:
            yield f"found only {count} {what}: is the pattern right?"


def finds_faults():
    """Proves on a small repository that the checks find their faults and nothing else."""
    wrong = {
        "a.hpp": ("/// (gone.md section 1)\n", "gone.md, which does not exist"),
        "b.hpp": ("/// As kinematics.md\n/// section 9 says.\n", "no such section"),
        "c.md": ("[text](nowhere.png)\n", "nowhere.png, which does not exist"),
        "d.md": ("[text](docs/explanation/kinematics.md#nothing)\n", "no such heading"),
        "f.md": ("see `model/gone` for it\n", "model/gone, which does not exist"),
        "g.md": ("`model/lattice/gone/<name>.cpp`\n", "which does not exist"),
        "packages.txt": ("libunknown-dev\n", "libunknown-dev is not in"),
    }
    right = {
        "docs/explanation/kinematics.md": "## 1. One *thing*\n[up](#1-one-thing)\n",
        "model/here.hpp": "",
        "h.md": "`model/here`, `model/*.hpp`, model/<name>, (model/here.hpp).\n",
        "e.hpp": "// kinematics.md section 1\n",
    }
    complaints = complaints_about({**right, **{name: text for name, (text, _) in wrong.items()}})
    for _, words in wrong.values():
        seen = [complaint for complaint in complaints if words in complaint]
        complaints = [complaint for complaint in complaints if complaint not in seen]
        if not seen:
            yield f"this check misses: {words}"
    yield from (f"this check complains of what is right: {complaint}" for complaint in complaints)


def complaints_about(texts):
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in texts.items():
            path = Path(scratch) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        small = Repository(scratch)
        return [*citations(small), *links(small), *paths(small), *licences(small)]


def main():
    repository = Repository(sys.argv[1])
    complaints = list(finds_faults())
    for check in (promises_kept, citations, links, paths, figures, licences, enough):
        complaints += check(repository)
    counts = f"{repository.citations} citations, {repository.links} links and {repository.paths} paths lead somewhere"
    print("\n".join(complaints) or counts)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
