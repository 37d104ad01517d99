#!/usr/bin/python3
"""Checks that sources compiled as one unit do not call each other's local functions.

usage: check_joined.py BUILD_FOLDER SOURCE_FOLDER

No two local functions with one name may differ only in number types. The joined files are read from the build's
unity files. The compiler itself reports types, variables and functions that are defined twice with the same text.
It does not report f(double) in one file and f(int) in another: f(1) then calls the second one from both files.
"""
import re
import sys
from collections import defaultdict
from itertools import combinations
from pathlib import Path

# A smaller number of joined files means that the pattern of unity files is wrong.
LEAST_UNITS = 20
# A function at the start of a line, in clang-format's layout: type, name, opening parenthesis.
FUNCTION = re.compile(r"^(?!return\b|using\b|namespace\b|class\b|struct\b|enum\b|template\b|else\b|typedef\b|TEST|INSTANTIATE)"
                      r"[A-Za-z_\[][\w:<>,&*\s\[\]]*?[\s&*](\w+)\(", re.M)
NUMBERS = {"int", "double", "bool", "float", "long", "unsigned", "char", "size_t", "auto", "Index"}


def local_text(text):
    """Returns the text inside unnamed namespaces."""
    return "\n".join(re.findall(r"^namespace \{$(.*?)^\}  // namespace$", text, re.M | re.S))


def inside_parentheses(text, start):
    depth = 1
    for end in range(start, len(text)):
        depth += {"(": 1, ")": -1}.get(text[end], 0)
        if depth == 0:
            return text[start:end]
    return ""


def split_at_commas(text):
    parts, depth = [""], 0
    for c in text:
        depth += {"(": 1, "<": 1, "{": 1, "[": 1, ")": -1, ">": -1, "}": -1, "]": -1}.get(c, 0)
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return [part.strip() for part in parts if part.strip()]


def type_of(parameter):
    """Returns the type without name, default value, const, reference and namespaces."""
    declared = parameter.split("=")[0].strip()
    words = re.sub(r"\b(const|std|model|targets|optim|sim|app|testing|Eigen)\b(::)?|&", " ", declared)
    words = re.sub(r"\s+", " ", words).strip()
    return re.sub(r"(?<=[\w>*]) \w+$", "", words)


def local_functions(text):
    """Returns (name, types, number of required arguments) of each function in an unnamed namespace."""
    own = local_text(text)
    for match in FUNCTION.finditer(own):
        parameters = split_at_commas(inside_parentheses(own, match.end()))
        yield match[1], tuple(map(type_of, parameters)), sum("=" in p for p in parameters)


def may_be_confused(a, b):
    """Checks whether one call may fit both functions: equal numbers of arguments, and no two types that differ
    except number types."""
    (types_a, optional_a), (types_b, optional_b) = a, b
    count = min(len(types_a), len(types_b))
    if count == 0 or count < len(types_a) - optional_a or count < len(types_b) - optional_b or types_a == types_b:
        return False
    return all(s == t or s in NUMBERS or t in NUMBERS for s, t in zip(types_a, types_b))


def complaints_about(build, source):
    units = sorted(Path(build).glob("**/Unity/*.cxx"))
    if len(units) < LEAST_UNITS:
        yield f"only {len(units)} joined files in {build}: is the path right?"
    seen = set()
    for unit in units:
        where = defaultdict(list)
        for name in re.findall(r'#include "([^"]+\.cpp)"', unit.read_text(encoding="utf-8")):
            path = Path(name)
            place = path.relative_to(source) if path.is_relative_to(source) else path
            for function, types, optional in local_functions(path.read_text(encoding="utf-8")):
                where[function].append((str(place), (types, optional)))
        for function, places in sorted(where.items()):
            for (p, a), (q, b) in combinations(places, 2):
                if p != q and may_be_confused(a, b) and (function, p, q) not in seen:
                    seen.add((function, p, q))
                    yield f"{function}({', '.join(a[0])}) of {p} and {function}({', '.join(b[0])}) of {q} are compiled as one"


def finds_ambiguous_names():
    """Proves that functions are found, and that types other than numbers distinguish them."""
    text = ("void outer(int a) {}\nnamespace {\n\nconst std::vector<int>& first(double x, const model::Lattice& s = {}) {\n"
            "  second(x);\n}\nconstexpr double third = 3;\n}  // namespace\nint fifth() {}\n")
    return (list(local_functions(text)) == [("first", ("double", "Lattice"), 1)]
            and may_be_confused((("double", "Lattice"), 0), (("int", "Lattice"), 0))
            and may_be_confused((("double",), 0), (("string", "Lattice"), 1))
            and not may_be_confused((("double", "Lattice"), 0), (("int", "Net"), 0)))


def main():
    complaints = list(complaints_about(sys.argv[1], Path(sys.argv[2]).resolve()))
    if not finds_ambiguous_names():
        complaints.append("this check does not see what it should")
    print("\n".join(complaints) or "no function of one file may be taken for that of another one")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
