#!/usr/bin/env python3
"""soak.py PROGRAM FILES [--kinds A,B] [--seed N] [--first K] [--jobs N] [--keep FOLDER]: damaged files of every
input kind.

FILES damaged files of each kind are made from small originals, most of which the program itself exports. The
damage flips bits, cuts off ends, replaces blocks by noise, and changes words and lines. The program reads each
file as a user would. Rules:
  - The exit code is 0, 2, 3 or 4 within LONGEST_S. There is no signal and no sanitizer message on stderr.
  - With code 2: one line of text on stderr, nothing on stdout, no file written.
  - Otherwise: JSON on stdout with finite numbers only.
  - For stores (tables of sweeps) with code 0: samples.csv is that of the undamaged table.

The same seed and K give the same file. Files that break a rule are kept, and the exit code is 1 if any file did.
"""
import argparse
import collections
import concurrent.futures
import io
import json
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
import zipfile
import zlib

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LONGEST_S = 300  # by the clock, for a build with sanitizers on a busy machine
NUMBERS = [b"0", b"-1", b"1", b"2", b"65536", b"2147483648", b"-2147483649", b"18446744073709551616", b"1e300", b"-1e-300", b"1e999", b"nan", b"inf", b"0.5"]
SANITIZERS = re.compile(rb"Sanitizer|runtime error:|terminate called|Assertion")
# Rows in the order of SQLite's pages, which differs from the order of the samples.
PAGE = 4096

DESIGN = """kinetix: 1
structure: {cells: [2, 1], cell_mm: 10, wall_mm: {thickness: 1, height: 4}}
design: {theta_deg: 20}
hinge: {kind: block, material: tango, gap_mm: 1.2}
"""
CELL = "kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 10}\ndesign: {theta_deg: 67.5}\n"
SWEEP = """kinetix: 1
base: cell.yaml
model: exact
method: {kind: factorial}
factors:
  - {path: "design.columns[*].t", name: k, range: [0.02, 0.98], levels: 40}
responses: [cell_angle_deg, area_ratio]
"""
GRAPH = "kinetix: 1\nstructure: {{lattice: graph, {key}: {file}, {more}wall_mm: {{thickness: 0.2, height: 3}}}}\ndesign: {{theta_deg: 20}}\n"
DISPLAY = "kinetix: 1\ntarget: {{kind: display, {what}}}\nstructure: {{cells: [10, 10], cell_mm: 10, wall_mm: {{thickness: 0.8, height: 6}}}}\n"
SURFACE = "kinetix: 1\ntarget: {{kind: surface, mesh: {file}}}\nstructure: {{wall_mm: {{thickness: 0.8, height: 4}}}}\n"
FONT = "DejaVu Sans"
SVG = b"""<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="30mm" viewBox="0 0 30 30">
  <g transform="translate(0, 0) scale(1)" stroke="#000"><path d="M 0 0 L 10 0 L 20 0 L 30 0 M 0 10 H 10 H 20 h 10 m 0 10 l -10 0 h -10 h -10"/></g>
  <polyline points="0,0 0,10 0,20 0,30 10,30 20,30 30,30 30,20 30,10 30,0"/>
  <polyline points="10,0 10,10 10,20 10,30"/><line x1="20" y1="0" x2="20" y2="10"/>
  <path transform="matrix(1 0 0 1 20 10)" d="M0,0v10v10"/>
</svg>
"""


class Damage:
    """Random changes of bytes and words from one generator."""

    def __init__(self, chance):
        self.chance = chance

    def place(self, data, spots):
        """Returns a position, inside one of the spots (first, length) if there are any."""
        if not spots:
            return self.chance.randrange(max(len(data), 1))
        first, length = self.chance.choice(spots)
        return min(first + self.chance.randrange(max(length, 1)), len(data) - 1)

    def flip_bits(self, data, spots):
        out = bytearray(data)
        for _ in range(self.chance.choice([1, 1, 2, 8, 40])):
            out[self.place(out, spots)] ^= 1 << self.chance.randrange(8)
        return bytes(out)

    def cut(self, data, spots):
        at = self.place(data, spots)
        return data[:at] if self.chance.randrange(3) else data[:at] + data[at + self.chance.choice([1, 2, 16, 100]):]

    def add_noise(self, data, spots):
        at, length = self.place(data, spots), self.chance.choice([1, 4, 16, 100, 500])
        noise = self.chance.choice([bytes(length), b"\xff" * length, self.chance.randbytes(length)])
        return data[:at] + noise + data[at + self.chance.choice([length, length, 0]):]

    def change_number(self, data, _):
        numbers = list(re.finditer(rb"-?\d+(\.\d*)?([eE][-+]?\d+)?", data))
        if not numbers:
            return data
        old = self.chance.choice(numbers)
        new = self.chance.choice(NUMBERS + [self.chance.choice(numbers).group()])
        return data[:old.start()] + new + data[old.end():]

    def change_word(self, data, _):
        words = list(re.finditer(rb"[A-Za-z_#]{2,}\d*", data))
        if not words:
            return data
        old = self.chance.choice(words)
        new = self.chance.choice([b"", b"X" + old.group()[1:], self.chance.choice(words).group(), old.group() * 2])
        return data[:old.start()] + new + data[old.end():]

    def change_lines(self, data, _):
        lines = data.splitlines(keepends=True) or [b""]
        at = self.chance.randrange(len(lines))
        how = self.chance.randrange(3)
        if how == 0:
            del lines[at:at + self.chance.choice([1, 2, 10])]
        elif how == 1:
            lines.insert(at, self.chance.choice(lines))
        else:
            other = self.chance.randrange(len(lines))
            lines[at], lines[other] = lines[other], lines[at]
        return b"".join(lines)

    def damaged(self, data, is_text, spots=()):
        ways = [self.flip_bits, self.flip_bits, self.cut, self.add_noise]
        if is_text:
            ways += [self.change_number, self.change_number, self.change_word, self.change_word, self.change_lines]
        for _ in range(self.chance.choice([1, 1, 1, 2, 4])):
            data = self.chance.choice(ways)(data, spots)
        return data


