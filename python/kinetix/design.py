"""Designs: flat sheets with all their hinges."""

from __future__ import annotations

import os
from typing import List, Mapping, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .documents import Source, yaml_text


class Design:
    """A flat sheet with the parameters of every hinge: the content of a design.yaml.

    It is immutable: its arrays refuse writes. Lengths in mm, angles in rad. Files and dicts have degrees, in keys that
    end in ``_deg``.

    :param source: the path of a design.yaml, or a dict with its keys.
    :param folder: from which relative paths in a dict start.
    :raises InvalidInput: with the place, for whatever the format does not allow

    >>> import kinetix
    >>> strip = kinetix.Design({"kinetix": 1, "structure": {"cells": [6, 1], "cell_mm": 10},
    ...                         "design": {"theta_deg": 20}})
    >>> strip.bodies, strip.hinges, strip.family
    (14, 19, 'F1')
    """

    __slots__ = ("_core", "_file", "__weakref__")

    def __init__(self, source: Source, folder: "str | os.PathLike[str]" = "") -> None:
        if isinstance(source, Mapping):
            self._file = ""
            self._core = _core.parse_design(yaml_text(source), os.path.join(folder, "design.yaml"))
        else:
            self._file = os.fspath(source)
            self._core = _core.read_design(self._file)

    @classmethod
    def from_text(cls, text: str, folder: "str | os.PathLike[str]" = "") -> "Design":
        """Reads the design from the text of a design.yaml."""
        return cls._of(_core.parse_design(text, os.path.join(folder, "design.yaml")))

    @classmethod
    def _of(cls, core: _core.Design, file: str = "") -> "Design":
        design = cls.__new__(cls)
        design._core, design._file = core, file
        return design

    @property
    def name(self) -> str:
        """Name of the design, and of folders with its results."""
        return self._core.name

    @property
    def theta(self) -> float:
        """Fold angle of the state to show, rad."""
        return self._core.theta

    @property
    def bodies(self) -> int:
        """Number of rigid bodies."""
        return self._core.bodies

    @property
    def hinges(self) -> int:
        """Number of hinges."""
        return self._core.hinges

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self._core.cells

    @property
    def cell_mm(self) -> float:
        """Cell edge, mm."""
        return self._core.cell_mm

    @property
    def is_exact(self) -> bool:
        """Whether it has an analytic motion."""
        return self._core.is_exact

    @property
    def family(self) -> str:
        """Family of exact sheets to which it belongs, such as ``F2``; ``none`` if it belongs to none."""
        return self._core.family

    @property
    def why(self) -> str:
        """The rule of the family in a sentence, or the hinge that breaks it."""
        return self._core.why

    @property
    def t(self) -> NDArray[np.float64]:
        """(H,): place of each hinge on its wall, as a fraction of the wall."""
        return self._core.t

    @property
    def alpha(self) -> NDArray[np.float64]:
        """(H,): angle of each hinge's axis within its wall, rad."""
        return self._core.alpha

    @property
    def beta(self) -> NDArray[np.float64]:
        """(H,): tilt of each wall, rad."""
        return self._core.beta

    @property
    def offset_mm(self) -> NDArray[np.float64]:
        """(H,): distance of each hinge from its wall, mm."""
        return self._core.offset_mm

    @property
    def rest_positions(self) -> NDArray[np.float64]:
        """(N, 3): places of the bodies in the flat sheet, mm."""
        return self._core.rest_positions

    @property
    def hinge_points(self) -> NDArray[np.float64]:
        """(H, 3): places of the hinges in the flat sheet, mm."""
        return self._core.hinge_points

    @property
    def hinge_axes(self) -> NDArray[np.float64]:
        """(H, 3): axes of the hinges in the flat sheet, unit vectors."""
        return self._core.hinge_axes

    @property
    def hinge_bodies(self) -> NDArray[np.int64]:
        """(H, 2): the bodies that each hinge joins."""
        bodies = np.asarray(self._core.hinge_bodies, dtype=np.int64).reshape(-1, 2)
        bodies.setflags(write=False)
        return bodies

    @property
    def walls(self) -> List[str]:
        """The wall of each hinge by its two vertices, as files have it: ``[[0, 0], [1, 0]]``."""
        return self._core.walls

    def with_hinges(self, t: Optional[ArrayLike] = None, alpha: Optional[ArrayLike] = None,
                    beta: Optional[ArrayLike] = None, offset_mm: Optional[ArrayLike] = None) -> "Design":
        """Returns the sheet with other hinges: one number per hinge for each parameter that is given.

        :raises InvalidInput: naming the wall, for numbers outside their range
        """
        return Design._of(self._core.with_hinges(t, alpha, beta, offset_mm))

    def with_theta(self, theta: float) -> "Design":
        """Returns the sheet at another fold angle theta, rad, instead of that of its drive."""
        return Design._of(self._core.with_theta(theta), self._file)

    def poses(self, theta: Optional[float] = None) -> NDArray[np.float64]:
        """(N, 7): the state of the analytic motion at theta, rad; by default where the design's own drive takes it.

        x y z in mm, then the unit quaternion w x y z.

        :raises InvalidInput: if the sheet has no analytic motion
        """
        return self._core.poses(theta)

    def fold(self, theta: ArrayLike, threads: int = 0) -> NDArray[np.float64]:
        """(len(theta), N, 7): one state of the analytic motion for each theta, rad, on all cores.

        For many strips with other tilts each, see :func:`kinetix.fold_strips`.

        :param threads: 0 = all cores; the result does not depend on it
        """
        return self._core.fold(np.asarray(theta, dtype=np.float64), threads)

    def derivatives(self, theta: Optional[float] = None) -> Tuple[List[str], NDArray[np.float64]]:
        """Computes the derivatives of the poses of the analytic motion by all parameters of a sheet of family F1,
        F2 or F3.

        ``beta[c]`` is the tilt of column c in row 0 (rad; row j has (-1)^j of it). ``t[c]`` and ``s[r]`` are the places
        of the hinges of a column and a row, as a fraction from the body whose i + j is even. ``gamma`` and ``theta``
        are in rad.

        :param theta: rad; by default where the design's own drive takes it.
        :return: the names, and (parameters, N, 6). For each body these are the shift in mm and the turn (a vector about
            which it turns) in rad, per rad or per 1.
        :raises InvalidInput: for sheets of other families
        """
        return self._core.derivatives(theta)

    def text(self) -> str:
        """Returns its design.yaml. Reading it gives the same design, bit for bit."""
        return self._core.text()

    def save(self, file: "str | os.PathLike[str]") -> None:
        """Writes its design.yaml."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self.text())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Design) and self.text() == other.text()

    def __hash__(self) -> int:
        return hash(self.text())

    def __reduce__(self) -> Tuple[object, Tuple[str]]:
        return Design.from_text, (self.text(),)

    def __repr__(self) -> str:
        return f"<kinetix.Design {self.name!r}: {self.bodies} bodies, {self.hinges} hinges, family {self.family}>"
