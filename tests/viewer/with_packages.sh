#!/bin/sh
# with_packages.sh FOLDER ON|OFF NAME: runs NAME.test.mjs with packages that are installed in FOLDER; 77 where it cannot.
# NAME can also be `install`, and `start` or `stop` of the browser that all tests share. ctest names the file with the
# browser's address in KINETIX_BROWSER and installs before all tests. Without that file NAME.test.mjs starts its own browser.
set -e
here=$(dirname "$(readlink -f "$0")")
skip() { echo "skipped: $1"; exit 77; }

[ "$2" = ON ] || skip "the program was built without the studio"
command -v npm >/dev/null || skip "npm is missing"
case $3 in
  scripts | install) ;;
  *) command -v "${CHROMIUM:-/usr/bin/chromium}" >/dev/null || skip "chromium is missing" ;;
esac
mkdir -p "$1"
cd "$1"
if [ -z "$KINETIX_BROWSER" ] || [ "$3" = install ]; then
  cp "$here"/*.mjs "$here"/../report/*.mjs .
  if ! cmp -s "$here/package-lock.json" node_modules/.lock; then
    rm -f node_modules/.lock
    cp "$here/package.json" "$here/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund --loglevel=error --fetch-retries=1 --fetch-retry-mintimeout=1000 >/dev/null 2>&1 || skip "npm reaches no packages"
    cp "$here/package-lock.json" node_modules/.lock
  fi
fi
[ -e node_modules/.lock ] || skip "npm reaches no packages"
node=$(command -v node || command -v nodejs)
case $3 in
  install) exit 0 ;;
  start | stop) exec "$node" shared_browser.mjs "$3" "$KINETIX_BROWSER" ;;
  *) exec "$node" "$3.test.mjs" ;;
esac
