#!/usr/bin/env bash
# Every source is laid out as .clang-format says (mend: make format). Another version formats a little differently.
# usage: check_format.sh SOURCE_FOLDER
set -euo pipefail
cd "$1"
files=$(find app benchmarks examples kinetix model optim python sim targets tests -name '*.cpp' -o -name '*.hpp')
[ "$(wc -l <<<"$files")" -ge 500 ] || { echo "hardly any sources found: are the folders right?"; exit 1; }
xargs clang-format-14 --dry-run --Werror <<<"$files"
