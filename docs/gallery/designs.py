"""The designs of the gallery: targets of targets/shapes, and how they are shown."""
from dataclasses import dataclass


@dataclass
class Design:
    name: str  # of targets/shapes/NAME.yaml
    title: str
    group: str
    posture: str = "sheet"  # of the folded state: see posture.py
    azimuth_deg: float = 12
    elevation_deg: float = 32
    is_behind: bool = False  # folded behind flat, else next to it
    is_display: bool = False
    options: tuple = ()  # of `export`


CURVES, BOXES, PANELS = "Curves", "Boxes and solids", "Letters and pictures"
OUTLINES, SURFACES = "Outlines and flat mechanisms", "Helmets, surfaces and blocks"
TOP = {"elevation_deg": 62, "azimuth_deg": 0}  # for panels, which stay flat

DESIGNS = [
    Design("helmet_rib", "Rib over a head", CURVES, "arch"),
    Design("s_curve", "S curve", CURVES, "arch"),
    Design("spiral", "Spiral", CURVES, "arch"),
    Design("handle", "Pull for a drawer", CURVES, "arch"),
    Design("spectacle_frame", "Spectacle frame", CURVES, "arch"),
    Design("helix", "Helix of two turns", CURVES),
    Design("tray_in_mm", "Tray of 90 x 60 x 30 mm", BOXES, "bowl"),
    Design("box_with_lid", "Box with a lid", BOXES, "bowl"),
    Design("cube", "Cube from one net", BOXES, "bowl"),
    Design("octahedron", "Octahedron", BOXES, "bowl"),
    Design("icosahedron", "Icosahedron", BOXES, "bowl"),
    Design("letter_t", "Letter T", PANELS, is_display=True, **TOP),
    Design("turned_s", "Letter S, by one turned hinge", PANELS, is_display=True, **TOP),
    Design("honeycomb_t", "Letter T in a honeycomb", PANELS, is_display=True, **TOP),
    Design("word", "Word", PANELS, is_behind=True, is_display=True, **TOP),
    Design("square_to_disc", "Square to disc", OUTLINES, **TOP),
    Design("heart", "Heart", OUTLINES, **TOP),
    Design("living_panel", "Panel with living hinges, for a laser cutter", OUTLINES, **TOP),
    Design("headform", "Helmet of eight ribs", SURFACES, "dome"),
    Design("vase", "Front of a vase", SURFACES, "dome"),
    Design("saddle", "Saddle", SURFACES, "dome"),
    Design("stool", "Stool", SURFACES, "tall"),
    Design("shrinking_block", "Block that shrinks along three axes", SURFACES),
]
HERO = ("helmet_rib", "tray_in_mm", "headform")
