#!/usr/bin/python3
"""mutate.py BUILD SCRATCH [--each COUNT] [--seed SEED] [--only NUMBER...]: do the tests detect errors in the model?

Builds COUNT wrong signs and wrong indices (25 by default) into each of four parts of the sources. KINETIX_MUTANT
chooses one of them at run time. For each error, runs the tests that pass the place, the quickest first, until one
fails. Writes SCRATCH/table.txt. The exit code is 1 if no test detects an error. BUILD is a folder with built
tests.

The order of the places depends on their lines alone, so it is stable. Places that do not compile are replaced by
the next ones, as are those of equivalent.txt, whose error changes nothing.
"""
import argparse
import dataclasses
import hashlib
import itertools
import os
import pathlib
import re
import subprocess
import sys
import time

from places import Place, places, with_errors
from programs import Programs

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PROGRAMS = ("test_model", "test_optim", "test_sim")
SPARE = 1.6  # places tried per requested place: some do not compile, some change nothing
# Seconds of tests per process. The first batches have a few quick tests, which detect most errors.
BATCHES = (1, 4, 20, 1e9)
# A run hangs if it takes SLOWER times the time without an error plus BESIDES seconds. This counts as detected.
SLOWER, BESIDES = 4, 20

KINEMATICS = ("model/lattice", "model/closure", "model/linkage")
ELASTIC = ("model/elastic", "model/hinge", "model/opening")


@dataclasses.dataclass
class Test:
    program: pathlib.Path
    name: str
    seconds: float
    reached: set  # numbers of places


def part_of(path, source):
    """Returns the part of the sources, of the four that are tried, or None. The adjoint part has all sources that
    mention adjoints or Jacobians."""
    if path.startswith("sim/"):
        return "physics"
    if path.startswith(KINEMATICS) and not path.endswith("jacobian.cpp"):
        return "kinematics"
    if path.startswith(("model/", "optim/")) and re.search("adjoint|jacobian", source, re.I) and "model/base" not in path:
        return "adjoint"
    return "elastic" if path.startswith(ELASTIC) else None


def equivalent():
    """Returns the keys of places whose error changes nothing."""
    lines = (HERE / "equivalent.txt").read_text().splitlines()
    return {line for line in lines if line and not line.startswith((" ", "#"))}


def ranked(candidates, seed):
    """Sorts the places in the seed's order, with signs and indices alternating."""
    def rank(place):
        return hashlib.sha256((seed + place.key).encode()).hexdigest()
    kinds = [sorted((place for place in candidates if place.kind == kind), key=rank) for kind in ("sign", "index")]
    return [place for pair in itertools.zip_longest(*kinds) for place in pair if place]


def candidates(count, seed):
    """Returns the first places of each part, some more than requested. @return part -> places"""
    out = {"kinematics": [], "elastic": [], "adjoint": [], "physics": []}
    for file in sorted([*(ROOT / "model").rglob("*.cpp"), *(ROOT / "optim").rglob("*.cpp"), *(ROOT / "sim").rglob("*.cpp")]):
        path, source = str(file.relative_to(ROOT)), file.read_text()
        part = part_of(path, source)
        if part:
            out[part] += places(path, source)
    for key in equivalent() - {place.key for found in out.values() for place in found}:
        print("equivalent.txt has a place that is no more:", key)
    return {part: ranked(found, seed)[:int(SPARE * count)] for part, found in out.items()}


def instrument(programs, numbered):
    """Writes copies of the sources with the errors. @return the paths with errors built in"""
    paths = {place.path for _, place in numbered}
    for path in paths:
        source = (ROOT / path).read_text()
        programs.write(programs.instrumented(path), with_errors(source, [(n, p) for n, p in numbered if p.path == path]))
    return paths


def refused(programs, text, place):
    return re.search(re.escape(f"{programs.instrumented(place.path)}:{place.line}:"), text)


def build(programs, numbered):
    """Builds all places that compile. @return (numbered places that compile, objects)"""
    while True:
        objects, refusals = programs.compile_all(instrument(programs, numbered))
        if not refusals:
            return numbered, objects
        left = [(n, place) for n, place in numbered if not refused(programs, refusals, place)]
        print(f"{len(numbered) - len(left)} places do not compile", flush=True)
        if len(left) == len(numbered):
            raise RuntimeError(refusals)
        numbered = left


