# shellcheck shell=bash
# Configures and builds presets, and runs the tests. Needs steps.sh.

readonly MEGABYTES_PER_JOB=2500

# Memory for the compiler: the free memory of the machine, or the limit of the container if that is lower.
available_megabytes() {
  local limit=/sys/fs/cgroup/memory.max
  {
    awk '/^MemAvailable:/ {print int($2 / 1024)}' /proc/meminfo
    if [[ -r $limit ]]; then awk '$1 != "max" {print int($1 / 1048576)}' "$limit"; fi
  } 2>/dev/null | sort -n | head -n 1
}

build_jobs() {
  local processors by_memory megabytes
  processors=$(nproc)
  megabytes=$(available_megabytes) || true
  by_memory=$((${megabytes:-0} / MEGABYTES_PER_JOB))
  if ((by_memory < 1)); then by_memory=1; fi
  printf '%d' $((by_memory < processors ? by_memory : processors))
}

# configure NAME PRESET [CMAKE ARGUMENTS]: shows the warnings; the log has the complete output.
configure() {
  local name=$1
  shift
  logged "configure-$name" cmake --preset "$@"
  sed -n '/^CMake Warning/,/^$/p' "build/log/configure-$name.log"
}

# build NAME [ARGUMENTS]: builds build/NAME.
build() {
  local name=$1
  shift
  logged "build-$name" cmake --build "build/$name" --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(build_jobs)}" "$@"
}

# run_tests NAME [CTEST ARGUMENTS]: runs the tests of build/NAME. Without a terminal, passed tests are not listed.
run_tests() {
  local command=(ctest --test-dir "build/$1" --output-on-failure -j2 "${@:2}")
  if [[ -t 1 ]]; then
    "${command[@]}" --progress
  else
    "${command[@]}" | { grep -vE '^ +Start +[0-9]+:| +Passed +[0-9.]+ sec' || true; }
  fi
}
