"""Many strips at once, as arrays."""

from __future__ import annotations

from typing import Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core


def _rows(beta: ArrayLike, theta: ArrayLike) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Repeats a single angle for all strips. Other counts are checked with all other numbers."""
    tilts, angles = np.asarray(beta, dtype=np.float64), np.asarray(theta, dtype=np.float64)
    return tilts, np.full(tilts.shape[:1], angles.item()) if angles.size == 1 else angles


def fold_strips(beta: ArrayLike, theta: ArrayLike, cell_mm: float = 1.0, *, t: Optional[ArrayLike] = None,
                rows: int = 1, out: Optional[NDArray[np.float64]] = None, threads: int = 0) -> NDArray[np.float64]:
    """Folds B strips of C columns by the analytic motion, on all cores and without the interpreter's lock.

    The poses are those that the program computes for the same designs, to the last bit.

    :param beta: (B, C): tilt of each column's walls in row 0, rad, within +-pi/2; row j has (-1)^j of it.
    :param theta: (B,) or one number: fold parameter, rad, within +-pi/2.
    :param cell_mm: cell edge, mm.
    :param t: (B, C): places of the hinges of row 0, from the left; 1/2 (the default) where a column is tilted.
    :param rows: of cells.
    :param out: (B, N, 7): an array to write into, which is returned.
    :param threads: 0 = all cores; the result does not depend on it.
    :return: (B, N, 7) with N = (C + 1) (rows + 1): body (i, j) is at i (rows + 1) + j; x y z in mm, then the unit
        quaternion w x y z.
    :raises InvalidInput: naming the entry, for numbers outside their range
    """
    tilts, angles = _rows(beta, theta)
    fractions = None if t is None else np.asarray(t, dtype=np.float64)
    return _core.fold_strips(tilts, angles, fractions, cell_mm, rows, out, threads)


def strip_derivatives(beta: ArrayLike, theta: ArrayLike, cell_mm: float = 1.0, *, rows: int = 1,
                      threads: int = 0) -> Tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Computes the poses of :func:`fold_strips`, and their derivatives by every tilt and by theta, in closed form.

    :return: poses (B, N, 7) and derivatives (B, C + 1, N, 6): by the tilt of column c, last by theta. For each body
        these are the shift in mm and the turn (a vector about which it turns) in rad, per rad.
    """
    tilts, angles = _rows(beta, theta)
    return _core.strip_derivatives(tilts, angles, cell_mm, rows, threads)


def strip_gradients(beta: ArrayLike, theta: ArrayLike, by_poses: ArrayLike, cell_mm: float = 1.0, *, rows: int = 1,
                    threads: int = 0) -> NDArray[np.float64]:
    """Computes gradients of B functions of the poses, one per strip, by every tilt and by theta.

    One pass back over the bodies takes about the time of a fold, while strip_derivatives makes a table per parameter.

    :param by_poses: (B, N, 6): derivatives of each function by the shift (per mm) and the turn (a vector about which it
        turns, per rad) of each body of fold_strips.
    :return: (B, C + 1): by the tilt of column c, last by theta, per rad.
    :raises InvalidInput: naming the entry, for numbers outside their range or of another shape
    """
    tilts, angles = _rows(beta, theta)
    return _core.strip_gradients(tilts, angles, np.asarray(by_poses, dtype=np.float64), cell_mm, rows, threads)
