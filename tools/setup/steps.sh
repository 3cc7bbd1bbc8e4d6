# shellcheck shell=bash
# Progress reports of the commands: headings, times, logs. Source it in the root of the project.

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

say() { printf '   %s\n' "$*"; }

duration() {
  if (($1 < 60)); then printf '%d s' "$1"; else printf '%d min %02d s' $(($1 / 60)) $(($1 % 60)); fi
}

# step HEADING COMMAND...: prints the heading, runs the command, prints its duration.
step() {
  local heading=$1 begin=$SECONDS
  shift
  printf '== %s\n' "$heading"
  "$@"
  say "done in $(duration $((SECONDS - begin)))"
}

# logged NAME COMMAND...: writes the output to build/log/NAME.log, and prints its end if the command fails.
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
  fail "'$*' ended with status $status; the complete output is in $log"
}

# Shows the last line of a log: every second in place, or every half minute without a terminal.
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

# The last line of a log; for a build, the last "[3/64] file.cc.o", even if warnings follow.
last_action() {
  awk '
    /^\[[0-9]+\/[0-9]+\]/ {count = split($NF, part, "/"); action = $1 " " part[count]; is_build = 1}
    !is_build {action = $0}
    END {gsub(/\r/, "", action); print action}' "$1"
}

clear_line() { if [[ -t 1 ]]; then printf '\r\e[K'; fi; }
