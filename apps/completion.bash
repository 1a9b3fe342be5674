# bash completion for walktrack. Commands and options come from the program itself, so that they are
# those of the version that is installed.
_walktrack() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} program=${COMP_WORDS[0]}
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" --help-words 2>/dev/null)" -- "$word")
    return
  fi
  # bash takes "=" for a word of its own.
  [ "$before" = "=" ] && before=${COMP_WORDS[COMP_CWORD - 2]}
  if [ "$before" = --set ]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" config --keys 2>/dev/null)" -S = -- "$word")
    compopt -o nospace
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$program" "${COMP_WORDS[1]}" --help-words 2>/dev/null | tr -d =)" -- "$word")
  else
    compopt -o default  # files
  fi
}
complete -F _walktrack walktrack
