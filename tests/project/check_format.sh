#!/usr/bin/env bash
# Checks that every source has the layout of .clang-format (mend: make format). Other versions give slightly different
# layouts.
# usage: check_format.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
files=$(find app benchmarks examples kinetix model optim python sim targets tests -name '*.cpp' -o -name '*.hpp')
[ "$(wc -l <<<"$files")" -ge 500 ] || { echo "hardly any sources found: are the folders right?"; exit 1; }
xargs -n 100 -P 2 clang-format-14 --dry-run --Werror <<<"$files"
