# Completion of mpm-verify for bash: verbs, options of each verb, studies by name.
_mpm_verify() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
  local verbs="list explain run compare report validate solve reference schema plan judge collect submit new cavity-tables cavity-profile"
  COMPREPLY=()
  case $before in
    --suite) mapfile -t COMPREPLY < <(compgen -W "quick full deep peers" -- "$word"); return ;;
    --isa) mapfile -t COMPREPLY < <(compgen -W "baseline avx2 avx512" -- "$word"); return ;;
    --out | --studies) mapfile -t COMPREPLY < <(compgen -d -- "$word"); return ;;
  esac
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "$verbs --help --version" -- "$word")
    return
  fi
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$("$1" "$verb" --help 2> /dev/null | grep -oE -- '--[a-z][a-z-]+')" -- "$word")
    return
  fi
  case $verb in
    run | explain | plan | submit)
      mapfile -t COMPREPLY < <(compgen -W "$("$1" list --names 2> /dev/null)" -- "$word"; compgen -f -X '!*.toml' -- "$word") ;;
    new) mapfile -t COMPREPLY < <(compgen -W "study solver" -- "$word") ;;
    report | compare | judge | collect) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    solve | reference | cavity-profile) mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word") ;;
  esac
}
complete -o filenames -F _mpm_verify mpm-verify
