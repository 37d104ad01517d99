"""Runs of the program under faults, and the rules for each of them however it ends."""
import dataclasses
import json
import os
import shutil
import subprocess
import time

HANG_S = 20  # no run here takes 2 s undisturbed
RIB = """kinetix: 1
name: rib
target: {{kind: curve, points: [[0, 0], [12, 9], [30, 14], [48, 9], [60, 0]]}}
structure: {{cells: [{columns}, 1]}}
"""
SWEEP = """kinetix: 1
base: design.yaml
method: {{kind: lhs, samples: {samples}}}
factors:
  - {{path: design.theta_deg, range: [5, 40]}}
responses: [end_mm, turn_deg]
"""
PHYSICS_SWEEP = """kinetix: 1
base: design.yaml
model: bullet
method: {kind: sobol, samples: 4}
factors:
  - {path: design.theta_deg, range: [5, 20]}
responses: [verify_rms]
"""


@dataclasses.dataclass(frozen=True)
class Command:
    """A run that writes into one folder, OUT."""

    name: str
    words: tuple
    steady: tuple = ()  # names of files whose bytes do not hold times
    resumes: bool = False  # goes on where an earlier run ended, with --resume
    writes: bool = True

    def line(self, program, inputs, out):
        words = [word.replace("IN/", f"{inputs}/").replace("OUT", str(out)) for word in self.words]
        return [str(program), *words, "--quiet"]


COMMANDS = [
    Command("optimise", ("IN/rib.yaml", "-o", "OUT"), steady=("design.yaml",)),
    Command("simulate", ("simulate", "IN/design.yaml", "--model", "equilibrium", "--theta-deg", "2", "-o", "OUT"), steady=("design.yaml",)),
    Command("verify", ("verify", "IN/design.yaml", "-o", "OUT"), steady=("design.yaml",)),
    Command("export", ("export", "IN/design.yaml", "--format", "stl,3mf,svg,dxf,mjcf,glb,scad", "-o", "OUT"),
            steady=("all.stl", "rib.3mf", "rib.svg", "rib.dxf", "rib.xml", "rib.glb", "print.json")),
    Command("export_step", ("export", "IN/small.yaml", "--format", "step", "-o", "OUT"), steady=("small.step",)),
    Command("import", ("import", "IN/rib.3mf", "-o", "OUT"), steady=("design.yaml",)),
    Command("sweep", ("sweep", "IN/doe.yaml", "-o", "OUT"), steady=("samples.csv",), resumes=True),
    Command("sweep_physics", ("sweep", "IN/physics.yaml", "-o", "OUT"), steady=("samples.csv",), resumes=True),
    Command("check", ("check", "IN/rib.yaml"), writes=False),
]


@dataclasses.dataclass
class End:
    """The end of a run."""

    code: int
    out: str
    err: str
    hung: bool = False

    @property
    def last_words(self):
        return [line for line in self.err.splitlines() if line.strip()]


def clean_environment(home, temporary):
    """Returns this process's environment without variables that change the program's language, threads and folders."""
    drop = ("LC_", "LANG", "OMP_")
    env = {name: value for name, value in os.environ.items() if not name.startswith(drop)}
    return {**env, "HOME": str(home), "TMPDIR": str(temporary)}


def run(line, cwd, env, before=None, during=None, **streams):
    """Runs a command line to its end.

    @param before called in the child before it becomes the program
    @param during called with the process

    """
    process = subprocess.Popen(line, cwd=cwd, env=env, preexec_fn=before, stdin=subprocess.DEVNULL, text=True, errors="replace",
                               stdout=streams.get("stdout", subprocess.PIPE), stderr=streams.get("stderr", subprocess.PIPE))
    if during:
        during(process)
    try:
        out, err = process.communicate(timeout=HANG_S)
        return End(process.returncode, out or "", err or "")
    except subprocess.TimeoutExpired:
        process.kill()
        out, err = process.communicate()
        return End(process.returncode, out or "", err or "", hung=True)


def contents(folder):
    """Returns every file in a folder, including hidden ones; None if the folder does not exist."""
    if not folder.exists():
        return None
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


