#!/usr/bin/python3
"""faults.py KINETIX_OPT SCRATCH KIND [--long]: runs the program under faults and reports broken rules.

KIND: disk, memory, signals, clock, read_only, locale or threads, or all. Rules for every end: an exit code of
formats.md, one clear line on failure, and an output folder that is as before or complete. No temporary file
remains, the program does not crash, and no run takes more than 20 s. --long tries many more moments and sizes.
The exit code is 77 if this machine lacks what the kind needs.
"""
import os
import pathlib
import shutil
import subprocess
import sys

import kinds
from commands import Judge, Kitchen

LACKING = 77  # exit code by which ctest knows a test that could not run


def in_private_mounts():
    """Runs this script again in a separate mount namespace: its mounts end with it and are invisible to others."""
    if os.environ.get("KINETIX_OWN_MOUNTS"):
        return
    own = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--mount", "--map-root-user"]
    if subprocess.run([*own, "mount", "-t", "tmpfs", "tmpfs", "/mnt"], capture_output=True).returncode:
        own = []
    os.environ["KINETIX_OWN_MOUNTS"] = "yes" if own else "no"
    os.execvp((own or [sys.executable])[0], [*own, *([sys.executable] if own else []), *sys.argv])


def main():
    long = "--long" in sys.argv
    program, scratch, kind = [word for word in sys.argv[1:] if word != "--long"]
    in_private_mounts()
    chosen = kinds.ALL if kind == "all" else {kind: kinds.ALL[kind]}
    faults = []
    for name, check in chosen.items():
        judge = Judge(Kitchen(pathlib.Path(program).resolve(), pathlib.Path(scratch).resolve() / name, long))
        lacking = check(judge, long)
        if lacking:
            print(f"{name}: not run: {lacking}")
            if kind != "all":
                sys.exit(LACKING)
            continue
        print(f"{name}: {judge.runs} runs, {len(judge.faults)} faults")
        if not judge.faults:
            shutil.rmtree(judge.kitchen.scratch)
        faults += judge.faults
    print("\n".join(faults))
    sys.exit(1 if faults else 0)


main()
