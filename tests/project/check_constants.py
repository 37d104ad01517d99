#!/usr/bin/env python3
"""check_constants.py ROOT: checks that every number has a reason and every quantity a unit.

1. Each numeric constant of a file or class has a comment of three words or more. The comment is on its first or
last line, on the lines above, or above its block of constants (without an empty line in between). Constants that
are texts, tables of names or NaN need no comment.
2. Each public field of doubles in a header has a unit. The unit is at the end of its name (edge_mm), in its
comment, in the comment above its block of fields, or in the docstring of its type.
"""
import pathlib
import re
import sys

ROOMS = ("model", "targets", "optim", "sim", "app", "tests", "benchmarks", "examples", "kinetix", "python")
ROOMS_OF_FIELDS = ("model", "targets", "optim", "sim", "app", "python")
LEAST_WORDS = 3
# Smaller numbers mean that the reader of sources below is wrong.
LEAST_CONSTANTS, LEAST_FIELDS = 300, 300

# Units in the comment of a field or of its type.
UNITS = (
    r"mm2?", r"mm\^[23]", r"millimetres?", "cm", "metres?", "inch(es)?",  # lengths
    "cell edges?", "edges?", "edge lengths?", r"edge\^2", "wall heights?", "px", "pixels?",
    "rad", "radians?", "deg", "degrees?", "°",  # angles
    "N", "N/mm", "N mm", "N mm/rad", "MPa", "kg", "k_point", "k_turn", "part mass(es)?",
    "s", "ms", "seconds", "milliseconds", "hours", "1/s", "rad/s", "edges/s", "Hz",
    "fractions?", "ratios?", "per ?cent", "%", "dimensionless",  # of others
    r"-?[01] (to|or) \+?1", r"[\[(]-?[01], 1[\])]",
    "unit length", "unit vectors?", "unit normals?", "unit cube", "rotation matrix", "quaternion",
    "units? of", r"in (\w+ )?units?", r"(its|their|\w+['’]s) units?",
)
# Words that are units only in the comment of the field itself. In a docstring they may mean something else.
RELATIONS = ("shares?", "parts?", "mass(es)?", "over the", "times", "multiple", "per", "counts?", "number of",
             "probabilit(y|ies)", "chance", "correlation", "quantiles?", "logarithms?")


def any_word_of(words):
    return re.compile(r"(?<![\w'’-])(?:" + "|".join(words) + r")(?![\w'’])")


UNIT_OF_FIELD, UNIT_OF_TYPE = any_word_of(UNITS + RELATIONS), any_word_of(UNITS)
UNIT_IN_NAME = re.compile(r"_(mm2?|rad|deg|degrees|s|ms|seconds|px|pixels|edges|N|MPa|fraction|ratio|share|"
                          r"part|percent|count)_?$")

NUMBER_TYPE = re.compile(r"\b(double|float|int|long|unsigned|u?int\d+_t|size_t|ptrdiff_t|Index|\w*seconds|"
                         r"\w*Vector[0-9X]+d?|Matrix[0-9X]+d?)\b")
DOUBLES = re.compile(r"\b(double|float|SparseMatrix|(Row)?Vector[0-9X]+d?|Matrix[0-9X]*d?|ArrayX\w*)\b")


class Scope:
    """A pair of braces of a namespace, a type (with its docstring) or anything else."""

    def __init__(self, kind, docstring="", is_public=True):
        self.kind, self.docstring, self.is_public = kind, docstring, is_public


class Statement:
    """A declaration in a namespace or type: its code in one line, its first and last line (from 0)."""

    def __init__(self, code, first, last, scopes):
        self.code, self.first, self.last, self.scopes = code, first, last, scopes


def split_comments(text):
    """Separates code and comments: code with empty texts, and the comment of each line. Line numbers do not change."""
    code, comments = [], [""] * (text.count("\n") + 1)
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|'
                         r"(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'", re.S)
    at = 0
    for found in pattern.finditer(text):
        code.append(text[at:found.start()])
        at, piece = found.end(), found[0]
        line = text.count("\n", 0, found.start())
        if piece.startswith("/"):
            for n, part in enumerate(piece.split("\n")):
                comments[line + n] += part.strip("/*!< \t") + " "
            code.append("\n" * piece.count("\n"))
        else:
            code.append('""' + "\n" * piece.count("\n"))
    code.append(text[at:])
    return "".join(code), comments


