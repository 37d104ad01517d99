"""States of a structure: poses of its bodies."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from . import _core


class State:
    """Poses of all bodies, in the order of result.json.

    The arrays are views of the run's data: nothing is copied, and nothing can be written. They keep the run alive.
    """

    __slots__ = ("_core", "__weakref__")

    def __init__(self, core: _core.State) -> None:
        self._core = core

    @property
    def name(self) -> str:
        """``target``, or ``frame`` for the steps of a motion."""
        return self._core.name

    @property
    def model(self) -> str:
        """Model that computed it: ``exact``, ``equilibrium`` or ``bullet``."""
        return self._core.model

    @property
    def theta(self) -> float:
        """Fold angle, rad."""
        return self._core.theta

    @property
    def poses(self) -> NDArray[np.float64]:
        """(N, 7): x y z in mm, then the unit quaternion w x y z. Made once, at the first call."""
        return self._core.poses

    @property
    def positions(self) -> NDArray[np.float64]:
        """(N, 3), mm."""
        return self._core.positions

    @property
    def rotations(self) -> NDArray[np.float64]:
        """(N, 3, 3): the rotation matrix of each body; that of the flat state is the identity."""
        return self._core.rotations

    @property
    def gap_max(self) -> float:
        """Largest distance of a hinge's two halves, cell edges."""
        return self._core.gap_max

    @property
    def gap_rms(self) -> float:
        """Root mean square distance of a hinge's two halves over all hinges, cell edges."""
        return self._core.gap_rms

    def __len__(self) -> int:
        return len(self._core.positions)

    def __repr__(self) -> str:
        return f"<kinetix.State {self.name!r}: {self.model}, theta {self.theta:.4f} rad, {len(self)} bodies>"