def damaged_zip(data, damage):
    """Damages a file of the package and corrects its checksums. Otherwise no XML reader would see the damage."""
    out = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(data)) as old, zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as new:
        hit = damage.chance.choice(old.namelist())
        if damage.chance.randrange(3):
            hit = next(name for name in old.namelist() if name.endswith(".model"))
        for name in old.namelist():
            text = old.read(name)
            new.writestr(name, damage.damaged(text, True) if name == hit else text)
    return out.getvalue()


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def damaged_png(data, damage):
    """Damages a chunk or its unpacked content, with correct checksums."""
    out, at = data[:8], 8
    chunks = []
    while at < len(data):
        length = struct.unpack(">I", data[at:at + 4])[0]
        chunks.append((data[at + 4:at + 8], data[at + 8:at + 8 + length]))
        at += length + 12
    hit = damage.chance.randrange(len(chunks))
    for k, (kind, content) in enumerate(chunks):
        if k == hit and kind == b"IDAT" and damage.chance.randrange(2):
            content = zlib.compress(damage.damaged(zlib.decompress(content), False))
        elif k == hit:
            content = damage.damaged(content or b"\0", False)
        out += chunk(kind, content)
    return out


def tables_of_font(data):
    """Returns the places of the font's tables, at most 4 KiB of each, and the place of the table of tables."""
    count = struct.unpack(">H", data[4:6])[0]
    spots = [(0, 12 + 16 * count)]
    for k in range(count):
        first, length = struct.unpack(">II", data[12 + 16 * k + 8:12 + 16 * k + 16])
        spots.append((first, min(length, 4096)))
    return spots


def cells_of_table(data):
    """Returns spots for damage: the whole database, and the head of each page, where SQLite finds the rows."""
    return [(0, len(data)), *((first, 200) for first in range(0, len(data), PAGE))]


class Kind:
    """A kind of file, its damage and its reader. `words` are the arguments of the command. It runs in a folder with
    `files` and the damaged file `name`."""

    def __init__(self, name, originals, words, files=(), is_text=False, inner=None, spots=None, same=None, environment=None):
        self.name, self.originals, self.words = name, originals, words
        self.files, self.is_text, self.inner, self.spots, self.same = dict(files), is_text, inner, spots, same
        self.environment = environment or {}

    def damaged(self, chance):
        data = chance.choice(self.originals)
        damage = Damage(chance)
        if self.inner and chance.randrange(3):
            return self.inner(data, damage)
        return damage.damaged(data, self.is_text, self.spots(data) if self.spots else ())


class Program:
    def __init__(self, path):
        self.path = str(pathlib.Path(path).resolve())
        modules = pathlib.Path(self.path).parents[1] / "lib/kinetix/modules"
        # A sanitizer opens modules by its own run path, not by the program's.
        self.environment = {**os.environ, "LD_LIBRARY_PATH": str(modules), "ASAN_OPTIONS": "detect_leaks=0",
                            "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1"}

    def run(self, words, folder, more=None):
        return subprocess.run([self.path, *words, "--quiet", "--threads", "1"], cwd=folder, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=LONGEST_S, env={**self.environment, **(more or {})}, check=False)

    def must(self, words, folder):
        done = self.run(words, folder)
        if done.returncode:
            sys.exit(f"{' '.join(words)} ended with {done.returncode}: {done.stderr.decode(errors='replace')}")