def record(program):
    """Runs all tests without an error. @return the tests that pass"""
    table = program.with_suffix(".reached")
    if not table.exists() or table.stat().st_mtime < program.stat().st_mtime:
        table.unlink(missing_ok=True)
        subprocess.run([program], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=program.parent,
                       env={**os.environ, "KINETIX_REACHED": str(table)})
    tests = []
    for line in table.read_text().splitlines():
        result, seconds, name, *reached = line.split()
        if result == "passed":
            tests.append(Test(program, name, float(seconds), set(map(int, reached))))
        else:
            print("fails without an error:", name)
    return tests


def batches(tests):
    """Yields batches of tests of one program each, the quickest tests first."""
    rest = sorted(tests, key=lambda test: test.seconds)
    for limit in BATCHES:
        total, taken = 0, 0
        while taken < len(rest) and (taken == 0 or total + rest[taken].seconds < limit):
            total += rest[taken].seconds
            taken += 1
        for program in sorted({test.program for test in rest[:taken]}):
            yield [test for test in rest[:taken] if test.program == program]
        rest = rest[taken:]


def first_failure(number, tests):
    """Runs tests with this error. @return the first test that fails, or None"""
    limit = BESIDES + SLOWER * sum(test.seconds for test in tests)
    command = [tests[0].program, "--gtest_fail_fast", "--gtest_filter=" + ":".join(test.name for test in tests)]
    try:
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=limit, cwd=tests[0].program.parent,
                             env={**os.environ, "KINETIX_MUTANT": str(number)})
        output, how = run.stdout, f"ends with signal {-run.returncode}" if run.returncode < 0 else ""
        if run.returncode == 0:
            return None
    except subprocess.TimeoutExpired as hanging:
        output, how = hanging.stdout or b"", "hangs"
    output = output.decode(errors="replace")
    failed = re.findall(r"\[  FAILED  \] ([^\s,]+)", output) or re.findall(r"\[ RUN      \] (\S+)", output)
    name = failed[0] if "[  FAILED  ]" in output else (failed[-1] if failed else "?")
    return f"{name} {how}".strip()


def trial(number, tests):
    """Tries an error. @return (the test that detects it or None, number of tests that pass its place)"""
    able = [test for test in tests if number in test.reached]
    for batch in batches(able):
        seen_by = first_failure(number, batch)
        if seen_by:
            return seen_by, len(able)
    return None, len(able)


def chosen(numbered, by_part, count):
    """Yields the first places of each part that change something. @return (number, part, place)"""
    passed_over = equivalent()
    for part, found in by_part.items():
        of_part = [(number, part, place) for number, place in numbered if place in found and place.key not in passed_over]
        if len(of_part) < count:
            print(f"only {len(of_part)} places in {part}")
        yield from of_part[:count]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("scratch", type=pathlib.Path)
    parser.add_argument("--each", type=int, default=25)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--only", type=int, nargs="*", default=[])
    asked = parser.parse_args()
    start = time.time()
    programs = Programs(ROOT, asked.build.resolve(), asked.scratch.resolve())
    by_part = candidates(asked.each, asked.seed)
    numbered, objects = build(programs, list(enumerate(place for part in by_part.values() for place in part)))
    print(f"built in {time.time() - start:.0f} s", flush=True)
    tests = [test for name in PROGRAMS for test in record(programs.link(name, objects))]
    print(f"{len(tests)} tests, {sum(test.seconds for test in tests):.0f} s without an error", flush=True)
    unseen = 0
    with open(asked.scratch / "table.txt", "w") as table:
        for number, part, place in chosen(numbered, by_part, asked.each):
            if asked.only and number not in asked.only:
                continue
            begin = time.time()
            seen_by, able = trial(number, tests)
            unseen += not seen_by
            line = f"{number:4} {part:10} {place.key.replace(':', f':{place.line}:', 1)}  {seen_by or 'SEEN BY NO TEST'}" \
                   f"  ({able} tests pass here, {time.time() - begin:.1f} s)"
            print(line, flush=True)
            print(line, file=table, flush=True)
    print(f"{unseen} seen by no test, {time.time() - start:.0f} s")
    sys.exit(1 if unseen else 0)


main()
