#!/bin/sh
# made_renders.sh WRITE_REPORT RESULT.json: a report's tick is amber, with the reason, where the made thing is bad or
# not known, drawn in a browser.
set -eu
. "$(dirname "$0")/browser.sh"
write_report=$1 result=$2
# with SECTIONS: the report of the result, which is green by itself, with more sections and without its pictures, which
# take most of the time.
# flagged FLAG PROBLEMS: such a section `verdict`, that of the result with one flag false, or "" for none.
flagged() {
  /usr/bin/python3 -c 'import json, sys
verdict = json.load(open(sys.argv[1]))["verdict"] | {"problems": json.loads(sys.argv[3])}
if sys.argv[2]: verdict[sys.argv[2]] = False
print("\"verdict\":" + json.dumps(verdict))' "$result" "$1" "$2"
}
with() {
  /usr/bin/python3 -c 'import json, sys
result = json.load(open(sys.argv[1])) | json.loads("{" + sys.argv[2] + "}")
print(json.dumps({key: value for key, value in result.items() if key not in ("states", "structure")}))' \
    "$result" "$1" | "$write_report" >"$work/given.html"
  chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking --disable-component-update \
    --disable-sync --user-data-dir="$work/profile" --dump-dom "file://$work/given.html" >"$work/dom" 2>"$work/log" ||
    fail "chromium ended with an error: $(tail -5 "$work/log")"
  holds 'data-ready="true"'
}
made='"process":"fdm","designed_mm":0.1,"rms_mm":0.2,"p95_mm":0.3,"tolerance_mm":0.4,"confirmed":true,"sources":[]'
with "\"as_made\":{$made,\"can_be_printed\":true,\"holds\":true,\"why\":[]}"
holds 'class="verdict good"'
unsaid 'stay apart'
with "\"as_made\":{$made,\"can_be_printed\":true,\"holds\":true,\"why\":[],\"free_of_contact\":null}"
holds 'That walls of prints stay apart on the way is not proven.'
with "$(flagged "" '[{"level":"warning","text":"3 of 20 prints found no equilibrium"},{"level":"warning","text":"walls of prints may meet"}]')"
holds 'class="verdict unsure"'
holds ', with 2&nbsp;warnings<'
holds '<p class="why">Warning: 3 of 20 prints found no equilibrium</p>'
with "$(flagged printable '[{"level":"error","text":"a wall of 0.4 mm is less than fdm prints, 0.8 mm"}]')"
holds 'class="verdict bad"'
holds ', but it cannot be printed like this<'
holds '<p class="why">Error: a wall of 0.4 mm is less than fdm prints, 0.8 mm</p>'
with "$(flagged reaches '[{"level":"error","text":"the hinge of wall 3 is strained by 0.7"}]')"
holds 'class="verdict bad"'
holds ', but its drive does not take it there<'
with "$(flagged agrees '[{"level":"error","text":"the simulation ends 2.7 mm (rms) from the model"}]'),"'"metrics":{"met":true,"verified":false,"verify_rms":0.27,"strain_max":0.95,"strain_allowed":0.5}'
holds 'class="verdict bad"'
holds 'the physics run disagrees<'
holds '<p class="why">Error: the simulation ends 2.7 mm (rms) from the model</p>'
holds '0.95 of the 0.5 that the hinges'
holds 'material bears: more than it bears'
missed=$(flagged met '[{"level":"error","text":"the error is 5; at most 0.1 is allowed"}]')
own='"curve":null,"target":{"kind":"own","name":"handle"},"tolerance":{"error":0.1,"verify":0.02}'
with "$own,$missed,\"own\":{\"residuals\":[3,4],\"reasons\":[\"the error is 5; at most 0.1 is allowed\"]},\"metrics\":{\"error\":5,\"met\":false,\"verified\":true,\"verify_rms\":0.001}"
holds '<h2>The strip misses its goal</h2>'
holds '<p class="why">Error: the error is 5; at most 0.1 is allowed</p>'
holds 'Its error is 5.00, the root of the sum of squares of 2 numbers, and 0.1 is allowed.'
holds '<th scope="col">fit error</th>'
absent errors
with "$own,\"own\":{\"residuals\":[0.05]},\"metrics\":{\"error\":0.05,\"met\":true,\"verified\":true,\"verify_rms\":0.001}"
holds '<h2>The strip meets its goal, and the physics run agrees</h2>'
end='"walls":["[[0, 0], [1, 0]]","[[0, 1], [1, 1]]"]'
range='"low":{"theta_rad":-0.5,"contact_rad":null,"walls":[]},"high":{"theta_rad":0.6,"contact_rad":0.6000001,'$end'},"left_out":1'
with "\"certified\":{\"design\":{\"growth_mm\":0,$range},\"printed\":{\"growth_mm\":0.2,$range},\"covers_theta\":true,\"covers_theta_printed\":false}"
holds '<h2>Free of contact, proven</h2>'
holds 'To positive θ it ends with walls [[0, 0], [1, 0]] and [[0, 1], [1, 1]], which do overlap at 34.4°.'
holds 'this state lies within'
holds 'pair of plates touches as built'
holds 'this state lies beyond: walls may meet on the way'
with "\"certified\":{\"design\":{\"growth_mm\":0,$range},\"printed\":{\"growth_mm\":0.2,$range},\"states_are_exact\":false,\"states_have_left\":true,\"covers_theta\":true,\"covers_theta_printed\":true}"
holds '<h2>Free of contact: proven of the closed form, not of this state</h2>'
holds '<p>Of the state shown nothing is proven: the equilibrium has left the closed form'
lacks 'this state lies within'
lacks 'equilibria of elastic hinges near it. '
with '"certified":{"why_not":"its states are equilibria"}'
holds 'No range of θ is proven: its states are equilibria.'
echo "made_renders: ticks are green where prints hold alone"