class Source:
    def __init__(self, text):
        code, self.comments = split_comments(text)
        self.columns = [max(line.find("//"), line.find("/*")) for line in text.split("\n")]
        code = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: "\n" * m[0].count("\n"), code, flags=re.M)
        self.lines = code.split("\n")
        self.statements = list(self.read(code))

    def read(self, code):
        """Yields the statements of namespaces and types, except those inside functions and initialisers."""
        scopes, text, first, line = [Scope("namespace")], "", None, 0
        hidden, is_body, brackets = 0, False, 0
        for c in code:
            if c == "\n":
                line += 1
                text += " " if text else ""
                continue
            if hidden:  # inside a function or an initialiser, `hidden` braces deep
                hidden += {"{": 1, "}": -1}.get(c, 0)
                text += c
                if not hidden and is_body:
                    text, first = "", None
                continue
            if first is None and not c.isspace():
                first = line
            brackets += {"(": 1, ")": -1}.get(c, 0)
            if c == "{":
                kind = "other" if brackets else self.kind_of(text)
                if kind == "other":
                    hidden, is_body = 1, not brackets and self.is_function(text)
                    text += c
                    continue
                public = not re.search(r"\bclass\b", text)
                scopes.append(Scope(kind, self.above(first) + self.comments[first], public))
                text, first = "", None
            elif c == "}":
                if len(scopes) > 1:
                    scopes.pop()
                text, first = "", None
            elif c == ";" and not brackets:
                if text.strip():
                    yield Statement(text.strip(), first, line, list(scopes))
                text, first = "", None
            elif c == ":" and re.fullmatch(r"\s*(public|private|protected)\s*", text):
                scopes[-1].is_public = "public" in text
                text, first = "", None
            else:
                text += c

    @staticmethod
    def kind_of(text):
        if re.search(r"\bnamespace\b[\w\s:]*$|\bextern \"\"\s*$", text):
            return "namespace"
        if "(" not in text.split(":")[0] and "=" not in re.sub(r"template\s*<[^{]*?>\s*", "", text) and \
                re.search(r"\b(struct|class|union)\s+(\[\[\w+\]\]\s*)?[\w:]+", text):
            return "type"
        return "other"

    @staticmethod
    def is_function(head):
        """Checks whether a brace after `head` opens the body of a function or enum, not an initialiser. A space
        precedes the brace of a body but not that of a member's initialiser. Other initialisers follow a `=`."""
        if not head[-1:].isspace():
            return False
        opened = re.search(r"[=(]", re.sub(r"\boperator\s*[=<>!+*/-]+", "operator", head))
        return bool(opened) and opened[0] == "(" or bool(re.match(r"\s*(typedef )?enum\b", head))

    def is_comment(self, line):
        """Checks whether the line is a comment for the code below: it has no code and does not continue a trailing
        comment."""
        return self.is_bare(line) and not self.continues(line)

    def is_bare(self, line):
        return 0 <= line < len(self.lines) and not self.lines[line].strip() and bool(self.comments[line])

    def continues(self, line):
        """Checks whether a comment beside code continues in this line, in the same column."""
        above = line - 1
        while self.is_bare(above) and self.columns[above] == self.columns[line]:
            above -= 1
        return self.is_bare(line) and above >= 0 and bool(self.lines[above].strip()) and \
            bool(self.comments[above]) and self.columns[above] == self.columns[line]

    def above(self, line):
        """Returns the comment that ends on the line before."""
        first = line
        while self.is_comment(first - 1):
            first -= 1
        return "".join(self.comments[first:line])

    def end(self, statement):
        """Returns the last line of a statement, including the lines that continue its trailing comment."""
        line = statement.last
        while self.continues(line + 1):
            line += 1
        return line

    def beside(self, statement):
        return "".join(self.comments[statement.first:self.end(statement) + 1])


def is_constant(s):
    in_type = s.scopes[-1].kind == "type"
    if in_type and not re.match(r"(inline )?static constexpr\b|constexpr static\b", s.code):
        return False
    if not re.match(r"((inline|static|extern) )*(constexpr|const)\b", s.code):
        return False
    opened = re.search(r"[={(]", s.code)
    if not opened or (opened[0] == "(" and not re.match(r'\(("|\d)', s.code[opened.start():])):
        return False
    head, value = s.code[:opened.start()], s.code[opened.start():]
    if "quiet_NaN" in value:
        return False
    return bool(NUMBER_TYPE.search(head) or re.search(r"(?<![\w.])\.?\d", value))


def name_of(s):
    head = re.split(r"[={;]", s.code)[0]
    return re.sub(r"\[.*?\]", "", head).split()[-1]