def font_file():
    """Returns an outline font of this machine and the settings that install it alone, from a copy in the run's
    folder."""
    path = subprocess.run(["fc-match", "-f", "%{file}", FONT], capture_output=True, text=True, check=True).stdout
    settings = "<?xml version='1.0'?><fontconfig><dir prefix='cwd'>fonts</dir><cachedir prefix='cwd'>cache</cachedir></fontconfig>"
    return pathlib.Path(path).read_bytes(), settings.encode()


def make_kinds(program, folder):
    """Makes the originals with the program itself, except for kinds that it only reads."""
    (folder / "two_cells.yaml").write_text(DESIGN)
    (folder / "cell.yaml").write_text(CELL)
    (folder / "s.yaml").write_text(SWEEP)
    program.must(["export", "two_cells.yaml", "--format", "step,3mf,glb,stl,dxf,svg", "-o", "printed"], folder)
    program.must(["import", "printed/two_cells.3mf", "-o", "imported"], folder)
    program.must(["sweep", "s.yaml", "-o", "swept"], folder)
    program.must(["sweep", "s.yaml", "--share", "1/2", "-o", "shared"], folder)
    rows = (folder / "swept/samples.csv").read_bytes()
    sweep_files = {"cell.yaml": CELL.encode(), "s.yaml": SWEEP.encode()}
    parts = {f"parts/{file.name}": file.read_bytes() for file in (folder / "imported/parts").iterdir()}
    printed = {file.suffix: file.read_bytes() for file in (folder / "printed").glob("two_cells.*")}
    font, font_settings = font_file()
    shapes = SOURCE / "targets/shapes"
    png = (shapes / "qr_code.png").read_bytes()
    pgm = b"P5 20 20 255\n" + bytes((x * y) % 256 for x in range(20) for y in range(20))
    pbm = b"P1\n# a comment\n8 8\n" + b"0 1 1 0 1 0 0 1\n" * 8
    ply = b"ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n" + b"".join(
        b"%d %d %d\n" % (40 * x, 40 * y, 10 * x * y) for x in range(3) for y in range(3)) + b"".join(
        b"3 %d %d %d\n3 %d %d %d\n" % (k, k + 3, k + 1, k + 1, k + 3, k + 4) for k in (0, 1, 3, 4))
    obj = b"".join(b"v %d %d %d\n" % (40 * x, 40 * y, 10 * x * y) for x in range(3) for y in range(3)) + b"".join(
        b"f %d %d %d\nf %d %d %d\n" % (k, k + 3, k + 1, k + 1, k + 3, k + 4) for k in (1, 2, 4, 5))
    csv = (shapes / "half_circle.csv").read_bytes()
    curve = re.sub(rb"points: \S+", b"points: damaged.csv", (shapes / "half_circle.yaml").read_bytes())

    def model(suffix, **more):
        return Kind("damaged" + suffix, [printed[suffix]], ["import", "damaged" + suffix, "--json", "-o", "out"], **more)

    def checked(name, originals, text, **more):
        return Kind(name, originals, ["check", "d.yaml", "--json"], files={"d.yaml": text if isinstance(text, bytes) else text.encode(), **more.pop("files", {})}, **more)

    return {
        "step": model(".step", is_text=True),
        "3mf": model(".3mf", inner=damaged_zip),
        "glb": model(".glb", is_text=True),
        "stl": Kind("damaged.stl", [(folder / "printed/soft.stl").read_bytes()],
                    ["import", "--hard", "hard.stl", "--soft", "damaged.stl", "--json", "-o", "out"],
                    files={"hard.stl": (folder / "printed/hard.stl").read_bytes()}),
        "fold": checked("damaged.fold", [(shapes / "miura.fold").read_bytes()], GRAPH.format(key="origami", file="damaged.fold", more="tilt_deg: 50, cell_mm: 10, "), is_text=True),
        "cp": checked("damaged.cp", [(shapes.parents[1] / "tests/fuzz/corpus/creases/miura.cp").read_bytes()], GRAPH.format(key="origami", file="damaged.cp", more="tilt_deg: 50, cell_mm: 10, "), is_text=True),
        "dxf": checked("damaged.dxf", [(shapes / "rosette.dxf").read_bytes(), printed[".dxf"]], GRAPH.format(key="drawing", file="damaged.dxf", more=""), is_text=True),
        "svg": checked("damaged.svg", [SVG, printed[".svg"]], GRAPH.format(key="drawing", file="damaged.svg", more=""), is_text=True),
        "font": checked("fonts/damaged.ttf", [font], DISPLAY.format(what=f"glyph: {chr(0xc4)}, font: {FONT}"), spots=tables_of_font,
                        files={"fonts.conf": font_settings}, environment={"FONTCONFIG_FILE": "fonts.conf"}),
        "png": checked("damaged.png", [png], DISPLAY.format(what="image: damaged.png"), inner=damaged_png),
        "pnm": checked("damaged.pgm", [pgm, pbm], DISPLAY.format(what="image: damaged.pgm"), is_text=True),
        "ply": checked("damaged.ply", [ply], SURFACE.format(file="damaged.ply"), is_text=True),
        "obj": checked("damaged.obj", [obj], SURFACE.format(file="damaged.obj"), is_text=True),
        "csv": checked("damaged.csv", [csv], curve, is_text=True),
        "store": Kind("out/sweep.sqlite", [(folder / "swept/sweep.sqlite").read_bytes()], ["sweep", "s.yaml", "--resume", "--json", "-o", "out"],
                      files=sweep_files, spots=cells_of_table, same=("out/samples.csv", rows)),
        "share": Kind("out/share-1-of-2/sweep.sqlite", [(folder / "shared/share-1-of-2/sweep.sqlite").read_bytes()], ["sweep", "s.yaml", "--json", "-o", "out"],
                      files=sweep_files, spots=cells_of_table, same=("out/samples.csv", rows)),
        "design": Kind("design.yaml", [(folder / "imported/design.yaml").read_bytes()], ["simulate", "design.yaml", "--json", "-o", "out"], files=parts, is_text=True),
        "part": Kind("parts/body_1.stl", [parts["parts/body_1.stl"]], ["simulate", "design.yaml", "--json", "-o", "out"],
                     files={**parts, "design.yaml": (folder / "imported/design.yaml").read_bytes()}),
    }


