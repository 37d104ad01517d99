#!/bin/sh
# fuzz.sh BUILD SECONDS [NAME...]: runs each fuzzer of a build of the preset fuzz, or the named ones, one after the
# other.
# New inputs go to BUILD/learned/NAME, inputs that break something to BUILD/found/NAME-*. Minimise these with
# KINETIX_READER=NAME BUILD/bin/kinetix-fuzz -minimize_crash=1 -runs=10000 and add them to tests/fuzz/corpus/NAME.
# An input fails with any exception but InvalidInput, a sanitizer's report, 120 s or 2 GiB. 120 s are about 4 s of the
# program: sanitizers and libFuzzer's checks of every branch make it thirty times slower. The exit code is 1 if any
# input fails.
build=$1 seconds=$2
shift 2
source=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$build/learned" "$build/found"
# Words of the formats, so that changed inputs contain words that a parser knows.
grep -oh '"[a-z_0-9]*"' "$source"/app/schema/*.schema.json | sort -u >"$build/words.dict"
export TMPDIR=$(mktemp -d -p /dev/shm kinetix-fuzz-XXXXXX)
trap 'rm -rf "$TMPDIR"' EXIT
export UBSAN_OPTIONS=print_stacktrace=1 LSAN_OPTIONS=suppressions=$source/cmake/lsan.supp:print_suppressions=0
failed=0
while read -r name seeds; do
  [ $# -eq 0 ] || case " $* " in *" $name "*) ;; *) continue ;; esac
  mkdir -p "$build/learned/$name"
  # $seeds: folders, some of them with examples for users; larger files are left out
  if KINETIX_READER=$name "$build/bin/kinetix-fuzz" -max_total_time="$seconds" -timeout=120 -rss_limit_mb=2048 -max_len=16384 -dict="$build/words.dict" \
    -artifact_prefix="$build/found/$name-" -print_final_stats=1 "$build/learned/$name" $seeds >"$build/found/$name.log" 2>&1; then
    echo "$name: clean, $(grep -o 'number_of_executed_units: *[0-9]*' "$build/found/$name.log" | grep -o '[0-9]*$') inputs"
  else
    echo "$name: FAILED, see $build/found/$name.log"
    failed=1
  fi
  rm -rf "$TMPDIR"/*
done <"$build/tests/fuzz/fuzzers.txt"
exit $failed
