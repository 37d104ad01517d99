"""Results of a run."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, List, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .design import Design
from .notebook import framed
from .state import State


class Problem(NamedTuple):
    """An error or a warning about a result."""

    level: str
    """``error``, if a flag of the verdict is false, or ``warning``."""
    text: str


class Verdict(NamedTuple):
    """The verdict of a run, as in result.json. A flag is None if the run did not check it."""

    met: Optional[bool]
    """The design meets its goal in the state that counts."""
    agrees: Optional[bool]
    """The simulation agrees with the model."""
    printable: Optional[bool]
    """:func:`export` without options would write it."""
    reaches: Optional[bool]
    """The drive takes the sheet there."""
    hinges: Dict[str, str]
    """Kind of hinge for each flag that is not None."""
    problems: List[Problem]
    """Errors first; there is an error if and only if a flag is false."""


class Result:
    """All results of a run: the content of result.json and of the report."""

    __slots__ = ("_core", "_json", "__weakref__")

    def __init__(self, core: _core.Run) -> None:
        self._core = core
        self._json: Optional[str] = None

    @property
    def name(self) -> str:
        """Name of the target or design."""
        return self._core.name

    @property
    def theta(self) -> float:
        """Fold angle of the state shown, rad."""
        return self._core.theta

    @property
    def verdict(self) -> Verdict:
        """Whether the goal is met, the simulation agrees, it can be printed and its drive takes it there, and why not."""
        found = json.loads(self._core.verdict())
        found["problems"] = [Problem(**problem) for problem in found["problems"]]
        return Verdict(**found)

    @property
    def exit_code(self) -> int:
        """Exit code of the program: 0; 3: not met, not printable or not reached; 4: the simulation disagrees."""
        return self._core.exit_code

    @property
    def met(self) -> Optional[bool]:
        """Whether the goal is met within its tolerances; None for a design, which had none."""
        return self.verdict.met

    @property
    def violations(self) -> List[str]:
        """Violations of the goal, in words."""
        return self._core.violations

    @property
    def agrees(self) -> Optional[bool]:
        """Whether the simulation agrees with the model; None without a simulation."""
        return self.verdict.agrees

    @property
    def reached(self) -> Optional[bool]:
        """Whether the drive reached its goal with elastic hinges; None if no equilibrium was requested."""
        return self._core.reached

    @property
    def stopped(self) -> bool:
        """Whether Ctrl-C or a time limit ended the search; the result is then its best so far."""
        return self._core.stopped

    @property
    def states(self) -> List[State]:
        """All states: by each model, and steps of the motion from flat on (``frame``)."""
        return [State(core) for core in self._core.states]

    def state(self, model: Optional[str] = None) -> State:
        """Returns the folded state.

        :param model: ``exact``, ``equilibrium`` or ``bullet``; by default the first there is.
        :raises KeyError: if the run has no state by that model
        """
        for core in self._core.states:
            if core.name == "target" and model in (None, core.model):
                return State(core)
        raise KeyError(f"no folded state by the model {model!r}; there are: "
                       + ", ".join(s.model for s in self._core.states if s.name == "target"))

    @property
    def poses(self) -> NDArray[np.float64]:
        """(N, 7) of the folded state: x y z in mm, then the unit quaternion w x y z."""
        return self.state().poses

    @property
    def path(self) -> Optional[Dict[str, NDArray[np.float64]]]:
        """The equilibrium path from flat, one number per step; None if no equilibrium was requested.

        ``theta`` (rad), ``load`` (N, or N mm), ``energy`` (N mm), ``gap`` (cell edges), ``contacts``, ``stable`` (0 or
        1). ``drive`` is the compression (a fraction), the turn of a driven hinge (rad), the shortening of a tendon
        (mm), or the rest angle of shape-memory springs (rad).
        """
        return self._core.path

    def sensitivity(self, poses: Optional[ArrayLike] = None, *, load: float = 0.0,
                    energy: float = 0.0) -> Dict[str, Any]:
        """Computes derivatives of a function f of the equilibrium by every hinge and its material.

        It uses the adjoint. The structure is in equilibrium again after each change, while the drive stays at its
        theta. One call costs about as much as a step of Newton's method, for any number of hinges.

        :param poses: (N, 6): f by the shift (mm) and the turn (a vector about which it turns, rad) of each body. A
            rigid motion of all bodies must not change f.
        :param load: f by the drive's load, per N for plates and tendons, per N mm for driven hinges and springs.
        :param energy: f by the stored energy, per N mm.
        :return: ``t``, ``alpha``, ``beta``, ``offset_mm`` (H,) for each hinge (a fraction, rad, rad, mm). Also
            ``theta`` (rad), ``k_point`` (N/mm), ``k_turn`` (N mm/rad), ``reach_mm`` and ``k_contact`` (N/mm).
        :raises InvalidInput: if there is no equilibrium, or not a stable one at the drive's goal
        """
        return self._core.sensitivity(None if poses is None else np.asarray(poses, dtype=np.float64), load, energy)

    @property
    def design(self) -> Design:
        """The sheet that was found or simulated."""
        return Design.from_text(self._core.design_text())

    @property
    def metrics(self) -> Dict[str, Any]:
        """``metrics`` of result.json."""
        metrics: Dict[str, Any] = json.loads(self._core.metrics())
        return metrics

    def json(self) -> str:
        """Returns the document result.json."""
        if self._json is None:
            self._json = self._core.json()
        return self._json

    def to_dict(self) -> Dict[str, Any]:
        """Returns result.json as a dict (formats.md)."""
        document: Dict[str, Any] = json.loads(self.json())
        return document

    def summary(self, verbose: bool = False) -> str:
        """Returns the lines that the program prints.

        :param verbose: those of ``-v``, with all results
        """
        return self._core.summary(verbose)

    def report(self) -> str:
        """Returns the report: one page of HTML that needs no other file."""
        return self._core.report()

    def write(self, folder: "str | os.PathLike[str]") -> None:
        """Writes result.json, design.yaml, report.html and pictures into a folder: all of them or none.

        :raises InvalidInput: if the folder cannot be written
        """
        self._core.write(os.fspath(folder))

    def _repr_html_(self) -> str:
        return framed(self.report(), self.name)

    def __repr__(self) -> str:
        return "<kinetix.Result " + self.summary().split("\n", 1)[0] + ">"

    def __str__(self) -> str:
        return self.summary()
