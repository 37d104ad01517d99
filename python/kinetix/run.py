"""Searches, simulations and files, as the program makes them."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

from . import _core
from .design import Design
from .documents import Source, yaml_text
from .goals import Goal
from .result import Result

Progress = Callable[[str, Optional[float], str], object]
"""Receives the stage, the share of it that is done (0 to 1, or None) and a text. May be called from any thread."""


def _target(source: Source, folder: "str | os.PathLike[str]") -> _core.Target:
    if isinstance(source, Mapping):
        return _core.parse_target(yaml_text(source), os.path.join(folder, "target.yaml"))
    return _core.read_target(os.fspath(source))


def optimise(target: Union[Source, Goal], *, folder: "str | os.PathLike[str]" = "", threads: int = 0, seed: int = 0,
             verify: bool = True, prints: int = 0, fidelity: bool = False, time_limit_s: Optional[float] = None,
             progress: Optional[Progress] = None) -> Result:
    """Searches for the sheet that folds into a goal, and folds it again in the simulation.

    Ctrl-C, or the time limit, ends the search with the best so far (:attr:`Result.stopped`); a second Ctrl-C raises
    KeyboardInterrupt.

    :param target: the path of a target.yaml, a dict with its keys, or a custom :class:`Goal`.
    :param folder: from which relative paths in a dict start.
    :param threads: 0 = all cores; the result does not depend on it.
    :param seed: of the random starts; same seed, same result.
    :param verify: run the simulation.
    :param prints: number of prints with random errors that are simulated, to confirm the print tolerance.
    :param fidelity: repeat the simulation with coarser time steps, for the table of accuracy against run time.
    :param time_limit_s: s, after which the search ends; None: no limit.
    :param progress: see :data:`Progress`.
    :raises InvalidInput: with the place, for whatever the format does not allow; what a callable raises is raised
    """
    choice = _core.choice(threads, seed, verify, prints, fidelity, time_limit_s, progress)
    if isinstance(target, Goal):
        return Result(_core.optimise_custom(target._core, choice))
    return Result(_core.optimise(_target(target, folder), choice))


def simulate(design: Union[Design, Source], model: str = "exact", *, theta: Optional[float] = None,
             folder: "str | os.PathLike[str]" = "", threads: int = 0, fidelity: bool = False,
             progress: Optional[Progress] = None) -> Result:
    """Computes a folded state of a design.

    :param design: a :class:`Design`, the path of a design.yaml, or a dict with its keys.
    :param model: ``exact``: the analytic motion; ``equilibrium``: elastic hinges, from flat to the drive's goal;
        ``bullet``: the rigid-body simulation, compared with the model.
    :param theta: rad, instead of the design's own drive.
    :raises InvalidInput: with the place, for whatever the format does not allow, and for the exact model of a sheet
        that has no analytic motion.
    :raises KeyboardInterrupt: after Ctrl-C, once an equilibrium path under way has ended
    """
    of = design if isinstance(design, Design) else Design(design, folder)
    if theta is not None:
        of = of.with_theta(theta)
    choice = _core.choice(threads, 0, True, 0, fidelity, None, progress)
    return Result(_core.simulate(of._core, of._file, model, choice))


def verify(design: Union[Design, Source, Result], *, folder: "str | os.PathLike[str]" = "", fidelity: bool = False,
           progress: Optional[Progress] = None) -> Result:
    """Simulates a design, compared with the model if one fits (:attr:`Result.agrees`)."""
    of = design.design if isinstance(design, Result) else design
    return simulate(of, "bullet", folder=folder, fidelity=fidelity, progress=progress)


class Exported(NamedTuple):
    """Files of an export."""

    folder: str
    files: List[str]
    """Names in the folder."""
    print: Dict[str, Any]
    """Content of print.json: bodies, hinges, volumes, bounds, warnings."""


def export(design: Union[Design, Source, Result], formats: Union[str, Sequence[str]],
           folder: "str | os.PathLike[str]", *, process: str = "", hinge: str = "", clearance_mm: float = 0,
           cell_mm: float = 0, bed_mm: Optional[Tuple[float, float]] = None, loose_rods: bool = False, folded: bool = False,
           orient: str = "flat", slice: bool = False, caps: bool = False, slicer: str = "") -> Exported:
    """Writes a design for printers, CAD and simulators: all files or none.

    :param formats: names, or ``all``: stl, 3mf, step, svg, dxf, mjcf, glb, scad.
    :param folder: for the files.
    :param process: polyjet, fdm, sla, sls or laser, whose limits are checked; by default the design's, else polyjet.
    :param hinge: pin, block, film or rod if the design names none; by default pins if they fit, else blocks.
    :param clearance_mm: of pins, per side: the least gap of the printer's coupon that turns; 0: the process's.
    :param cell_mm: cells of this edge instead of the design's own; 0: its own.
    :param bed_mm: x and y of the printer's bed: a larger sheet is cut into tiles.
    :param loose_rods: rods of pins as separate parts.
    :param folded: the state of the design instead of flat.
    :param orient: ``flat``, ``over``, or ``best``.
    :param slicer: prusa, orca, bambu or cura, that the 3MF file is for; by default all that slice for the process.
    :param slice: requests time and material from PrusaSlicer.
    :param caps: knuckles of pins as identical round caps, for any direction of their axes.
    :raises InvalidInput: for what cannot be made, or not by the process
    """
    of = design.design if isinstance(design, Result) else design
    of = of if isinstance(of, Design) else Design(of)
    request = _core.PrintRequest()
    request.formats = [formats] if isinstance(formats, str) else list(formats)
    request.process, request.hinge, request.cell_mm, request.orient = process, hinge, cell_mm, orient
    request.clearance_mm, request.slicer = clearance_mm, slicer
    request.bed_mm = list(bed_mm) if bed_mm is not None else []
    request.loose_rods, request.caps, request.folded, request.slice = loose_rods, caps, folded, slice
    files, report = _core.export_files(of._core, os.fspath(folder), request)
    return Exported(os.fspath(folder), files, json.loads(report))