class Kitchen:
    """Inputs, and the undisturbed output and duration of each command. The inputs are larger for many moments."""

    def __init__(self, program, scratch, long):
        self.program, self.scratch, self.inputs = program, scratch, scratch / "inputs"
        shutil.rmtree(scratch, ignore_errors=True)
        self.inputs.mkdir(parents=True)
        self.references, self.durations = {}, {}
        self._prepare(long)

    def place(self, name):
        """Makes an empty folder for one run, with a home folder and a folder for temporary files."""
        place = self.scratch / name
        shutil.rmtree(place, ignore_errors=True)
        for folder in ("home", "tmp"):
            (place / folder).mkdir(parents=True)
        return place

    def start(self, command, place, env=None, words=(), **how):
        line = command.line(self.program, self.inputs, place / "out") + list(words)
        return run(line, place, {**clean_environment(place / "home", place / "tmp"), **(env or {})}, **how)

    def reference(self, command):
        """Returns the files that the command writes undisturbed."""
        if command.name not in self.references:
            place, begin = self.place(f"reference_{command.name}"), time.monotonic()
            end = self.start(command, place)
            self.durations[command.name] = time.monotonic() - begin
            if end.code or (command.writes and not contents(place / "out")):
                raise SystemExit(f"{command.name}, undisturbed, ends with {end.code}: {end.err}")
            self.references[command.name] = contents(place / "out")
        return self.references[command.name]

    def seconds(self, command):
        """Returns how long the command takes undisturbed."""
        self.reference(command)
        return self.durations[command.name]

    def set_earlier(self, command, place):
        """Writes results of an earlier run: the same names with other content, and a file of the user's."""
        out = place / "out"
        for name in self.reference(command):
            (out / name).parent.mkdir(parents=True, exist_ok=True)
            (out / name).write_text(f"earlier {name}\n")
        (out / "notes.txt").write_text("mine\n")

    def _prepare(self, long):
        (self.inputs / "rib.yaml").write_text(RIB.format(columns=8 if long else 4))
        (self.inputs / "doe.yaml").write_text(SWEEP.format(samples=3000 if long else 1000))
        (self.inputs / "physics.yaml").write_text(PHYSICS_SWEEP)
        (self.inputs / "small.yaml").write_text("kinetix: 1\nstructure: {cells: [1, 1], cell_mm: 20}\ndesign: {theta_deg: 20}\n")
        place = self.place("first")
        env = clean_environment(place / "home", place / "tmp")
        for words in (["rib.yaml", "-o", "found"], ["export", "found/design.yaml", "--format", "3mf", "--hinge", "block", "-o", "print"]):
            end = run([str(self.program), *words], self.inputs, env)
            if end.code:
                raise SystemExit(f"{words} ends with {end.code}: {end.err}")
        shutil.copy(self.inputs / "found/design.yaml", self.inputs / "design.yaml")
        shutil.copy(self.inputs / "print/rib.3mf", self.inputs / "rib.3mf")


class Judge:
    """Collects broken rules."""

    def __init__(self, kitchen):
        self.kitchen, self.faults, self.runs = kitchen, [], 0

    def fault(self, label, what, end):
        self.faults.append(f"{label}: {what} (code {end.code}; {' | '.join(end.last_words[:4])[:300]})")

    def end(self, label, end, codes):
        """Checks the end: no hang, no crash, a documented code, and one clear message on failure."""
        self.runs += 1
        if end.hung:
            self.fault(label, f"still ran after {HANG_S} s", end)
        elif end.code not in codes:
            self.fault(label, f"ended otherwise than by {sorted(codes)}", end)
        elif end.code in (1, 2) and len(end.last_words) != 1:
            self.fault(label, "says not one line", end)
        elif "terminate called" in end.err or "bad_alloc" in end.err:
            self.fault(label, "speaks of the program's inside", end)

    def folder(self, label, command, place, end, earlier=False, done=(0,)):
        """Checks that the folder is as before or complete, and that no temporary files remain."""
        reference, now = self.kitchen.reference(command), contents(place / "out")
        left = [str(path) for path in place.rglob("*") if "kinetix-" in path.name and path.name not in (".kinetix-files", ".kinetix-prints")]
        if left:
            self.fault(label, f"leaves {left}", end)
        if not command.writes or command.resumes:
            return
        if earlier:
            mine = now.pop("notes.txt", None)
            old = {name: f"earlier {name}\n".encode() for name in reference}
            if mine != b"mine\n":
                self.fault(label, "the user's file is gone", end)
        else:
            old = None
        if now == old:
            if end.code in done:
                self.fault(label, "says that it is done and has written nothing", end)
        elif now is None or set(now) != set(reference):
            self.fault(label, f"the folder is half written: {sorted(now or {})}", end)
        else:
            # A search that Ctrl-C stops keeps the best so far, which may meet the goal with another design.
            self.complete(label, command, now, end, exact=end.code == 0 and "saving the best result so far" not in end.err)

    def complete(self, label, command, now, end, exact=True):
        for name, content in now.items():
            if not content or content == f"earlier {name}\n".encode():
                self.fault(label, f"{name} is empty or an earlier run's", end)
            if name.endswith(".json"):
                json.loads(content)
        for name in command.steady if exact else ():
            if now[name] != self.kitchen.reference(command)[name]:
                self.fault(label, f"{name} is not what an undisturbed run writes", end)

    def resumes(self, label, command, place, end):
        """Checks that an interrupted sweep can resume to the same table, with enough space, memory and time."""
        last = self.kitchen.start(command, place, words=["--resume"])
        now = contents(place / "out") or {}
        if last.code:
            self.fault(label, f"cannot be resumed: {last.err.strip()}", end)
        elif set(now) != set(self.kitchen.reference(command)):
            self.fault(label, f"after its resumption there are {sorted(now)}", end)
        elif b"there is not enough memory" in now["samples.csv"]:
            return  # a sample without enough memory is a failed sample with a reason
        else:
            self.complete(label, command, now, end)

    def both(self, label, command, place, end, codes, **how):
        self.end(label, end, codes)
        self.folder(label, command, place, end, **how)
        if command.resumes:
            self.resumes(label, command, place, end)
