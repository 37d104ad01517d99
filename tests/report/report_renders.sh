#!/bin/sh
# report_renders.sh WRITE_REPORT RESULT.json: draws a report in a browser and looks at what came out.
set -eu
write_report=$1 result=$2

fail() { echo "report_renders: $1" >&2; exit 1; }
command -v chromium >/dev/null || fail "chromium is missing; it is listed in packages.txt"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The controls are used once, as a reader would; what that breaks shows up as an error in the page.
use_controls='<script>
for (const control of document.querySelectorAll("button, input[type=radio]")) control.click();
for (const slider of document.querySelectorAll("input[type=range]")) { slider.value = 1; slider.dispatchEvent(new Event("input")); }
document.querySelector("canvas")?.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
window.dispatchEvent(new Event("beforeprint"));
window.dispatchEvent(new Event("afterprint"));
document.documentElement.dataset.used = "true";
</script>'
"$write_report" <"$result" >"$work/report.html"
echo "$use_controls" >>"$work/report.html"
chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
  --disable-component-update --disable-sync --user-data-dir="$work/profile" --enable-logging=stderr --v=0 \
  --window-size=1000,2000 --dump-dom "file://$work/report.html" >"$work/dom" 2>"$work/log" ||
  fail "chromium ended with an error: $(tail -5 "$work/log")"

holds() { grep -qF -- "$1" "$work/dom" || fail "the page lacks $1"; }
lacks() { ! grep -qF -- "$1" "$work/dom" || fail "the page shows: $(grep -F -A2 -- "$1" "$work/dom" | head -3)"; }
# drawn ID TEXT: TEXT occurs between the start of the section and the next one.
drawn() {
  tr '\n' ' ' <"$work/dom" | sed 's/<section id=/\n&/g' | grep -F "<section id=\"$1\"" | grep -qF -- "$2" ||
    fail "section $1 lacks $2"
}

grep CONSOLE "$work/log" && fail "the browser's console is not silent"
holds 'data-ready="true"'
holds 'data-used="true"'
holds '<div id="problems" role="alert" hidden="">'
lacks 'class="missing"'
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
