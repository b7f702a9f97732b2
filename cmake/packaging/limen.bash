# SPDX-License-Identifier: BSD-3-Clause
# Completion for bash. Commands and options are those that the programs print; nothing is listed here a second time.

# Words of the help of `limen help ARGUMENTS...` that match an extended regular expression, a line each.
_limen_words() {
  local pattern=$1
  shift
  limen help "$@" 2>/dev/null | grep -oE "$pattern" | sed -E 's/^[ ,]+//; s/[ ,]+$//'
}

_limen() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} choices
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    choices=$(_limen_words '^  [a-z]+ ')
  elif [[ $previous == --list ]]; then
    choices="scenes techniques metrics devices $(limen "${COMP_WORDS[1]}" --list techniques 2>/dev/null |
      grep -oE '^ *[a-z_]+/[a-z0-9_]+' | sed 's/^ *//')"
  elif [[ $word == -* ]]; then
    choices=$(_limen_words '(^ +|,)--?[a-z][a-z-]*' "${COMP_WORDS[1]}")
  elif ((COMP_CWORD == 2)); then
    choices=$(limen help "${COMP_WORDS[1]}" 2>/dev/null | sed -nE '/^Subcommands:/,$ s/^  ([a-z][a-z-]*) .*/\1/p')
  fi
  local IFS=$'\n'
  if [[ -n ${choices-} ]]; then mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word"); fi
  # Whatever else stands there is a file; readline quotes its name.
  if ((${#COMPREPLY[@]} == 0)); then
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
  fi
}
complete -F _limen limen
