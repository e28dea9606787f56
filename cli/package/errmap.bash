# Completion for bash. The program itself knows what may stand where: this
# asks it and tells readline.
_errmap() {
  local line=${COMP_LINE:0:COMP_POINT} word extension
  local -a words=()
  # Split at blanks alone: readline also splits at ':' and '=', of which models
  # and hold-outs are full.
  read -a words <<<"$line"
  [[ $line == *[[:blank:]] ]] && words+=("")
  local current=${words[${#words[@]} - 1]} tail
  # What readline replaces: the part after its last break character.
  tail=$current
  [[ $COMP_WORDBREAKS == *:* ]] && tail=${tail##*:}
  [[ $COMP_WORDBREAKS == *=* ]] && tail=${tail##*=}
  local kept=${current%"$tail"}

  COMPREPLY=()
  while IFS=$'\t' read -r word _; do
    case $word in
      :files*)
        compopt -o filenames 2>/dev/null
        extension=${word#:files}
        extension=${extension# }
        while IFS= read -r word; do
          COMPREPLY+=("$word")
        done < <(
          compgen -d -- "$tail"
          compgen -f -X "${extension:+!*.$extension}" -- "$tail"
        )
        ;;
      :folders)
        compopt -o filenames 2>/dev/null
        while IFS= read -r word; do
          COMPREPLY+=("$word")
        done < <(compgen -d -- "$tail")
        ;;
      *)
        COMPREPLY+=("${word#"$kept"}")
        [[ $word == *[=:] ]] && compopt -o nospace 2>/dev/null
        ;;
    esac
  done < <("$1" __complete "${words[@]:1}" 2>/dev/null)
}
complete -F _errmap errmap
