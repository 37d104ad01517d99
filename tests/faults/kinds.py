"""Faults, one function per kind. Each function returns what this machine lacks to cause the fault, or nothing."""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from commands import COMMANDS, clean_environment, contents, run

KIB = 1024
LARGEST_STEP = 2048  # MiB: no run here needs so much memory
BY_NAME = {command.name: command for command in COMMANDS}
WRITING = [command for command in COMMANDS if command.writes]


def may_mount():
    return os.environ.get("KINETIX_OWN_MOUNTS") == "yes"


def spread(least, most, count):
    """Returns evenly spaced integers from least to most."""
    return sorted({round(least + (most - least) * k / (count - 1)) for k in range(count)})


def in_turn(choices, command, long):
    """Returns all choices if long, otherwise one. Successive commands get successive choices."""
    return choices if long else [choices[COMMANDS.index(command) % len(choices)]]


class Mount:
    """A temporary file system of limited size in a folder."""

    def __init__(self, place, options):
        self.place = place
        subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(place)], check=True)

    def change(self, options):
        # With type and source given, mount adds none of the current options, which users other than root may not set
        # again.
        subprocess.run(["mount", "-i", "-t", "tmpfs", "-o", f"remount,{options}", "tmpfs", str(self.place)], check=True, capture_output=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", "-l", str(self.place)], check=True)


# A full disk

def run_on_small_disk(judge, command, options, earlier):
    """Runs a command on a file system that becomes full. Sweeps are resumed once there is space."""
    kitchen = judge.kitchen
    kitchen.reference(command)
    place = kitchen.place("disk")
    label = f"{command.name} on a disk of {options}{' over earlier results' if earlier else ''}"
    with Mount(place, "size=64m") as disk:
        for folder in ("home", "tmp"):
            (place / folder).mkdir()
        if earlier:
            kitchen.set_earlier(command, place)
        try:
            disk.change(options)
        except subprocess.CalledProcessError:
            return
        end = kitchen.start(command, place)
        disk.change("size=64m,nr_inodes=10000")
        judge.both(label, command, place, end, {0, 2}, earlier=earlier)


def run_with_small_files(judge, command, kib):
    """Runs a command under `ulimit -f`, as a quota or FAT limits the size of files."""
    place = judge.kitchen.place("small_files")
    end = judge.kitchen.start(command, place, before=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (kib * KIB, kib * KIB)))
    judge.both(f"{command.name} with files of at most {kib} KiB", command, place, end, {0, 2})


def run_with_full_streams(judge, command, long):
    """Runs a command with stdout on a full device, with stderr on a full device, and with stdout in a pipe without a
    reader."""
    for words, stream in in_turn(((["--json"], "stdout"), ([], "stdout"), ([], "stderr")), command, long):
        place = judge.kitchen.place("full_stream")
        with open("/dev/full", "w") as full:
            end = judge.kitchen.start(command, place, words=words, **{stream: full})
        label = f"{command.name} {' '.join(words)} with a full {stream}"
        judge.end(label, end, {1} if stream == "stdout" else {0})
        judge.folder(label, command, place, end)
    read_end, pipe = os.pipe()
    os.close(read_end)
    place = judge.kitchen.place("closed_pipe")
    end = judge.kitchen.start(command, place, stdout=pipe)
    os.close(pipe)
    judge.both(f"{command.name} into a closed pipe", command, place, end, {-signal.SIGPIPE})


def disk_sizes(whole, long):
    """Yields sizes in KiB, and whether the folder has earlier results. @param whole KiB that are enough"""
    if long:
        yield from ((kib, earlier) for kib in spread(4, whole, 24) for earlier in (False, True))
    else:
        yield from zip(spread(4, whole, 4)[:3], (True, False, True))


