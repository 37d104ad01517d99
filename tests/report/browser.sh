# Sourced: draws a report in a browser and looks at what came out. Leaves a folder $work.
fail() { echo "$(basename "$0" .sh): $1" >&2; exit 1; }
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
# draw REPORT.html: what the browser makes of it goes to $work/dom; nothing may go wrong on the way.
draw() {
  cp "$1" "$work/report.html"
  echo "$use_controls" >>"$work/report.html"
  chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --user-data-dir="$work/profile" --enable-logging=stderr --v=0 \
    --window-size=1000,2000 --dump-dom "file://$work/report.html" >"$work/dom" 2>"$work/log" ||
    fail "chromium ended with an error: $(tail -5 "$work/log")"
  ! grep CONSOLE "$work/log" || fail "the browser's console is not silent"
  holds 'data-ready="true"'
  holds 'data-used="true"'
  holds '<div id="problems" role="alert" hidden="">'
  lacks 'class="missing"'
}

holds() { grep -qF -- "$1" "$work/dom" || fail "the page lacks $1"; }
lacks() { ! grep -qF -- "$1" "$work/dom" || fail "the page shows: $(grep -F -A2 -- "$1" "$work/dom" | head -3)"; }
# drawn ID TEXT: TEXT occurs between the start of the section and the next one.
drawn() {
  tr '\n' ' ' <"$work/dom" | sed 's/<section id=/\n&/g' | grep -F "<section id=\"$1\"" | grep -qF -- "$2" ||
    fail "section $1 lacks $2"
}
absent() { ! grep -qF "<section id=\"$1\"" "$work/dom" || fail "there is a section $1"; }
