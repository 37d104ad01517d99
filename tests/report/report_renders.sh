#!/bin/sh
# report_renders.sh WRITE_REPORT RESULT.json: draws a report in a browser and looks at what came out.
set -eu
. "$(dirname "$0")/browser.sh"
write_report=$1 result=$2
"$write_report" <"$result" >"$work/given.html"
draw "$work/given.html"
holds 'id="headline"'
holds 'Target met, and the physics run agrees'
holds 'id="folded"'
drawn layout 'class="hinge"'
drawn space '<canvas'
drawn errors 'class="model"'
drawn errors 'class="turn"'
drawn tilts '<td>5</td>'
drawn search 'class="start best"'
drawn fidelity 'class="dot model"'
drawn plan 'cylindrical sheet'
echo "report_renders: all sections are drawn"
