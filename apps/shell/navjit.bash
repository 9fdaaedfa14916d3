# Completion for bash. It asks the command for its help, and so offers what there is.

_navjit() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
  local command=("${COMP_WORDS[0]}") help i
  help=$("${command[@]}" --help 2>/dev/null) || return
  for ((i = 1; i < COMP_CWORD; ++i)); do
    _navjit_subcommands "$help" | grep -qxF -e "${COMP_WORDS[i]}" || continue
    command+=("${COMP_WORDS[i]}")
    help=$("${command[@]}" --help 2>/dev/null) || return
  done
  COMPREPLY=()
  local offers
  case $word in
    -*) offers=$(_navjit_options "$help") ;;
    *)
      offers=$(_navjit_subcommands "$help")
      [[ $before == -* ]] && offers=$(_navjit_values "$help" "$before")
      ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$offers" -- "$word")
}

# -h,--help  ->  -h and --help, a line each
_navjit_options() {
  sed -nE 's/^  (-[^ ]+).*/\1/p' <<<"$1" | tr ',' '\n'
}

_navjit_subcommands() {
  sed -nE '/^Subcommands:/,/^$/ s/^  ([a-z][a-z-]*).*/\1/p' <<<"$1"
}

# The words that an option takes, where it names them: `--cache DIR|off`, `--emit cpp|so`.
_navjit_values() {
  sed -nE 's/^  ([^ ]*,)?'"$2"' ([^ ]+).*/\2/p' <<<"$1" | tr '|' '\n' | grep -E '^[a-z]+$'
}

# Where nothing is offered, bash offers files.
complete -o default -F _navjit navjit navjit_production
