"""kinetix: inverse design of flat sheets that fold into a target shape.

Lengths in mm, angles in rad, forces in N; files and dicts have degrees, in keys that end in ``_deg``. python.md has
examples.
"""

from ._core import version as __version__
from .design import Design
from .errors import InvalidInput
from .goals import Goal
from .result import Result
from .run import Exported, export, optimise, simulate, verify
from .state import State
from .strips import fold_strips, strip_derivatives, strip_gradients

__all__ = ["Design", "Exported", "Goal", "InvalidInput", "Result", "State", "export", "fold_strips", "optimise", "simulate",
           "strip_derivatives", "strip_gradients", "verify"]
