#!/usr/bin/python3
"""check_package.py BUILD SOURCE SCRATCH [--whole]: the .deb installs into a clean root, and the demo runs there.

dpkg installs it with a separate root and database; without root rights it is unpacked instead. Its dependencies
are those of this machine, which must contain every library that the program loads.

CPack reads the kind of every file before it finds dependencies, which takes longer than all else. Therefore they are
those of a second package, with the program alone. --whole: those of the package itself, compressed as usual.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

build, source, scratch = (pathlib.Path(folder).resolve() for folder in sys.argv[1:4])
is_whole = "--whole" in sys.argv[4:]
# The promised files, one per kind: program, manual, completion, schema, library, headers, CMake package, documentation,
# examples, targets.
DOC = "share/doc/kinetix"
PROMISED = ["bin/kinetix-opt", "share/man/man1/kinetix-opt.1*", "share/bash-completion/completions/kinetix-opt",
            "share/kinetix/target.schema.json", "lib/libkinetix_model.a", "lib/kinetix/modules/kinetix-cad.so", "lib/kinetix/modules/kinetix-read-step", "lib/kinetix/modules/kinetix-mesh.so", "include/kinetix/kinetix.hpp",
            "lib/cmake/kinetix/kinetix-config.cmake", f"{DOC}/README.md", f"{DOC}/docs/reference/formats.md",
            f"{DOC}/examples/fit_curve.cpp", "share/kinetix/targets/shapes/helmet_rib.csv"]
SMALL_DESIGN = {"kinetix": 1, "structure": {"cells": [4, 1], "cell_mm": 10}, "design": {"theta_deg": 20}}


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode:
        sys.exit(f"{command} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


# Leaves only the program in the folder that CPack makes a package of.
KEEP_PROGRAM = """file(GLOB_RECURSE files LIST_DIRECTORIES false ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
list(FILTER files EXCLUDE REGEX "/bin/kinetix-opt$")
file(REMOVE ${files})
"""


def package(folder, **options):
    """Makes a package in a new folder with the options of CPack."""
    words = [word for name, value in options.items() for word in ("-D", f"CPACK_{name}={value}")]
    run("cpack", "--config", build / "CPackConfig.cmake", "-B", scratch / folder, *words)
    (file,) = (scratch / folder).glob("kinetix_*.deb")
    return file


def package_with_dependencies(whole_package):
    if is_whole:
        return whole_package
    script = scratch / "keep_program.cmake"
    script.write_text(KEEP_PROGRAM)
    return package("program", DEBIAN_COMPRESSION_TYPE="none", PRE_BUILD_SCRIPTS=script)


def installed(file):
    """Returns the root into which the package was installed."""
    root = scratch / "root"
    if os.geteuid():
        root.mkdir()
        run("dpkg-deb", "-x", file, root)
        return root
    (root / "var/lib/dpkg").mkdir(parents=True)
    (root / "var/lib/dpkg/status").touch()
    run("dpkg", f"--root={root}", "--log=/dev/null", "--force-depends", "--install", file)
    status = run("dpkg", f"--root={root}", "--status", "kinetix")
    if "Status: install ok installed" not in status:
        sys.exit(status)
    return root


def check_files(file, root):
    missing = [name for name in PROMISED if not list((root / "usr").glob(name))]
    if missing:
        sys.exit(f"the package lacks {missing}")
    paths = re.findall(r"\./(\S*)$", run("dpkg-deb", "--contents", file), re.MULTILINE)
    elsewhere = [path for path in paths if path and not path.startswith("usr/")]
    if elsewhere or not paths:
        sys.exit(f"files outside /usr: {elsewhere}")


def check_dependencies(file, program):
    """Checks that every shared library the program loads is in a package that it depends on, directly or indirectly."""
    if "not found" in run("ldd", program):
        sys.exit(run("ldd", program))
    needed = re.findall(r"NEEDED\s+(\S+)", run("objdump", "-p", program))
    depends = run("dpkg-deb", "--field", file, "Depends")
    for library, name in (("libBulletDynamics", "libbullet"), ("libyaml-cpp", "libyaml-cpp"), ("libcholmod", "libcholmod")):
        if not any(n.startswith(library) for n in needed) or name not in depends:
            sys.exit(f"{library}: loaded {needed}, depends on {depends}")


def check_demo(root):
    """Checks that the demo of the Makefile meets its goal, from the package alone."""
    (line,) = re.findall(r"^demo: .*\n\t(.*)$", (source / "Makefile").read_text(), re.MULTILINE)
    words = line.split()
    folder = scratch / "demo"
    folder.mkdir()
    (folder / "targets").symlink_to(root / "usr/share/kinetix/targets")
    said = run(root / "usr/bin" / pathlib.Path(words[0]).name, *words[1:], "--quiet", cwd=folder)
    if not said.startswith("helmet_rib: "):
        sys.exit(f"the demo says\n{said}")
    result = json.loads((folder / words[-1] / "result.json").read_text())
    if not result["metrics"]["met"]:
        sys.exit("the demo misses its goal")
    # STEP export needs a module, which the program must find next to itself. The whole demo takes it five seconds.
    (folder / "small.yaml").write_text(json.dumps(SMALL_DESIGN))
    run(root / "usr/bin/kinetix-opt", "export", folder / words[-1] if is_whole else "small.yaml", "--format", "step",
        "--quiet", cwd=folder)
    if not list(folder.glob("**/*.step")):
        sys.exit("no STEP file was written")


def check_python(root):
    folders = list((root / "usr/lib").glob("python3*/dist-packages"))
    if not folders:
        return "no Python module: not built"
    script = (f"import kinetix; design = {SMALL_DESIGN}; print(kinetix.__file__, kinetix.simulate(design).poses.shape);"
              f" kinetix.export(design, 'step', '{scratch / 'python_step'}')")
    said = run("/usr/bin/python3", "-c", script, env={"PYTHONPATH": str(folders[0]), "PATH": os.environ["PATH"]})
    if not said.startswith(str(root)) or "(10, 7)" not in said:
        sys.exit(f"the module says {said}")
    if not list((scratch / "python_step").glob("*.step")):
        sys.exit("the module writes no STEP file")
    return "Python module"


def main():
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    file = package("package", DEBIAN_COMPRESSION_TYPE="zstd" if is_whole else "none",
                   DEBIAN_PACKAGE_SHLIBDEPS="ON" if is_whole else "OFF")
    root = installed(file)
    check_files(file, root)
    check_dependencies(package_with_dependencies(file), root / "usr/bin/kinetix-opt")
    check_demo(root)
    print(f"{file.name}, {file.stat().st_size / 1e6:.0f} MB: demo, {check_python(root)}")
    shutil.rmtree(scratch)


main()
