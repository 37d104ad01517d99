#!/bin/sh
# with_packages.sh FOLDER ON|OFF NAME: runs NAME.test.mjs with packages that are installed in FOLDER; 77 where it cannot.
set -e
here=$(dirname "$(readlink -f "$0")")
skip() { echo "skipped: $1"; exit 77; }

[ "$2" = ON ] || skip "the program was built without the studio"
command -v npm >/dev/null || skip "npm is missing"
[ "$3" = scripts ] || command -v "${CHROMIUM:-/usr/bin/chromium}" >/dev/null || skip "chromium is missing"
mkdir -p "$1"
cp "$here"/*.mjs "$1"
cd "$1"
if ! cmp -s "$here/package-lock.json" node_modules/.lock; then
  cp "$here/package.json" "$here/package-lock.json" .
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-retry-mintimeout=1000 >/dev/null 2>&1 || skip "npm reaches no packages"
  cp "$here/package-lock.json" node_modules/.lock
fi
exec "$(command -v node || command -v nodejs)" --test "$3.test.mjs"
