#!/usr/bin/python3
"""run_pages.py PROGRAM SOURCE SCRATCH [--write] [PAGE|FOLDER...]: runs every command that a page shows.

Each page is followed from top to bottom in a separate folder, which has the program and the shipped targets at the
places that the pages name.
- A block ```sh is pasted into a shell. A line that ends in `# exit code N` must end so. Lines that begin with make or git
  are left out.
- A block ```console has commands after `$ ` and below each what it prints. The test compares both, times and rounding
  noise aside. With --write the pages get what the program prints now.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

program, source, scratch = (Path(word).resolve() for word in sys.argv[1:4])
is_writing = "--write" in sys.argv[4:]
wanted = [word for word in sys.argv[4:] if word != "--write"]
FENCE = re.compile(r"^```(sh|console)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LEFT_OUT = re.compile(r"^(make|git|export|cmake|\.|apt|sudo|mpirun|sbatch|/usr/bin/python3 -c)\b")
# Pages whose blocks are for other machines (Slurm, MPI), are the gallery, which `make gallery` runs, or take minutes.
# A page that is named on the command line is run all the same.
SKIPPED = {"docs/gallery.md", "docs/how-to/cluster.md", "docs/tutorials/helmet.md"}
LIMIT_S = 900  # of one block


def steady(text):
    """Returns a text without what differs from run to run: times, rounding noise, and spaces at the end of lines."""
    text = re.sub(r"\b\d+(\.\d+)?(e[-+]\d+)? ?(ms|s|us|min)\b", "TIME", text)
    text = re.sub(r"\b\d(\.\d+)?e-\d+\b", "NOISE", text)
    text = re.sub(r"\b[\d.]+(e[-+]\d+)? per second", "RATE", text)
    return "\n".join(line.rstrip() for line in text.strip().splitlines())


def make_folder(page):
    folder = scratch / page.replace("/", "_")
    (folder / "build/release/bin").mkdir(parents=True)
    (folder / "build/release/bin/kinetix-opt").symlink_to(program)
    for name in ("targets", "docs", "examples"):
        (folder / name).symlink_to(source / name)
    return folder


def run(command, folder):
    """Runs a command in a shell. Returns its exit code, and standard output and error in one text."""
    done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, text=True, timeout=LIMIT_S,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return done.returncode, done.stdout


def shell_lines(block):
    """Splits a block into commands. A here-document belongs to its command."""
    commands, end = [], None
    for line in block.splitlines():
        if end:
            commands[-1] += "\n" + line
            end = None if line == end else end
        elif line.strip() and not line.startswith("#"):
            commands.append(line)
            match = re.search(r"<<-?'?(\w+)'?", line)
            end = match[1] if match else None
    return commands


class Page:
    def __init__(self, name):
        self.name, self.text, self.faults, self.count = name, (source / name).read_text(encoding="utf-8"), [], 0

    def check(self, command, folder):
        self.count += 1
        expected = re.search(r"# .*exit code (\d+)", command)
        code, text = run(command, folder)
        if code != (int(expected[1]) if expected else 0):
            self.faults.append(f"{self.name}: exit code {code} of {command}\n{text}")
        return text

    def run_block(self, kind, block, folder):
        """Runs a block. Returns it with the present output."""
        if kind == "sh":
            for command in shell_lines(block):
                if not LEFT_OUT.match(command):
                    self.check(command, folder)
            return block
        shown = ""
        for part in re.split(r"^(?=\$ )", block, flags=re.MULTILINE):
            if not part.startswith("$ "):
                continue
            command, _, before = part[2:].partition("\n")
            quiet = command + (" --quiet" if "kinetix-opt" in command and "paper.py" not in command else "")
            text = self.check(quiet, folder).strip()
            if not is_writing and steady(before) != steady(text):
                self.faults.append(f"{self.name}: `{command}` prints\n{text}\nand the page shows\n{before}")
            keeps = steady(before) == steady(text)  # no new times where nothing else is new
            shown += f"$ {command}\n" + (before.rstrip("\n") if keeps else text) + "\n"
        return shown

    def run(self):
        if not any(kind in ("sh", "console") for kind, _ in FENCE.findall(self.text)):
            return
        folder = make_folder(self.name)
        text = FENCE.sub(lambda m: f"```{m[1]}\n{self.run_block(m[1], m[2], folder)}```", self.text)
        if is_writing and text != self.text:
            (source / self.name).write_text(text, encoding="utf-8")


def is_wanted(name):
    if name in wanted:
        return True
    return name not in SKIPPED and (not wanted or any(name.startswith(folder + "/") for folder in wanted))


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    names = ["README.md", *sorted(path.relative_to(source).as_posix() for path in source.glob("docs/**/*.md"))]
    pages = [Page(name) for name in names if is_wanted(name)]
    for page in pages:
        page.run()
    faults, count = [fault for page in pages for fault in page.faults], sum(page.count for page in pages)
    if count == 0:
        faults.append("no command found: are the patterns right?")
    print("\n\n".join(faults) or f"{count} commands of {len(pages)} pages run as shown")
    shutil.rmtree(scratch, ignore_errors=True)
    return 1 if faults else 0


sys.exit(main())
