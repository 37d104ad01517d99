"""Writes docs/gallery.md from the runs of the gallery."""
HINGES = {"pin": "printed pins", "block": "rubber blocks", "film": "living hinges", "rod": "loose rods"}
PROCESSES = {"polyjet": "PolyJet", "fdm": "FDM", "sla": "SLA", "sls": "SLS", "laser": "laser cutter"}
HEAD = """# Gallery

Each design is a target file of the repository and one command. The pictures are renderings of the solids that `export` wrote, flat
as printed and folded. The disc is a 1 euro coin, 23.25 mm wide, to the same scale.

A grey head under a helmet, and the coloured faces of solids and cells of letters, are no parts: they show the shape.

Sizes are those of the exported solids. Forces are computed; without a `hinge:` section they are those of the friction of the
hinges, 0.1 N mm/rad, which is assumed. `make gallery` runs all designs, draws them and writes this page. The searches
took {minutes} minutes together on two cores, next to other work.
"""


def size_text(mesh):
    return " x ".join(f"{length:.0f}" for length in mesh.size()) + " mm"


def force_text(made):
    """Returns the force or moment that folds the design. A missing one has no drive that reaches the fold."""
    if made.get("force_N") is not None:
        return f"{made['force_N']:.2g} N" if made["force_N"] < 100 else f"{made['force_N']:.0f} N"
    if made.get("moment_Nmm") is not None:
        return f"{made['moment_Nmm']:.2g} N mm" if made["moment_Nmm"] < 100 else f"{made['moment_Nmm']:.0f} N mm"
    return "not computed"


def process_text(run):
    made = run.result["manufacture"]
    if not run.is_exported:
        return f"not printable as it is ({PROCESSES[made['process']]})"
    kind = (made.get("hinge") or {}).get("kind") or run.print["hinge"]
    return f"{PROCESSES[run.print['process']]}, {HINGES.get(kind, kind)}"


def verdict_text(run):
    problems = run.result["verdict"]["problems"]
    met = run.result["verdict"]["met"]
    text = "target met" if met else "target missed" if met is False else "no target"
    if run.result["verdict"]["agrees"]:
        text += ", the simulation agrees"
    return text + (f", {len(problems)} warnings" if len(problems) > 1 else ", 1 warning" if problems else "")


def light_text(run):
    metrics, name = run.result["metrics"], run.design.name
    return (f"\nLight through a letter cell and through the rest: {100 * metrics['light_letter']:.0f} % against "
            f"{100 * metrics['light_rest']:.0f} % (computed). From a distance, before a lamp, in true luminance and with stretched "
            f"contrast:\n\n![{run.design.title}: true luminance](gallery/{name}_afar_after.png) "
            f"![{run.design.title}: contrast stretched](gallery/{name}_afar_after_enhanced.png)\n")


def entry(run):
    design = run.design
    drawn = "rendering" if run.is_exported else "rendering of its walls"
    text = f"""
### {design.title}

![{design.title}: flat and folded, {drawn}](gallery/{design.name}.png)

| flat | folded | made by | force to fold | result |
|---|---|---|---|---|
| {size_text(run.flat)} | {size_text(run.folded)} | {process_text(run)} | {force_text(run.result['manufacture'])} | {verdict_text(run)} |
"""
    if design.is_display and "light_letter" in run.result["metrics"]:
        text += light_text(run)
    return text + f"""
```sh
build/release/bin/kinetix-opt targets/shapes/{design.name}.yaml{'  # exit code 3' if run.record['code'] == 3 else ''}
```
"""


def write_page(path, runs):
    minutes = max(1, round(sum(run.record["seconds"] for run in runs) / 60))
    text, group = HEAD.format(minutes=minutes), None
    for run in runs:
        if run.design.group != group:
            group = run.design.group
            text += f"\n## {group}\n"
        text += entry(run)
    path.write_text(text, encoding="utf-8")