def refuse_constant(name):
    raise ValueError("a number that is " + name)


def fault_of(done, kind, folder):
    """Describes the fault of a run; empty: none."""
    words = done.stderr.decode(errors="replace")
    if SANITIZERS.search(done.stderr):
        return words[-2000:]
    if done.returncode not in (0, 2, 3, 4):
        return f"exit code {done.returncode}: {words[-300:]}"
    if done.returncode == 2:
        if done.stderr.count(b"\n") != 1 or len(done.stderr) < 10:
            return f"not one line: {words[:300]}"
        beside = [path.name for path in folder.iterdir() if path.name == "out" and not kind.same]
        return "something is written, though the input is bad" if beside else ""
    try:
        json.loads(done.stdout, parse_constant=refuse_constant)
    except (ValueError, UnicodeDecodeError) as error:
        return f"no JSON of finite numbers on stdout: {error}"
    if kind.same and (folder / kind.same[0]).read_bytes() != kind.same[1]:
        return "numbers changed without a word"
    return ""


def read_file(program, kind, data, scratch):
    """Reads a file with the program. Returns (exit code or None, fault)."""
    with tempfile.TemporaryDirectory(dir=scratch) as name:
        folder = pathlib.Path(name)
        for path, content in {**kind.files, kind.name: data}.items():
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_bytes(content)
        try:
            done = program.run(kind.words, folder, kind.environment)
        except subprocess.TimeoutExpired:
            return None, f"over {LONGEST_S} s"
        return done.returncode, fault_of(done, kind, folder)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("files", type=int)
    parser.add_argument("--kinds", default="")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", type=pathlib.Path, default=pathlib.Path("failed_inputs"))
    asked = parser.parse_args()
    program, faults, lock = Program(asked.program), [], threading.Lock()
    with tempfile.TemporaryDirectory(prefix="kinetix-soak-") as name:
        scratch = pathlib.Path(name)
        kinds = make_kinds(program, scratch)
        for kind_name in asked.kinds.split(",") if asked.kinds else kinds:
            kind, began = kinds[kind_name], time.monotonic()
            for original in kind.originals[:1]:
                if (end := read_file(program, kind, original, scratch)) != (0, ""):
                    sys.exit(f"{kind_name}: the original, undamaged: {end}")

            def run(k, kind=kind, kind_name=kind_name):
                data = kind.damaged(random.Random(f"{asked.seed} {kind_name} {k}"))
                code, fault = read_file(program, kind, data, scratch)
                if fault:
                    with lock:
                        asked.keep.mkdir(parents=True, exist_ok=True)
                        kept = asked.keep / f"{kind_name}_{asked.seed}_{k}{pathlib.Path(kind.name).suffix}"
                        kept.write_bytes(data)
                        faults.append(kept)
                        print(f"{kept}: {' '.join(kind.words)}: {fault}", flush=True)
                return code

            with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
                codes = collections.Counter(pool.map(run, range(asked.first, asked.first + asked.files)))
            ends = ", ".join(f"{count} x {'too slow' if code is None else code}" for code, count in sorted(codes.items(), key=str))
            print(f"{kind_name:7} {asked.files} files in {time.monotonic() - began:.0f} s: exit codes {ends}", flush=True)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
