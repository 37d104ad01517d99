#!/bin/sh
# sweep_renders.sh KINETIX_OPT: runs small sweeps of each kind of analysis and looks at their reports in a browser.
set -eu
. "$(dirname "$0")/browser.sh"
program=$1
cat >"$work/crease.yaml" <<END
kinetix: 1
structure: {cells: [3, 1], cell_mm: 10}
design: {theta_deg: 45}
END
sweep() {
  cat >"$work/$1.yaml" <<END
kinetix: 1
base: crease.yaml
method: $2
factors:
  - {path: "design.columns[1].beta_deg", range: [5, 60]}
  - {path: design.theta_deg, range: [10, 40]}
responses: [fold_deg, end_mm]
END
  "$program" sweep "$work/$1.yaml" -o "$work/$1" --quiet >"$work/log" 2>&1 || fail "$(cat "$work/log")"
  draw "$work/$1/report.html"
  holds 'id="headline"'
  drawn factors 'beta, column 1'
  drawn responses 'end'
  drawn response-0 'class="model"'
  drawn response-0 'class="cloud"'
  drawn provenance 'seed'
  absent failures
}
sweep lhs '{kind: lhs, samples: 200}'
holds 'All 200 samples were computed'
drawn response-0 'standardised'
holds 'in 90 of 100 samples'
holds 'Most of it goes with beta, column 1'
holds 'the middle, and the limits of 90 of 100 samples'
sweep saltelli '{kind: saltelli, samples: 64}'
drawn response-0 'total index'
drawn response-0 'class="turn"'
sweep morris '{kind: morris, samples: 10}'
drawn response-0 'elementary effect'
sweep one '{kind: one_at_a_time, levels: 5}'
drawn response-1 'largest change'
holds 'in all 11 samples'
drawn response-0 'all else as in the first sample'
# Many factors of one kind are one row, and the sheet shows which wall counts.
cat >"$work/walls.yaml" <<END
kinetix: 1
base: crease.yaml
method: {kind: monte_carlo, samples: 300}
factors:
  - {path: "design.walls[*].t_mm", normal: {mean: 0, sd: 0.05}, each: true, add: true}
  - {path: "design.theta_deg", normal: {mean: 0, sd: 0.2}, add: true}
model: equilibrium
responses: [moved_rms_mm]
END
"$program" sweep "$work/walls.yaml" -o "$work/walls" --quiet >"$work/log" 2>&1 || fail "$(cat "$work/log")"
draw "$work/walls/report.html"
drawn factors 't, each wall'
drawn factors '<td>10</td>'
drawn response-0 't, each wall on the layout'
drawn response-0 'more of the factor raises the response'
drawn response-0 'more of it lowers the response'
[ "$(wc -c <"$work/walls/report.html")" -lt 200000 ] || fail "the page of 11 factors is larger than 200 kB"

# More samples than are shown one by one: all are counted. What multiplies the base has not the base's unit.
cat >"$work/scaled.yaml" <<END
kinetix: 1
base: crease.yaml
method: {kind: factorial, levels: 50}
factors:
  - {path: structure.cell_mm, scale: true, range: [0.9, 1.1]}
  - {path: design.theta_deg, add: true, range: [-5, 5]}
responses: [end_mm]
END
"$program" sweep "$work/scaled.yaml" -o "$work/scaled" --quiet >"$work/log" 2>&1 || fail "$(cat "$work/log")"
draw "$work/scaled/report.html"
drawn factors '0.9 to 1.1'
drawn factors "times the base's"
drawn factors "added to the base's"
drawn response-0 'samples, 2500 in all'
drawn response-0 '2000 of 2500 samples, drawn by lot'
# Factors of one kind with different values each: the report lists all, not only the first factor's.
cat >"$work/kinds.yaml" <<END
kinetix: 1
base: crease.yaml
method: {kind: factorial, levels: 3}
factors:
  - {path: "design.columns[0].beta_deg", range: [0, 10]}
  - {path: "design.columns[1].beta_deg", range: [-60, 5]}
responses: [end_mm]
END
"$program" sweep "$work/kinds.yaml" -o "$work/kinds" --quiet >"$work/log" 2>&1 || fail "$(cat "$work/log")"
draw "$work/kinds/report.html"
drawn factors '; -60 to 5'
sed -i 's/\[3, 1\]/[1, 1]/' "$work/crease.yaml"
cat >"$work/bad.yaml" <<END
kinetix: 1
base: crease.yaml
method: {kind: factorial}
factors:
  - {path: "design.walls[0].t", values: [0.5, 0.4]}
responses: [fold_deg]
END
"$program" sweep "$work/bad.yaml" -o "$work/bad" --quiet >"$work/log" 2>&1 || fail "$(cat "$work/log")"
draw "$work/bad/report.html"
drawn failures 'no exact family'
holds '1 of 2 samples did not succeed'
echo "sweep_renders: all sections are drawn"
