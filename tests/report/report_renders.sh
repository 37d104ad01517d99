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
drawn layout 'the tilt of its front wall; from row to row the sign alternates.'
drawn space '<canvas'
drawn errors 'class="model"'
drawn errors 'class="turn"'
drawn tilts '<td>5</td>'
drawn search 'class="start best"'
drawn fidelity 'class="dot model"'
drawn plan 'cylindrical sheet'
# Walls that all lean to one side.
/usr/bin/python3 -c 'import json, sys
result = json.load(open(sys.argv[1]))
for hinge in result["structure"]["hinges"]: hinge["beta_rad"] = abs(hinge["beta_rad"])
print(json.dumps(result))' "$result" | "$write_report" >"$work/given.html"
draw "$work/given.html"
drawn layout 'the tilt of its front wall.'
# The plain search's design, whose prints are not known, and one that is chosen.
/usr/bin/python3 -c 'import json, sys
result = json.load(open(sys.argv[1]))
one = {"columns": 6, "cell_mm": 10, "theta_rad": 0.5, "shape_rms": 0.01, "as_made_rms_mm": None, "allowed": False, "chosen": False}
result["curve"]["robust"] = [one, one | {"as_made_rms_mm": 0.5, "allowed": True}, one | {"as_made_rms_mm": 0.4, "allowed": True, "chosen": True}]
print(json.dumps(result))' "$result" | "$write_report" >"$work/given.html"
draw "$work/given.html"
drawn errors 'of the design with the least error of its own that is not known.'
echo "report_renders: all sections are drawn"
