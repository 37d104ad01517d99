#!/usr/bin/python3
"""Checks that comments and names are plain English. usage: check_prose.py SOURCE_FOLDER [FOLDER...]

Prints each opening, phrase, long sentence and name that CONTRIBUTING.md rules out, in all folders of code or in those
given. Quoted text in comments (between ` ` or " ") is exempt. Texts for users are checked as well: string literals of
the sources, of the pages' scripts and of Python, README, the documentation, and descriptions in JSON Schemas.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

SELF = "tests/project/check_prose.py"  # quotes every pattern
SLASHES, HASHES = {".hpp", ".cpp", ".js", ".mjs"}, {".py", ".cmake", ".sh", ".txt"}
FOLDERS = ("app", "benchmarks", "cmake", "examples", "kinetix", "model", "optim", "python", "sim", "targets", "tests")

OPENING = re.compile(r"(Of|What|Where|Which|Those|That|By|The same|Likewise|As)\b")
PHRASES = re.compile(r"\b(is told|are told|tells|comes to|come to|taken for|as made|of its own|likewise|so many|a matter for"
                     r"|but for|foretold|floppy|alike)\b", re.IGNORECASE)
LONGEST_SENTENCE = 30  # words
TEXT_FOLDERS = ("app/cli/", "app/files/", "app/formats/", "app/imports/", "app/models/", "app/sweep/plan/", "targets/")
TEXT_FILES = ("app/goals/curve/curve_search.cpp", "app/goals/display/display_file.cpp", "app/goals/fold/fold_shape.cpp",
              "app/goals/outline/outline_search.cpp", "app/goals/surface/surface_file.cpp", "app/print/print_request.cpp")
SCHEMAS = ("app/schema/result.schema.json", "app/schema/print.schema.json", "app/schema/sweep.schema.json")
TEXT_OPENING = re.compile(r"(of|what|where|which|those|likewise|how) ")  # of descriptions, which start in lower case
TEXT_PHRASES = re.compile(r"\b(left out|leave (it )?out|is no|are no|(mm|cells|walls|clearance),? a side|physics run|says|told|alike|beside)\b")
# Home-made terms: docs/glossary.md has the standard ones ("Older words").
TERMS = re.compile(r"\b(physics runs?|hinge gaps?|in matter|made hinges|what prints come to|ways to move|moves? exactly"
                   r"|(proven|certified) free|redrawings?|class[- ][AB]|rotary (hinges?|joints?)|(a|the|whole|of) cords?|cords|films|overstretched"
                   r"|judged?|judges|(mm|clearance|cells|walls|gap),? a side)\b", re.IGNORECASE)
TERM_FOLDERS = ("app/", "kinetix/", "model/", "optim/", "python/", "sim/", "targets/")
VALUES = {"hinge gap exceeded"}  # of results, which keep their words
# Pages that kinetix-formats writes: their texts are checked in the sources.
UNCHECKED_PAGES = re.compile(r"docs/reference/(cli|design|design-of-bodies|formats|print-json|result|sections|sweep|target-\w.*)\.md")
# Code, links and the table of older words.
PAGE_QUOTED = re.compile(r"^```.*?^```|`[^`\n]*`|\]\([^)]*\)|<!--.*?-->|^## Older words$.*", re.MULTILINE | re.DOTALL)
FEWEST_WORDS = 3  # of a text: shorter literals are keys, words and parts of sentences
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
        goes_on = alone and (blocks and blocks[-1][3] or match[0].startswith("///<"))
        if blocks and goes_on and match["line"] is not None and blocks[-1][2] == line - 1:
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


def faults_of_text(text):
    """Faults of a comment or a text: kind and the words that are ruled out."""
    for match in PHRASES.finditer(text):
        yield "phrase", text[max(0, match.start() - 30):match.end() + 30]
    for sentence in sentences_of(text):
        words = re.findall(r"[A-Za-z]{2,}[\w'-]*|\ba\b", sentence)
        if len(words) > LONGEST_SENTENCE:
            yield "sentence", f"{len(words)} words: {sentence[:90]}"


def text_faults(line, text):
    """Faults of a text for users."""
    plain = re.sub(r"`[^`]*`", "x", text)
    if len(plain.split()) < FEWEST_WORDS:
        return
    if OPENING.match(plain) or TEXT_OPENING.match(plain):
        yield "text", line, text[:90]
    for match in TEXT_PHRASES.finditer(plain):
        yield "text", line, plain[max(0, match.start() - 30):match.end() + 30]
    for kind, words in faults_of_text(plain):
        yield kind, line, words


def literals_of(source):
    """String literals of C++ with those next to them joined: pairs of line number and text."""
    literal = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|\'(?:[^\'\\\n]|\\.)*\'|(?P<text>"(?:[^"\\\n]|\\.)*"'
                         r'(?:\s*"(?:[^"\\\n]|\\.)*")*)', re.DOTALL)
    for match in literal.finditer(source):
        if match["text"]:
            parts = re.findall(r'"((?:[^"\\\n]|\\.)*)"', match["text"])
            yield source.count("\n", 0, match.start()) + 1, "".join(parts).replace('\\"', "'")


def term_faults(line, text):
    """Phrases and home-made terms of a text for users. Words in backticks are exempt."""
    plain = re.sub(r"`[^`]*`", "x", text)
    if " " not in plain.strip() or text in VALUES:
        return
    for pattern in (PHRASES, TERMS):
        for match in pattern.finditer(plain):
            yield "term", line, plain[max(0, match.start() - 30):match.end() + 30]


def script_texts(source):
    """String literals of scripts for browsers, without the code in templates: pairs of line number and text."""
    for match in SLASH_COMMENT.finditer(source):
        text = match["text"] or match["raw"]
        if text:
            yield source.count("\n", 0, match.start()) + 1, re.sub(r"\$\{[^}]*\}", "x", text[1:-1])


def html_texts(source):
    for match in re.finditer(r'>([^<>]+)<|(?:title|aria-label|placeholder)="([^"]*)"', source):
        yield source.count("\n", 0, match.start()) + 1, match[1] or match[2] or ""


def python_texts(source):
    for match in HASH_COMMENT.finditer(source):
        text = match["text"] or match["block"]
        if text:
            yield source.count("\n", 0, match.start()) + 1, text.strip("'\"")


def page_texts(source):
    """Prose of a page, line by line. Quoted parts are blank."""
    prose = PAGE_QUOTED.sub(lambda match: "x" + "\n" * match[0].count("\n"), source)
    # A phrase may continue on the next line.
    lines = prose.split("\n")
    for number, line in enumerate(lines, 1):
        yield number, line
    for number in range(1, len(lines)):
        ends = " ".join(lines[number - 1].split()[-2:]), " ".join(lines[number].split()[:2])
        yield number, " ".join(ends)


TEXTS = {".cpp": literals_of, ".hpp": literals_of, ".js": script_texts, ".mjs": script_texts, ".html": html_texts,
         ".py": python_texts, ".md": page_texts, ".in": page_texts}


def texts_for_users(root):
    names = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", *TERM_FOLDERS, "docs/*.md", "README.md"],
                           check=True, capture_output=True, text=True).stdout.split()
    for name in sorted(names):
        path = root / name
        if path.suffix in TEXTS and not UNCHECKED_PAGES.fullmatch(name) and path.is_file():
            yield name, TEXTS[path.suffix](path.read_text(encoding="utf-8"))


def descriptions_of(schema):
    if isinstance(schema, dict):
        if isinstance(schema.get("description"), str):
            yield schema["description"]
        for value in schema.values():
            yield from descriptions_of(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from descriptions_of(value)


def schema_faults(root):
    for name in SCHEMAS:
        for text in descriptions_of(json.loads((root / name).read_text(encoding="utf-8"))):
            for kind, _, words in [*text_faults(0, text), *term_faults(0, text)]:
                yield f"{name}: {kind}: {words}"


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
        for kind, words in faults_of_text(plain):
            yield kind, line, words
    if path.suffix in {".cpp", ".hpp"} and (str(path).startswith(TEXT_FOLDERS) or str(path) in TEXT_FILES):
        for line, text in literals_of(source):
            yield from text_faults(line, text)
    seen = set()
    for number, line in enumerate(code_of(source, pattern).split("\n"), 1):
        if "[[deprecated" in line:  # an alias keeps its old name
            continue
        for name in (CAMEL_NAME if path.suffix in {".js", ".mjs"} else NAME).findall(line):
            if name not in seen and is_forbidden(name):
                seen.add(name)
                yield "name", number, name


def finds_expected_faults():
    """Proves on a small source that each kind of fault is found, and nothing else."""
    source = """int turns = 0;  ///< per cell