def field_names(s):
    """Returns the names that a field declares: more than one in `double lower = 0, upper = 1`."""
    code = re.sub(r"<[^<>]*>", "", re.sub(r"<[^<>]*>", "", s.code))
    code = re.sub(r"\([^()]*\)|\{[^{}]*\}", "", code)
    return [re.split(r"[=\[]", part)[0].split()[-1].strip("&*") for part in code.split(",") if part.split()]


def is_field(s):
    if not (s.scopes[-1].kind == "type" and all(scope.is_public for scope in s.scopes)):
        return False
    if re.match(r"(using|typedef|friend|static|constexpr|template|operator|virtual|explicit)\b", s.code):
        return False
    head = re.sub(r"<[^<>]*>", "<>", re.sub(r"<[^<>]*>", "<>", re.split(r"[={]", s.code)[0]))
    code = re.split(r"[={]", s.code)[0]
    code = re.sub(r"\b(?!Matrix|Vector|Array|SparseMatrix|Ref|Map)[A-Z]\w*<double>", "", code)
    return "(" not in head and "std::function" not in s.code and bool(DOUBLES.search(code))


def has_reason(source, s, block_comment):
    said = (source.beside(s), source.above(s.first), block_comment)
    return any(len(text.split()) >= LEAST_WORDS for text in said)


def with_block_comments(source, statements):
    """Yields each statement with the comment above its block of consecutive statements."""
    last, comment = None, ""
    for s in statements:
        if last is None or s.first != last + 1:
            comment = source.above(s.first)
        last = source.end(s)
        yield s, comment


def constants(source):
    return [s for s in source.statements if is_constant(s)]


def fields(source):
    return [s for s in source.statements if is_field(s)]


def constants_without_reason(source):
    for s, comment in with_block_comments(source, constants(source)):
        if not has_reason(source, s, comment):
            yield s.first + 1, f"constant {name_of(s)} has no comment that gives its unit and reason"


def fields_without_unit(source):
    for s, comment in with_block_comments(source, fields(source)):
        beside = " | ".join([source.beside(s), source.above(s.first), comment])
        if UNIT_OF_FIELD.search(beside) or any(UNIT_OF_TYPE.search(scope.docstring) for scope in s.scopes):
            continue
        for name in field_names(s):
            if not UNIT_IN_NAME.search(name):
                yield s.first + 1, f"field {name} does not say its unit"


def finds_expected_faults():
    """Proves on a small source that the check reads sources correctly."""
    source = Source("""namespace a {
constexpr double bare = 1;
constexpr double fine = 2;  // mm: twice the first
// Cell edges: both are as wide as a wall.
constexpr double one = 1;
constexpr double two = 2;

constexpr double three = 3;
constexpr int table[] = {1,
                         2};  // columns of either panel
constexpr const char* text = "a 1";
constexpr double area(double a) { return a * 2; }
class Hidden {
  double unseen = 0;
  static constexpr int few = 3;
};
struct Box {
  Box() : law{nullptr}, depths{} {}
  double mass = 0, width_mm = 1;
  double height = 0;  ///< upwards,
                      ///< mm
  std::vector<double> depths;
  std::function<double(double)> law;
  double volume() const { return height; }
};
/// All in cell edges.
struct Other {
  double x, y;
};
}
""")
    return ([line for line, _ in constants_without_reason(source)] == [2, 8, 15] and
            [what.split()[1] for _, what in fields_without_unit(source)] == ["mass", "depths"])


def main():
    root, complaints, seen_constants, seen_fields = pathlib.Path(sys.argv[1]), [], 0, 0
    for room in ROOMS:
        for path in sorted((root / room).rglob("*.[ch]pp")):
            source = Source(path.read_text(encoding="utf-8"))
            found = list(constants_without_reason(source))
            seen_constants += len(constants(source))
            if room in ROOMS_OF_FIELDS and path.suffix == ".hpp":
                found += fields_without_unit(source)
                seen_fields += len(fields(source))
            complaints += [f"{path.relative_to(root)}:{line}: {what}" for line, what in sorted(found)]
    if not finds_expected_faults():
        complaints.append("this check reads its own example wrongly")
    if seen_constants < LEAST_CONSTANTS or seen_fields < LEAST_FIELDS:
        complaints.append(f"only {seen_constants} constants and {seen_fields} fields: is the path right?")
    print("\n".join(complaints) or f"{seen_constants} constants have a reason, {seen_fields} fields a unit")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
