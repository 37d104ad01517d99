#!/bin/sh
# goals_renders.sh KINETIX_OPT SHAPES: the reports of a display, a fold and a helmet, each with its own tolerances,
# drawn in a browser.
set -eu
. "$(dirname "$0")/browser.sh"
program=$1 shapes=$2
# search NAME: runs $work/NAME.yaml and draws its report; whether the goal is met does not matter here.
search() {
  "$program" "$work/$1.yaml" --no-verify --quiet -o "$work/$1" >/dev/null || [ $? -eq 3 ] || fail "$1 ends with $?"
  draw "$work/$1/report.html"
}
cat >"$work/ring.yaml" <<'END'
kinetix: 1
target: {kind: display, rows: ["0000", "0110", "0110", "0000"]}
tolerance: {auc: 0.96, contrast: 2.5, stretch: 0.13}
solver: {starts: 1, max_evaluations: 20}
END
search ring
drawn display 'letter and background cells distinguished in'
holds 'required at least 0.96'
holds 'required at least 2.5'
holds 'allowed 0.13'

cat >"$work/box.yaml" <<'END'
kinetix: 1
target: {kind: fold, box: [2, 1, 1]}
tolerance: {angle_deg: 0.3, shape: 0.03}
END
search box
drawn fold '<th scope="col">Required</th>'
drawn layout '&nbsp;columns and '  # which the net does not fill
holds 'allowed 0.3'
holds 'allowed 0.03'

cat >"$work/soft.yaml" <<'END'
kinetix: 1
target: {kind: display, glyph: T}
structure: {cells: [8, 8], cell_mm: 20, wall_mm: {thickness: 2, height: 8}}
hinge: {kind: block, material: tango, gap_mm: 2, thickness_mm: 1.2}
tolerance: {strain: 0.25}
END
search soft
drawn display 'within the limits'
drawn display 'without them'
drawn display 'looked at in the elastic model'

cat >"$work/cap.yaml" <<END
kinetix: 1
target: {kind: helmet, mesh: $shapes/headform.obj, ribs: 3, coverage_mm: 70}
structure: {cell_mm: 24}
tolerance: {rms_mm: 1.7, max_mm: 7}
END
search cap
drawn helmet 'Off its section, rms'
holds 'allowed 1.7'
holds 'allowed 7'
echo "goals_renders: all sections are drawn"
