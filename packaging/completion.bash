# bash completion of glintmark: commands and options are those that the program itself names.
_glintmark() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]} commands command='' candidate scenes
  commands=$(COLUMNS=100 "$program" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  for candidate in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    if [[ " ${commands//$'\n'/ } " == *" $candidate "* ]]; then
      command=$candidate
      break
    fi
  done
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(COLUMNS=100 "$program" $command --help 2>/dev/null |
      grep -oE -- '^  +-[^ ]+' | grep -oE -- '--[a-z][a-z-]*')" -- "$word")
  elif [[ -z $command ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$word")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$word")
    case $command in
      render | heatmap | export | profile)
        scenes=$(dirname "$(readlink -f "$(command -v "$program")")")/../share/glintmark/scenes
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W \
          "$(cd "$scenes" 2>/dev/null && printf '%s\n' *.toml | sed 's/\.toml$//')" -- "$word")
        ;;
    esac
  fi
}
complete -o filenames -F _glintmark glintmark