def disk(judge, long):
    for command in WRITING:
        whole = sum(len(content) for content in judge.kitchen.reference(command).values()) // KIB + 64
        for kib in spread(4, whole, 24) if long else in_turn((4, whole // 3), command, long):
            run_with_small_files(judge, command, kib)
        for kib, earlier in disk_sizes(whole, long) if may_mount() else ():
            if not (long and earlier and command.resumes):
                run_on_small_disk(judge, command, f"size={kib}k", earlier and not command.resumes)
        for inodes in in_turn(range(4, 17), command, long) if may_mount() else ():
            run_on_small_disk(judge, command, f"nr_inodes={inodes}", False)
        run_with_full_streams(judge, command, long)
    for folder in ("/dev/full", "/dev/full/out", "/proc/out"):
        place = judge.kitchen.place("no_folder")
        end = judge.kitchen.start(BY_NAME["optimise"], place, words=["-o", folder])
        judge.end(f"-o {folder}", end, {2})
    return None if may_mount() else "mounting a small disk is not allowed here; small files and full streams hold" * (not judge.faults)


# Too little memory

def run_in_memory(judge, command, mib):
    place = judge.kitchen.place("memory")
    return place, judge.kitchen.start(command, place, words=["--threads", "2"],
                                      before=lambda: resource.setrlimit(resource.RLIMIT_AS, (mib * KIB * KIB,) * 2))


def enclose_memory(least, suffices, step):
    """Returns MiB that are too little and MiB with which a run succeeds. The step doubles after each failure.

    @param least memory that is too small

    """
    while step < LARGEST_STEP and not suffices(least + step):
        least, step = least + step, 2 * step
    return least, least + step


def least_memory(least, suffices):
    """Finds the least memory with which a run succeeds, within 2 MiB. @param least memory that is too small"""
    least, most = enclose_memory(least, suffices, 2)
    while most - least > 2:
        middle = (least + most) // 2
        least, most = (least, middle) if suffices(middle) else (middle, most)
    return most


def memory_to_load(judge):
    """Finds the MiB in which the program reaches main. With less, the loader ends with 127 and names the library
    without memory. The C++ library may also end it with a signal if a global object gets no memory."""
    place = judge.kitchen.place("memory")

    def loads(mib):
        limit = (mib * KIB * KIB,) * 2
        return run([str(judge.kitchen.program), "--version"], place, clean_environment(place / "home", place / "tmp"),
                   before=lambda: resource.setrlimit(resource.RLIMIT_AS, limit)).code in (0, 1)
    return least_memory(16, loads)


def memory(judge, long):
    """Limits `ulimit -v` from just above the size of the loaded program to a sufficient size. Memory then runs out
    at different places."""
    loads = memory_to_load(judge)
    for command in COMMANDS:
        judge.kitchen.reference(command)

        def suffices(mib):
            return run_in_memory(judge, command, mib)[1].code == 0
        enough = least_memory(loads, suffices) if long else enclose_memory(loads, suffices, 8)[1]
        for mib in spread(loads - 2, enough + 2, 60 if long else 6):
            place, end = run_in_memory(judge, command, mib)
            judge.both(f"{command.name} in {mib} MiB", command, place, end, {0, 1, 127})


# Signals

def send_after(seconds, number):
    def send(process):
        time.sleep(seconds)
        process.send_signal(number)
    return send


def signals(judge, long):
    """Sends signals at moments spread over the run, each signal at others. The place that the program has reached
    depends on the machine."""
    numbers, count = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE), 20 if long else 2
    for command in COMMANDS:
        seconds = judge.kitchen.seconds(command)
        for order, number in enumerate(numbers):
            for k in range(count):
                place = judge.kitchen.place("signal")
                earlier = k % 2 == 1 and command.writes and not command.resumes
                if earlier:
                    judge.kitchen.set_earlier(command, place)
                after = seconds * (k + (order + 0.5) / len(numbers)) / count
                end = judge.kitchen.start(command, place, during=send_after(after, number))
                # 3 and 130: Ctrl-C stops a search, a path or a simulation.
                codes = {0, -number} | ({3, 130} if number == signal.SIGINT else set())
                judge.both(f"{command.name}, {signal.Signals(number).name} after {after:.3f} s", command, place, end, codes,
                           earlier=earlier, done=(0, 3))
    view(judge)
    return None


def end_view(judge, place, number):
    """Starts the studio in a place and ends it by a signal. @return how it ended"""
    received = []

    def when_it_listens(process):
        received.append(process.stdout.readline())
        process.send_signal(number)
    line = [str(judge.kitchen.program), "view", str(judge.kitchen.inputs / "design.yaml"), "--no-open"]
    end = run(line, place, clean_environment(place / "home", place / "tmp"), during=when_it_listens)
    judge.end(f"view, {signal.Signals(number).name}", end, {0, -number})
    if not received[0].startswith("http://127.0.0.1:"):
        judge.fault("view", f"says {heard}", end)
    return end


def view(judge):
    """Checks that the studio ends at each signal, and if its line has no reader. Its lock may remain after SIGKILL
    until the next studio ends."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL):
        place = judge.kitchen.place("view")
        end = end_view(judge, place, number)
        if number == signal.SIGKILL:
            end = end_view(judge, place, signal.SIGTERM)
        if contents(place):
            judge.fault("view", f"leaves {list(contents(place))}", end)


# A clock that jumps

def clock(judge, long):
    """Moves the time of day by years while the program runs. The monotonic clock does not jump, as if a user set the
    clock."""
    library = next(iter(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1")), None)
    if not library:
        return "faketime is missing"
    for command in COMMANDS:
        seconds = judge.kitchen.seconds(command)
        for days in (-20000, -1, 1, 4000) if long else in_turn((-1000, 1000), command, long):
            place = judge.kitchen.place("clock")
            stamp = place / "clock"
            stamp.write_text("+0\n")

            def jump(process):
                time.sleep(seconds / 2)
                (place / "next").write_text(f"{days:+}d\n")
                (place / "next").rename(stamp)
            env = {"LD_PRELOAD": str(library), "FAKETIME_TIMESTAMP_FILE": str(stamp), "FAKETIME_NO_CACHE": "1",
                   "FAKETIME_DONT_FAKE_MONOTONIC": "1", "DONT_FAKE_MONOTONIC": "1"}
            end = judge.kitchen.start(command, place, env=env, during=jump)
            judge.both(f"{command.name}, the clock jumps by {days} days", command, place, end, {0})
    return None


# Folders that cannot be written

def read_only(judge, long):
    if not may_mount():
        return "a read-only mount is not allowed here"
    for command in COMMANDS:
        judge.kitchen.reference(command)
        for env in in_turn(({"HOME": "/nowhere/at/all"}, {"HOME": ""}), command, long):
            place = judge.kitchen.place("home")
            end = judge.kitchen.start(command, place, env=env)
            judge.both(f"{command.name} with {env}", command, place, end, {0})
        run_in_read_only(judge, command, "home", {0})
        run_in_read_only(judge, command, "tmp", {0, 2})
        if command.writes:
            run_in_read_only(judge, command, "out", {2})
    return None


def run_in_read_only(judge, command, name, codes):
    place = judge.kitchen.place("read_only")
    (place / name).mkdir(exist_ok=True)
    label = f"{command.name} with {name} read only"
    with Mount(place / name, "size=64m") as folder:
        if name == "out" and not command.resumes:
            judge.kitchen.set_earlier(command, place)
        folder.change("ro")
        end = judge.kitchen.start(command, place)
        judge.end(label, end, codes)
        if name == "out" and command.resumes:
            if contents(place / "out"):
                judge.fault(label, "writes into a read-only folder", end)
        else:
            judge.folder(label, command, place, end, earlier=name == "out")


# Languages

def german(judge):
    """Returns a folder with a locale that uses decimal commas; none if this machine cannot make one."""
    folder = judge.kitchen.scratch / "locales"
    folder.mkdir(exist_ok=True)
    made = shutil.which("localedef") and subprocess.run(
        ["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / "de_DE.UTF-8")], capture_output=True).returncode in (0, 1)
    return folder if made and (folder / "de_DE.UTF-8/LC_NUMERIC").exists() else None


def locale(judge, long):
    commas = german(judge)
    with_commas = [{"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LOCPATH": str(commas)}] if commas else []
    others = [{"LC_ALL": "C"}, {"LANG": "xx_XX.UTF-8", "LC_ALL": "xx_XX.UTF-8"}, {"LC_ALL": ""}]
    for command in COMMANDS:
        judge.kitchen.reference(command)  # without these variables
        for env in with_commas + in_turn(others, command, long):
            place = judge.kitchen.place("language")
            end = judge.kitchen.start(command, place, env=env)
            judge.both(f"{command.name} with {env}", command, place, end, {0})
    return None if commas else "no locale with decimal commas can be made here (package locales); the others hold" * (not judge.faults)


# Threads

def threads(judge, long):
    for command in COMMANDS:
        judge.kitchen.reference(command)
        for count in (1, 2, 3, 64, 1024) if long else (1, 64):
            place = judge.kitchen.place("threads")
            end = judge.kitchen.start(command, place, words=["--threads", str(count)])
            judge.both(f"{command.name} on {count} threads", command, place, end, {0})
        for count in in_turn(("1", "64", "nonsense"), command, long):
            place = judge.kitchen.place("threads")
            end = judge.kitchen.start(command, place, env={"OMP_NUM_THREADS": count})
            if count == "nonsense":
                end.err = ""  # messages of OpenMP itself
            judge.both(f"{command.name} with OMP_NUM_THREADS={count}", command, place, end, {0})
    return None


ALL = {"disk": disk, "memory": memory, "signals": signals, "clock": clock, "read_only": read_only, "locale": locale, "threads": threads}
