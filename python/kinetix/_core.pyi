"""The compiled part (python/bindings), which the package's own classes wrap and document."""

from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np
from numpy.typing import NDArray

_Numbers = NDArray[np.float64]

version: str

class State:
    name: str
    model: str
    theta: float
    gap_max: float
    gap_rms: float
    poses: _Numbers
    positions: _Numbers
    rotations: _Numbers

class Design:
    name: str
    theta: float
    bodies: int
    hinges: int
    cells: int
    cell_mm: float
    is_exact: bool
    family: str
    why: str
    t: _Numbers
    alpha: _Numbers
    beta: _Numbers
    offset_mm: _Numbers
    rest_positions: _Numbers
    hinge_points: _Numbers
    hinge_axes: _Numbers
    hinge_bodies: List[List[int]]
    walls: List[str]
    def with_hinges(self, t: Any, alpha: Any, beta: Any, offset_mm: Any) -> Design: ...
    def with_theta(self, theta: float) -> Design: ...
    def text(self) -> str: ...
    def poses(self, theta: Optional[float]) -> _Numbers: ...
    def fold(self, theta: _Numbers, threads: int) -> _Numbers: ...
    def derivatives(self, theta: Optional[float]) -> Tuple[List[str], _Numbers]: ...

class Run:
    name: str
    theta: float
    exit_code: int
    reached: Optional[bool]
    stopped: bool
    violations: List[str]
    states: List[State]
    path: Optional[Dict[str, _Numbers]]
    def sensitivity(self, poses: Optional[_Numbers], load: float, energy: float) -> Dict[str, Any]: ...
    def json(self) -> str: ...
    def metrics(self) -> str: ...
    def verdict(self) -> str: ...
    def summary(self, verbose: bool) -> str: ...
    def design_text(self) -> str: ...
    def report(self) -> str: ...
    def write(self, folder: str) -> None: ...

class Target:
    name: str
    kind: str

class RunChoice: ...

class CustomGoal:
    name: str
    def gradient_error(self, states: int) -> float: ...

class PrintRequest:
    formats: List[str]
    process: str
    hinge: str
    clearance_mm: float
    cell_mm: float
    bed_mm: List[float]
    loose_rods: bool
    caps: bool
    slicer: str
    folded: bool
    orient: str
    slice: bool

def read_design(file: str) -> Design: ...
def parse_design(text: str, file: str) -> Design: ...
def read_target(file: str) -> Target: ...
def parse_target(text: str, file: str) -> Target: ...
def choice(threads: int, seed: int, verify: bool, prints: int, fidelity: bool, time_limit_s: Optional[float],
           progress: Optional[Callable[[str, Optional[float], str], object]]) -> RunChoice: ...
def optimise(target: Target, choice: RunChoice) -> Run: ...
def optimise_custom(goal: CustomGoal, choice: RunChoice) -> Run: ...
def simulate(design: Design, file: str, model: str, choice: RunChoice) -> Run: ...
def make_goal(name: str, error: Any, gradient: Any, tolerance: float, columns: int, rows: int, cell_mm: float,
              wall_mm: Optional[Tuple[float, float]], beta: Tuple[float, float], theta: Tuple[float, float], per: str,
              symmetry: str, solver: str, starts: int, max_evaluations: int) -> CustomGoal: ...
def export_files(design: Design, folder: str, request: PrintRequest) -> Tuple[List[str], str]: ...
def fold_strips(beta: _Numbers, theta: _Numbers, t: Optional[_Numbers], cell_mm: float, rows: int,
                out: Optional[_Numbers], threads: int) -> _Numbers: ...
def strip_derivatives(beta: _Numbers, theta: _Numbers, cell_mm: float, rows: int,
                      threads: int) -> Tuple[_Numbers, _Numbers]: ...
def strip_gradients(beta: _Numbers, theta: _Numbers, by_poses: _Numbers, cell_mm: float, rows: int,
                    threads: int) -> _Numbers: ...
