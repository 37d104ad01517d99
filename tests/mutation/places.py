"""Places of a source where a sign or an index can be wrong."""
import collections
import dataclasses
import re

# Lines without working code: compile-time declarations, loop counters, asserts, throws and includes.
PASSED_OVER = re.compile(r"\bfor \(|\bassert\(|\bthrow\b|\bconstexpr\b|\btemplate\b|\busing\b|^\s*#|^\s*(case|namespace)\b")
TEXT_OR_COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'|//[^\n]*|/\*.*?\*/', re.S)
OBJECT = r"(?<![\w.>)\]])(?:[A-Za-z_]\w*(?:\[\w+\]|\(\))?\.)*"
INDEXED = r"(?:\[|\.(?:col|row|at|segment<\d>|middleCols<\d>|middleRows<\d>)\()"

BINARY_SIGN = re.compile(r"(?<=[\w)\]]) ([+-])\s+(?=[\w(*])|\s([+-])= (?=[\w(*])")
UNARY_SIGN = re.compile(r"(?:(?<=[(,{=?:<] )|(?<=\()|(?<=\{)|(?<=return ))-(?=[A-Za-z_(]|\d+\.)")
CROSS = re.compile(r"\.cross\(")
COORDINATE = re.compile(r"\.([xyz])\(\)")
NUMBER = re.compile(r"(?<=[\w\])>])" + INDEXED + r"([0-9])(?=[\])])")
VARIABLE = re.compile(r"(?<=[\w\])>])" + INDEXED + r"([a-z]\w*)(?=[\])])")
PARTNER = {"lower": "upper", "upper": "lower", "first": "second", "second": "first"}
SWAPPED = re.compile("(" + OBJECT + r")\b(lower|upper)(_\w+)?\b(?![(\w])|(" + OBJECT + r")(?<=\.)(first|second)\b(?![(\w])")


@dataclasses.dataclass
class Place:
    """A possible error: edits (start, end, text with {n} for its number) of the source at `path`."""
    path: str
    kind: str  # sign or index
    line: int  # from 1
    key: str  # stays the same as long as the line does
    edits: list


def blanked(source):
    """Returns the source with spaces for texts and comments, so that offsets stay."""
    return TEXT_OR_COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), source)


def closing(code, opening):
    """Returns the position of the parenthesis that closes the one before `opening`; None: it does not close."""
    depth = 1
    for at in range(opening, len(code)):
        depth += {"(": 1, ")": -1}.get(code[at], 0)
        if depth == 0:
            return at
    return None


def signs(code):
    for found in BINARY_SIGN.finditer(code):
        word = found[1] or found[2] + "="
        yield found.start() + 1, f"{word} with the other sign", [(found.end(), found.end(), "kinetix::mutation::sign({n}) * ")]
    for found in UNARY_SIGN.finditer(code):
        yield found.start(), "- with the other sign", [(found.end(), found.end(), "kinetix::mutation::sign({n}) * ")]
    for found in CROSS.finditer(code):
        end = closing(code, found.end())
        if end is not None:
            yield found.start(), "factors of cross swapped", [(found.end(), found.end(), "kinetix::mutation::sign({n}) * ("),
                                                              (end, end, ")")]


def neighbour(number, code, at):
    """Returns another index of the same vector: three further in vectors of coordinates, otherwise one of the first
    three."""
    if code[:at].endswith("segment<3>("):
        return number + 3 if number < 3 else number - 3
    return number - 1 if number else 1


def indices(code):
    for found in COORDINATE.finditer(code):
        right = "xyz".index(found[1])
        wrong = neighbour(right, "", 0)
        yield found.start(), f"{'xyz'[wrong]} for {found[1]}", [(*found.span(), f"[kinetix::mutation::other({{n}}, {right}, {wrong})]")]
    for found in NUMBER.finditer(code):
        right, at = int(found[1]), found.start(1)
        wrong = neighbour(right, code, at)
        yield at, f"{wrong} for {right}", [(at, at + 1, f"kinetix::mutation::other({{n}}, {right}, {wrong})")]
    for found in VARIABLE.finditer(code):
        yield found.start(1), f"{found[1]} - 1 for {found[1]}", [(*found.span(1), f"kinetix::mutation::before({{n}}, {found[1]})")]
    for found in SWAPPED.finditer(code):
        thing, word, rest = (found[1], found[2], found[3] or "") if found[2] else (found[4], found[5], "")
        wrong = PARTNER[word]
        yield found.start(), f"{wrong} for {word}", [(found.start(), found.start(), f"(kinetix::mutation::on({{n}}) ? {thing}{wrong}{rest} : "),
                                                     (found.end(), found.end(), ")")]


def places(path, source):
    """Yields all places of the source, except those in lines that are passed over."""
    code, lines, seen = blanked(source), source.splitlines(), collections.Counter()
    code_lines = code.splitlines()
    for kind, finder in (("sign", signs), ("index", indices)):
        for at, what, edits in finder(code):
            line = code.count("\n", 0, at)
            text = lines[line].strip()
            if PASSED_OVER.search(code_lines[line]):
                continue
            column = at - code.rfind("\n", 0, at) - (len(lines[line]) - len(lines[line].lstrip()))
            key = f"{path}: {text} [{column}: {what}]"
            seen[key] += 1
            yield Place(path, kind, line + 1, key + (f" ({seen[key]})" if seen[key] > 1 else ""), edits)


def with_errors(source, numbered):
    """Returns the source with the errors of (number, place) built in."""
    edits = sorted((edit[0], number, edit[1], edit[2].replace("{n}", str(number)))
                   for number, place in numbered for edit in place.edits)
    for start, _, end, text in reversed(edits):
        source = source[:start] + text + source[end:]
    return source
