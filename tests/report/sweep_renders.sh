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
  drawn factors 'design.theta_deg'
  drawn responses 'end_mm'
  drawn response-0 'class="model"'
  drawn response-0 'class="cloud"'
  drawn provenance 'seed'
  absent failures
}
sweep lhs '{kind: lhs, samples: 200}'
holds 'All 200 samples were computed'
drawn response-0 'standardised'
sweep saltelli '{kind: saltelli, samples: 64}'
drawn response-0 'total index'
drawn response-0 'class="turn"'
sweep morris '{kind: morris, samples: 10}'
drawn response-0 'elementary effect'
sweep one '{kind: one_at_a_time, levels: 5}'
drawn response-1 'largest change'
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
