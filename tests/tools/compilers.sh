#!/bin/sh
# compilers.sh [REGEX]: compares the program built by GCC and by clang, at -O0 and at -O3, on shipped targets. REGEX
# selects their names; the default is a few quick ones of every kind.
# Each build runs them twice and must give the same numbers to the last bit. Numbers of different builds may differ by
# BOUND, relative above 1 and absolute below. Searches stop at tolerances, and rounding decides at which step.
# Builds go to build/compilers and take as long as four of `make program`. The exit code is 1 if any number exceeds its
# bound.
set -eu
source=$(cd "$(dirname "$0")/../.." && pwd)
only=${1:-'^(half_circle|helmet_rib|cube|octahedron|letter_t|honeycomb_t|helix|miura|shrinking_block|rosette|disc|cap)\.yaml'}
bound=${BOUND:-1e-5}
work=$source/build/compilers
compare="/usr/bin/python3 $source/tests/tools/compare_results.py"
first=
failed=0

build() { # NAME COMPILER LEVEL
  cmake -S "$source" -B "$work/$1" -G Ninja -DCMAKE_CXX_COMPILER="$2" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_FLAGS_RELEASE="-O$3 -DNDEBUG" -DBUILD_TESTING=OFF > "$work/$1.configure"
  cmake --build "$work/$1" --target kinetix-opt > "$work/$1.build"
}

mkdir -p "$work"
for compiler in g++ clang++-14; do
  for level in 3 0; do
    name=$compiler-O$level
    echo "$name"
    build "$name" "$compiler" "$level"
    for time in once again; do
      $compare run "$work/$name/bin/kinetix-opt" "$work/$name/$time" --only "$only" > "$work/$name.$time"
    done
    $compare compare "$work/$name/once" "$work/$name/again" --tolerance 0 || failed=1
    if [ -z "$first" ]; then
      first=$name
    else
      echo "$first against $name"
      $compare compare "$work/$first/once" "$work/$name/once" --tolerance "$bound" || failed=1
    fi
  done
done
exit $failed