/// By the drive's load: a new block.
/// Adds a turn. It is told to stop at "what is told".
void tell_state(int seconds_a_cell);
/// {}.
const char* text = "of what_is_told";
""".format("word " * (LONGEST_SENTENCE + 1))
    found = [(kind, line) for kind, line, _ in hits_of(Path("a.cpp"), source)]
    texts = 'f("of the rod of a pin"); f("is " "told; leave it out"); f("width of `a side`, per side"); f("of it");'
    found_texts = [(kind, line) for kind, line, _ in hits_of(Path("targets/a.cpp"), texts)]
    terms = [list(term_faults(1, text)) for text in (
        "the physics run agrees", "`physics run` of a hinge", "as made", "hinge gap exceeded", "a cord of `cord`", "kind: cord, x")]
    pages = [line for line, text in page_texts("one\nthe physics\nrun `as made`\n## Older words\nas made\n")
             if list(term_faults(line, text))]
    return ([len(hits) for hits in terms] == [1, 0, 1, 0, 1, 0] and pages == [2] and found == [("opening", 2), ("phrase", 2), ("sentence", 5), ("name", 4), ("name", 4)]
            and found_texts == [("text", 1), ("text", 1), ("text", 1), ("phrase", 1)])


def files(root):
    names = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", *FOLDERS], check=True,
                           capture_output=True, text=True).stdout.split()
    for name in sorted(names):
        path = root / name
        if name != SELF and path.suffix in SLASHES | HASHES and path.is_file():
            yield name, path


def main():
    if not finds_expected_faults():
        print("the patterns do not find the faults of a small source")
        return True
    root, wanted = Path(sys.argv[1]), tuple(sys.argv[2:])
    faults = [f"{name}:{line}: {kind}: {words}" for name, path in files(root) if name.startswith(wanted or "")
              for kind, line, words in hits_of(Path(name), path.read_text(encoding="utf-8"))]
    if not wanted or "app".startswith(wanted):
        faults += schema_faults(root)
    faults += [f"{name}:{line}: {kind}: {words}" for name, texts in texts_for_users(root) if name.startswith(wanted or "")
               for line, text in texts for kind, line, words in term_faults(line, text)]
    print("\n".join(faults) or "comments and names are plain English")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
