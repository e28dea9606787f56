#compdef errmap
# Completion for zsh. The program itself knows what may stand where: this asks
# it and tells zsh.
_errmap() {
  local line word description entry extension files
  local -a plain open
  for line in "${(@f)$("$words[1]" __complete "${(@)words[2,CURRENT-1]}" \
    "$PREFIX" 2>/dev/null)}"; do
    case $line in
      '') ;;
      :files*)
        files=yes
        extension=${${line#:files}# }
        ;;
      :folders) files=folders ;;
      *)
        word=${line%%$'\t'*}
        entry=${word//:/\\:}
        [[ $line == *$'\t'* ]] && entry+=":${line#*$'\t'}"
        # More is to come after these: no blank.
        if [[ $word == *[=:] ]]; then open+=("$entry"); else plain+=("$entry"); fi
        ;;
    esac
  done
  (( $#plain )) && _describe -t words word plain
  (( $#open )) && _describe -t words word open -S ''
  [[ -n $files ]] && compset -P '*[:=]'
  case $files in
    folders) _files -/ ;;
    yes) if [[ -n $extension ]]; then _files -g "*.$extension"; else _files; fi ;;
  esac
}
_errmap "$@"
