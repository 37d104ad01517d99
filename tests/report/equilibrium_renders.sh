#!/bin/sh
# equilibrium_renders.sh KINETIX_OPT: the report of an equilibrium, with and without a physics run, drawn in a browser.
set -eu
. "$(dirname "$0")/browser.sh"
program=$1
cat >"$work/panel.yaml" <<'END'
kinetix: 1
structure: {cells: [4, 3], cell_mm: 10}
design: {hinges: [{wall: [[1, 1], [2, 1]], t: 0.4}]}
drive: {kind: plates, axis: y, compression: 0.25}
hinge: {model: elastic}
END
"$program" verify "$work/panel.yaml" --quiet -o "$work/verified" >/dev/null || fail "verify ends with $?"
draw "$work/verified/report.html"
holds 'In equilibrium, and the physics run agrees'
drawn load 'class="badge"'
drawn load 'walls touch'
drawn energy 'class="heat"'
drawn plan 'Walls in contact'
holds ' N at most: a matter for both arms</dd>'
for id in errors tilts search stable; do absent $id; done

sed -i 's/compression: 0.25/compression: 0.7/' "$work/panel.yaml"
"$program" simulate "$work/panel.yaml" --model equilibrium --quiet -o "$work/stopped" >/dev/null && fail "it ends with 0"
draw "$work/stopped/report.html"
holds 'The drive stopped'

cat >"$work/twist.yaml" <<'END'
kinetix: 1
structure: {cells: [1, 1], cell_mm: 20, wall_mm: {thickness: 0.4, height: 8}}
design: {pattern: {even: {A_in_deg: [90, 60, 90, 60]}}}
drive: {kind: hinge, wall: [[0, 0], [0, 1]], angle_deg: 96}
hinge: {model: elastic, k_turn: 0.001}
END
"$program" simulate "$work/twist.yaml" --model equilibrium --quiet -o "$work/twist" >/dev/null || fail "simulate ends with $?"
draw "$work/twist/report.html"
holds ' N&nbsp;mm at most: a matter for a hand</dd>'
drawn load 'barrier A–B'
drawn load 'load peaks'
drawn stable 'aria-label="Stable state B"'
drawn stable 'Between A and B the energy rises to'
sed -i 's/drive: .*/drive: {kind: shape_memory, angle_deg: 20, k_turn: 5}/' "$work/panel.yaml"
"$program" simulate "$work/panel.yaml" --model equilibrium --quiet -o "$work/springs" >/dev/null || fail "springs end with $?"
draw "$work/springs/report.html"
holds 'its own springs fold it</dd>'

# A sheet that one hinge moves has the size that its closed form has, however it lies.
cat >"$work/aslant.yaml" <<'END'
kinetix: 1
structure: {cells: [4, 4], cell_mm: 10}
drive: {kind: hinge, wall: [[0, 0], [1, 0]], angle_deg: 40}
hinge: {model: elastic}
END
"$program" simulate "$work/aslant.yaml" --model equilibrium --quiet -o "$work/aslant" >/dev/null || fail "one hinge ends with $?"
draw "$work/aslant/report.html"
holds 'Folded</dt><dd>41.9 × 41.9 × 6.00 mm</dd>'
holds 'Printed flat: 4 × 4 cells of 10&nbsp;mm, 41&nbsp;mm × 41&nbsp;mm'
echo "equilibrium_renders: all sections are drawn"
