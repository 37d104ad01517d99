#!/bin/bash
# check_command_line.sh KINETIX_OPT SOURCE: checks that the manual page and the completion have exactly the commands and
# options that --help names.
set -eu
program=$1 source=$2 faults=0
fault() { echo "check_command_line: $1" >&2; faults=1; }
source "$source/app/cli/kinetix-opt.bash"

# Prints the long options that --help lists. usage: options_of TEXT
options_of() { grep -oE '^  (-[a-z],)?--[a-z-]+' <<<"$1" | grep -oE -- '--[a-z-]+' | sort -u; }
# Prints the completions of the last word. usage: completed WORD...
completed() {
  COMP_WORDS=(kinetix-opt "$@") COMP_CWORD=$# COMPREPLY=()
  _kinetix_opt
  printf '%s\n' "${COMPREPLY[@]}" | sort -u
}

page=$(sed 's/\\-/-/g' "$source/app/cli/kinetix-opt.1")
commands=$("$program" --help | sed -n '/^Subcommands:/,/^$/p' | sed -nE 's/^  ([a-z]+).*/\1/p')
[ -n "$commands" ] || fault "no commands in --help"
known=
for command in "" $commands; do
  [ -z "$command" ] || grep -qx ".B $command" <<<"$page" || fault "the manual page lacks $command"
  [ -z "$command" ] || completed "" | grep -qx -- "$command" || fault "completion lacks $command"
  options=$(options_of "$("$program" $command --help)")
  known="$known $options"
  for option in $options; do
    grep -qE -- "^\.BI? $option( |$)" <<<"$page" || fault "the manual page lacks $option of '$command'"
  done
  [ "$(completed $command -- | grep -E '^--')" = "$options" ] || fault "completion of '$command' differs from --help"
done
for option in $(grep -oE '^\.BI? --[a-z-]+' <<<"$page" | awk '{print $2}'); do
  grep -qw -- "$option" <<<"$known" || fault "the manual page has $option, which is no option"
done
if command -v man >/dev/null; then
  said=$(man --warnings -l "$source/app/cli/kinetix-opt.1" 2>&1 >/dev/null) && [ -z "$said" ] || fault "man: $said"
fi
exit $faults
