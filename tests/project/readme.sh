#!/usr/bin/env bash
# Runs every kinetix-opt command of the README with the program under test. Also runs the README's first design, and
# compares the output of the run that is shown in full.
# Without --whole the targets are smaller than those of the README: the commands and their exit codes are the same.
# usage: readme.sh PROGRAM SOURCE_FOLDER SCRATCH_FOLDER [--whole]
set -euo pipefail
program=$1 source=$2 scratch=$3 whole=${4:-}
rm -rf "$scratch" && mkdir -p "$scratch"

# Makes a folder with the program and the shipped targets, as at the top of the repository. usage: make_place NAME
make_place() {
  mkdir -p "$scratch/$1/build/release/bin"
  ln -s "$program" "$scratch/$1/build/release/bin/kinetix-opt"
  ln -s "$source/targets" "$scratch/$1/targets"
}

# Changes lines of a target, each by a command of sed that must find its line. usage: make_smaller TARGET COMMAND...
make_smaller() {
  local file=targets/shapes/$1.yaml command before
  for command in "${@:2}"; do
    before=$(<"$file")
    sed -i "$command" "$file"
    [ "$before" != "$(<"$file")" ] || { echo "readme.sh: '$command' changes nothing in $1.yaml"; exit 1; }
  done
}

make_place shown
make_place commands
cd "$scratch/commands"
if [ "$whole" != --whole ]; then
  rm targets && cp -r "$source/targets" targets
  make_smaller helmet_rib 's/^structure:/&\n  cells: [8, 1]/'
  make_smaller headform 's/ribs: 8/ribs: 2/' 's/cell_mm: 6/cell_mm: 10/'
  make_smaller icosahedron 's/solid: icosahedron/solid: tetrahedron/'
  make_smaller cube 's/box: \[4, 4, 4\]/box: [2, 2, 2]/'
  make_smaller disc 's/cells: \[12, 12\]/cells: [8, 8]/' 's/offset_mm: 2/offset_mm: 3/'
  make_smaller letter_t 's/cells: \[10, 10\]/cells: [6, 6]/'
fi
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
cd "$scratch/shown"
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
