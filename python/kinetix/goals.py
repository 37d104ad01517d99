"""Custom goals: a function of a state that measures its distance from the desired one."""

from __future__ import annotations

from typing import Callable, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .documents import yaml_text

Poses = NDArray[np.float64]
Error = Callable[[Poses], ArrayLike]
"""Takes poses (N, 7) and returns a number or m numbers, whose sum of squares the search minimises."""
Gradient = Callable[[Poses], ArrayLike]
"""Takes the same poses and returns (m, N, 6): each residual by the shift (mm) and the turn (rad) of each body."""


class Goal:
    """A custom error for a strip, which uses the same search as the goals of files.

    The search varies the tilts of the columns and theta, from several starts. Then the simulation folds the strip,
    and the error is evaluated again. Body (i, j) has index i (rows + 1) + j; body 0 does not move from the origin.

    :param error: of poses (N, 7): x y z in mm, the unit quaternion w x y z; see :data:`Error`. It should be smooth. It
        may be called from any thread, one at a time.
    :param tolerance: of the root of the sum of squares, in the unit of the error.
    :param gradient: see :data:`Gradient`; without it the search calls the error twice for each of its variables.
    :param columns: of cells, at least 2.
    :param cell_mm: cell edge, mm.
    :param rows: of cells.
    :param wall_mm: thickness and height of the walls, mm; by default a tenth and three fifths of the cell edge, at most
        3 and 30.
    :param beta: least and largest tilt, rad.
    :param theta: least and largest fold parameter, rad; it stays below the angle at which walls close the cells.
    :param per: ``column``: each has a separate tilt; ``all``: all have the same tilt.
    :param symmetry: of the folded shape: ``none``, ``mirror_x``, ``mirror_y``, ``rotate_2``.
    :param solver: ``ceres``, ``slsqp``, ``mma`` or ``ccsa``; without derivatives ``bobyqa``, ``cobyla`` or ``crs``.
    :param starts: of the search.
    :param max_evaluations: per start.
    :raises InvalidInput: if nothing is left to search, or the error gives no numbers
    """

    def __init__(self, error: Error, tolerance: float, *, gradient: Optional[Gradient] = None, columns: int = 20,
                 cell_mm: float = 10.0, rows: int = 1, wall_mm: Optional[Tuple[float, float]] = None,
                 beta: Tuple[float, float] = (-1.0, 1.0), theta: Tuple[float, float] = (0.035, 0.77),
                 per: str = "column", symmetry: str = "none", solver: str = "ceres", starts: int = 8,
                 max_evaluations: int = 500, name: str = "own_goal") -> None:
        self._core = _core.make_goal(yaml_text({"kinetix": 1, "name": name}), error, gradient, tolerance, columns, rows, cell_mm, wall_mm, beta, theta,
                                     per, symmetry, solver, starts, max_evaluations)

    @property
    def name(self) -> str:
        """Name of the results."""
        return self._core.name

    def gradient_error(self, states: int = 5) -> float:
        """Compares the gradient with central differences, over the largest derivative: 1e-6 is fine.

        :param states: number of states that are compared, at least 1.
        :raises InvalidInput: if the goal has no gradient
        """
        return self._core.gradient_error(states)

    def __repr__(self) -> str:
        return f"<kinetix.Goal {self.name!r}>"
