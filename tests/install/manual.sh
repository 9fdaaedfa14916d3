#!/usr/bin/env bash
# Each subcommand has a manual page with all its options, and the completion offers them. The command
# without a compiler has a page of its own:
# manual.sh COMMAND PRODUCTION FOLDER_OF_PAGES COMPLETION
set -euo pipefail
command=$1 production=$2 pages=$3
# shellcheck source=/dev/null
source "$4"
pages_seen=0 options_seen=0

fail() {
  echo "$*"
  exit 1
}

# What is offered behind the words of a command line.
offered() {
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)) COMPREPLY=()
  _navjit
  printf '%s\n' "${COMPREPLY[@]}"
}

look_at() {
  local help page option subcommand offers
  help=$("$command" "$@" --help)
  page=$pages/$(IFS=-; echo "navjit${*:+-$*}").1
  [ -f "$page" ] || fail "$page is missing"
  pages_seen=$((pages_seen + 1))
  offers=$(offered "$command" "$@" -)
  for option in $(grep -oE '^ +-[^ ]+' <<<"$help" | tr ',' ' '); do
    grep -qxF -e "$option" <<<"$offers" || fail "$* $option is not offered"
    # Not grep -q: what stops reading early fails who writes.
    sed 's/\\f.//g; s/\\//g' "$page" | grep -E -e "(^|,)$option\>" >/dev/null || fail "$option is not in $page"
    options_seen=$((options_seen + 1))
  done
  for subcommand in $(sed '1,/^Subcommands:/d' <<<"$help" | awk 'NF > 1 && /^  [^ ]/ {print $1}'); do
    offered "$command" "$@" "" | grep -xF "$subcommand" >/dev/null || fail "$* $subcommand is not offered"
    look_at "$@" "$subcommand"
  done
}

look_at
page=$pages/navjit_production.1
[ -f "$page" ] || fail "$page is missing"
for word in navjit_production $("$production" --help | awk '/^  [a-z]/ {print $1}'); do
  sed 's/\\//g' "$page" | grep -F -e "$word" >/dev/null || fail "$word is not in $page"
done
[ $((pages_seen + 1)) = "$(find "$pages" -name '*.1' | wc -l)" ] || fail "there are pages of nothing"
if [ "$pages_seen" -lt 15 ] || [ "$options_seen" -lt 80 ]; then
  fail "only $pages_seen pages and $options_seen options were seen"
fi
