# Sourced: draws a report in a browser and checks the result. Leaves a folder $work.
fail() { echo "$(basename "$0" .sh): $1" >&2; exit 1; }
command -v chromium >/dev/null || fail "chromium is missing; it is listed in packages/tests.txt"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The controls are used as a reader would, by keys too; what that breaks shows up as an error in the page. A key goes to
# whatever has the focus, so that every control must keep it while it is used.
use_controls='<script>
const faults = [];
function keepsFocus(control, use) {
  control.focus();
  use();
  if (document.activeElement !== control) faults.push(`${control.outerHTML.slice(0, 80)} loses the focus`);
}
function press(key) {
  document.activeElement.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
}
Object.defineProperty(navigator, "clipboard", {value: undefined});  // so that copying is done at once
for (const slider of document.querySelectorAll("input[type=range]"))
  keepsFocus(slider, () => { slider.value = 1; slider.dispatchEvent(new Event("input")); });
for (const control of document.querySelectorAll("button, input[type=radio], summary")) keepsFocus(control, () => control.click());
for (const canvas of document.querySelectorAll("canvas"))
  keepsFocus(canvas, () => ["ArrowLeft", "ArrowLeft", "ArrowUp", "ArrowRight", "ArrowUp", "ArrowDown"].forEach((key, k) => {
    const before = canvas.toDataURL();
    press(key);
    if (canvas.toDataURL() === before) faults.push(`key press ${k + 1} does not turn the view`);
  }));
window.dispatchEvent(new Event("beforeprint"));
window.dispatchEvent(new Event("afterprint"));
document.documentElement.dataset.faults = faults.join("; ");
document.documentElement.dataset.used = "true";
</script>'
# Ends with 124 if the browser does not end. One that starts while all cores are busy may wait for its own processes for ever.
look() {
  rm -rf "$work/profile"
  timeout 90 chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync --user-data-dir="$work/profile" --enable-logging=stderr --v=0 \
    --window-size=1000,2000 --dump-dom "file://$work/report.html" >"$work/dom" 2>"$work/log"
}
# Repeats a run only if it hung. Ends as the last run did.
look_until_it_ends() {
  for _ in 1 2 3; do
    ended=0
    look || ended=$?
    [ $ended -eq 124 ] || return $ended
  done
  return $ended
}
# draw REPORT.html: what the browser makes of it goes to $work/dom; nothing may go wrong on the way.
draw() {
  cp "$1" "$work/report.html"
  echo "$use_controls" >>"$work/report.html"
  look_until_it_ends || fail "chromium ended with an error: $(tail -5 "$work/log")"
  # The tests themselves cause two messages: drivers complain about reading pictures back, and a script may not fill the screen.
  ! grep CONSOLE "$work/log" | grep -vE 'GL Driver Message|software WebGL|requestFullscreen' || fail "the browser's console is not silent"
  holds 'data-ready="true"'
  holds 'data-used="true"'
  grep -qF 'data-faults=""' "$work/dom" || fail "$(grep -o 'data-faults="[^"]*"' "$work/dom")"
  holds '<div id="problems" role="alert" hidden="">'
  lacks 'class="missing"'
  unsaid balance torn unrest afar nan
}

holds() { grep -qF -- "$1" "$work/dom" || fail "the page lacks $1"; }
lacks() { ! grep -qF -- "$1" "$work/dom" || fail "the page shows: $(grep -F -A2 -- "$1" "$work/dom" | head -3)"; }
# unsaid WORD...: none of the words is in what the page says, whatever its scripts call things.
unsaid() {
  for word in "$@"; do
    ! sed -e '/<script/,/<\/script>/d' -e '/<style>/,/<\/style>/d' -e 's/"data:[^"]*"//g' "$work/dom" | grep -oiE ".{0,30}\\b$word\\b.{0,10}" || fail "the page says $word"
  done
}
# drawn ID TEXT: TEXT occurs between the start of the section and the next one.
drawn() {
  tr '\n' ' ' <"$work/dom" | sed 's/<section id=/\n&/g' | grep -F "<section id=\"$1\"" | grep -qF -- "$2" ||
    fail "section $1 lacks $2"
}
absent() { ! grep -qF "<section id=\"$1\"" "$work/dom" || fail "there is a section $1"; }
