#!/usr/bin/env bash
# Runs every kinetix-opt command of the README with the program under test. Also runs the README's first design, and
# compares the output of the run that is shown in full.
# usage: readme.sh PROGRAM SOURCE_FOLDER SCRATCH_FOLDER
set -euo pipefail
program=$1 source=$2 scratch=$3
rm -rf "$scratch" && mkdir -p "$scratch/build/release/bin" && cd "$scratch"
ln -s "$source/targets" targets
ln -s "$program" build/release/bin/kinetix-opt

commands=$(grep -E '^\$ build/release/bin/kinetix-opt ' "$source/README.md" | sed 's/^\$ //')
count=$(wc -l <<<"$commands")
[ "$count" -ge 6 ] || { echo "only $count commands found in the README"; exit 1; }
while IFS= read -r command; do
  echo "$command"
  expected=$(sed -n 's/.*# .*exit code \([0-9]*\).*/\1/p' <<<"$command") code=0
  ${command%%#*} --quiet >output.txt || code=$?
  [ "$code" -eq "${expected:-0}" ] || { cat output.txt; echo "exit code $code, not ${expected:-0}"; exit 1; }
done <<<"$commands"

# The first design: the block that writes wave.yaml, line by line as a reader would paste it.
first=$(awk '/^```sh$/ {block = ""; inside = 1; next}
  /^```$/ {if (inside && block ~ /wave\.yaml/) printf "%s", block; inside = 0}
  inside {block = block $0 "\n"}' "$source/README.md")
[ -n "$first" ] || { echo "the README shows no first design"; exit 1; }
bash -euo pipefail -c "$first"
[ -s results/wave/report.html ] || { echo "the first design of the README writes no report"; exit 1; }

# Filters the displayed run: times and the last digits of the simulation may differ.
steady() { grep -vE '^  (search|physics) ' | head -n 5; }
shown=$(sed -n '/^helmet_rib: /,/^```/p' "$source/README.md" | grep -v '^```' | steady)
measured=$(build/release/bin/kinetix-opt targets/shapes/helmet_rib.yaml -o results/helmet_rib --quiet | steady)
diff <(echo "$shown") <(echo "$measured")
