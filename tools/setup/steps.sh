# shellcheck shell=bash
# How the commands report what they do: headings, times, logs. To be sourced, in the project's root.

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

say() { printf '   %s\n' "$*"; }

duration() {
  if (($1 < 60)); then printf '%d s' "$1"; else printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); fi
}

# step HEADING COMMAND...: runs the command below a heading and says how long it took.
step() {
  local heading=$1 begin=$SECONDS
  shift
  printf '== %s\n' "$heading"
  "$@"
  say "done in $(duration $((SECONDS - begin)))"
}

# logged NAME COMMAND...: the output goes to build/log/NAME.log; only if the command fails is its end shown.
# The command runs in the foreground so that Ctrl-C reaches it.
logged() {
  local log=build/log/${1//\//-}.log status=0 watcher
  shift
  mkdir -p build/log
  : >"$log"
  watch_log "$log" &
  watcher=$!
  "$@" >"$log" 2>&1 </dev/null || status=$?
  kill "$watcher" 2>/dev/null || true
  wait "$watcher" 2>/dev/null || true
  clear_line
  if ((status == 0)); then return; fi
  tail -n 40 "$log" >&2
  fail "'$*' ended with status $status; everything it said is in $log"
}

# Shows the last line of a log every second in place, or every half minute where there is no terminal.
watch_log() {
  local begin=$SECONDS shown=0 passed
  while sleep 1 && kill -0 $$ 2>/dev/null; do
    passed=$((SECONDS - begin))
    if [[ -t 1 ]]; then
      clear_line
      printf '   %s' "$(progress "$passed" "$1")"
    elif ((passed - shown >= 30)); then
      shown=$passed
      say "$(progress "$passed" "$1")"
    fi
  done
}

progress() { printf '%s  %.60s' "$(duration "$1")" "$(last_action "$2")"; }

# The last line of a log; of a build's, the last "[3/64] file.cc.o", which warnings may follow.
last_action() {
  awk '
    /^\[[0-9]+\/[0-9]+\]/ {count = split($NF, part, "/"); action = $1 " " part[count]; is_build = 1}
    !is_build {action = $0}
    END {gsub(/\r/, "", action); print action}' "$1"
}

clear_line() { if [[ -t 1 ]]; then printf '\r\e[K'; fi; }
