#!/usr/bin/python3
"""Checks that comments and names are plain English. usage: check_prose.py SOURCE_FOLDER [--list [FOLDER...]]

Counts, for each folder, the openings, phrases, sentences and names that CONTRIBUTING.md rules out. A count may only
fall: a smaller one replaces the number in MOST. `--list` prints each hit with its place instead. Quoted text in
comments (between ` ` or " ") is exempt.
"""
import re
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

# Hits that remain, for each folder: openings, phrases, long sentences, names. No entry: none.
MOST = {}

SELF = "tests/project/check_prose.py"  # quotes every pattern
SLASHES, HASHES = {".hpp", ".cpp", ".js", ".mjs"}, {".py", ".cmake", ".sh", ".txt"}
FOLDERS = ("app", "benchmarks", "cmake", "examples", "kinetix", "model", "optim", "python", "sim", "targets", "tests")

OPENING = re.compile(r"(Of|What|Where|Which|Those|That|By|The same|Likewise|As)\b")
PHRASES = re.compile(r"\b(is told|are told|tells|comes to|come to|taken for|as made|of its own|likewise|so many|a matter for"
                     r"|but for|foretold|floppy|alike)\b", re.IGNORECASE)
LONGEST_SENTENCE = 30  # words
TOKENS = {"told", "tell", "say", "hear", "what", "own", "beat", "visitors"}
NAME = re.compile(r"\b[A-Za-z]\w*_\w+\b")
CAMEL_NAME = re.compile(r"\b[A-Za-z]\w*(?:_\w+|[a-z0-9][A-Z]\w*)\b")  # also of scripts for browsers

TEXT = r"""(?P<text>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')"""
SLASH_COMMENT = re.compile(r"""(?P<raw>R"(?P<mark>\w*)\(.*?\)(?P=mark)"|`[^`]*`)|""" + TEXT +
                           r"""|//[/!]?<?(?P<line>[^\n]*)|/\*\*?(?P<block>.*?)\*/""", re.DOTALL)
HASH_COMMENT = re.compile(r"""(?P<raw>(?:(?<=[=(,] )|(?<=\())\"{3}.*?\"{3})|(?P<block>\"{3}.*?\"{3})|""" + TEXT +
                          r"""|(?<![\w$&{])#(?P<line>[^\n]*)""", re.DOTALL)


def comments_of(source, pattern):
    """Blocks of comment: pairs of first line number and text. Lines below one another make one block."""
    blocks = []
    for match in pattern.finditer(source):
        if match["line"] is None and match["block"] is None:
            continue
        line = source.count("\n", 0, match.start()) + 1
        text = match["line"]
        if text is None:  # an empty line ends a sentence
            text = re.sub(r"\n\s*\n", ". ", re.sub(r"\n[ \t]*\*", "\n", match["block"].strip('"')))
        alone = not source[source.rfind("\n", 0, match.start()) + 1:match.start()].strip()
        if blocks and match["line"] is not None and (alone or blocks[-1][3]) and blocks[-1][2] == line - 1 and alone:
            blocks[-1][1] += " " + text.strip()
            blocks[-1][2] = line
        else:
            blocks.append([line, text.strip(), source.count("\n", 0, match.end()) + 1, alone])
    return [(line, re.sub(r"\s+", " ", text)) for line, text, _, _ in blocks]


def code_of(source, pattern):
    """The source without comments and quoted text, line for line."""
    return pattern.sub(lambda match: "\n" * match[0].count("\n"), source)


def sentences_of(text):
    return re.split(r"(?<=[.!?])\s+", text)


def quoted_away(text):
    return re.sub(r"`[^`]*`|\"[^\"]*\"", "x", text)


def is_forbidden(name):
    """Finds names with a token that is ruled out, or with "a" for per. In names of tests "a" is the article."""
    tokens = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name.strip("_")).lower().split("_")
    return bool(TOKENS & set(tokens)) or "a" in tokens[1:-1] and tokens[0] != "test"


def hits_of(path, source):
    """Hits of a file: kind, line and the words that are ruled out."""
    pattern = SLASH_COMMENT if path.suffix in SLASHES else HASH_COMMENT
    for line, text in comments_of(source, pattern):
        plain = quoted_away(text)
        if OPENING.match(plain):
            yield "opening", line, text[:90]
        for match in PHRASES.finditer(plain):
            yield "phrase", line, plain[max(0, match.start() - 30):match.end() + 30]
        for sentence in sentences_of(plain):
            words = re.findall(r"[A-Za-z]{2,}[\w'-]*|\ba\b", sentence)
            if len(words) > LONGEST_SENTENCE:
                yield "sentence", line, f"{len(words)} words: {sentence[:90]}"
    seen = set()
    for number, line in enumerate(code_of(source, pattern).split("\n"), 1):
        if "[[deprecated" in line:  # an alias keeps its old name
            continue
        for name in (CAMEL_NAME if path.suffix in {".js", ".mjs"} else NAME).findall(line):
            if name not in seen and is_forbidden(name):
                seen.add(name)
                yield "name", number, name


def files(root):
    names = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", *FOLDERS], check=True,
                           capture_output=True, text=True).stdout.split()
    for name in sorted(names):
        path = root / name
        if name != SELF and path.suffix in SLASHES | HASHES and path.is_file():
            yield name, path


def room_of(name):
    return name.split("/")[0]


def main():
    root = Path(sys.argv[1])
    listing, wanted = "--list" in sys.argv, [word for word in sys.argv[2:] if word != "--list"]
    counts = defaultdict(Counter)
    names = defaultdict(set)
    for name, path in files(root):
        for kind, line, words in hits_of(path, path.read_text(encoding="utf-8")):
            if kind == "name":
                if words in names[room_of(name)]:
                    continue
                names[room_of(name)].add(words)
            counts[room_of(name)][kind] += 1
            if listing and (not wanted or any(name.startswith(folder) for folder in wanted)):
                print(f"{name}:{line}: {kind}: {words}")
    if listing:
        return 0
    found = {room: [count[kind] for kind in ("opening", "phrase", "sentence", "name")] for room, count in counts.items()}
    faults = []
    for room in sorted(set(found) | set(MOST)):
        have, most = found.get(room, [0] * 4), MOST.get(room, [0] * 4)
        if have != most:
            verdict = "more than" if any(a > b for a, b in zip(have, most)) else "fewer than"
            faults.append(f"{room}: openings, phrases, long sentences, names {have}, {verdict} {most} in MOST: --list {room}")
    print("\n".join(faults) or "comments and names are as plain as before")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
