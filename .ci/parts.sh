# shellcheck shell=bash
# The parts of the verification, one function each, for .ci/run and .ci/nightly. To be sourced in the project's root.
source tools/setup/steps.sh
source tools/setup/packages.sh
source tools/setup/build.sh

readonly SCENE=configs/scenes/cantilever.yaml
readonly PREFIX=$PWD/build/ci/prefix
# Folders of tests of lib and integrators that start no program.
readonly LIBRARY_TESTS=(core config material element linear ode statics material_axes analysis mesh fem contract)

# ensure COMMAND PACKAGE
ensure() { if ! command -v "$1" >/dev/null; then install_packages "$2"; fi; }

# Files changed by the commits of the last day. .ci/run uses them to choose parts.
changed_files() {
  local base
  base=$(git rev-list -1 --before='1 day ago' HEAD 2>/dev/null) || true
  if [[ -n $base ]]; then git diff --name-only --diff-filter=d "$base" HEAD; fi
}

format() {
  ensure clang-format clang-format
  git ls-files '*.cc' '*.h' | xargs clang-format --dry-run -Werror
}

release() { tools/test; }

# Compiles changed sources one by one, without precompiled headers: each must include what it uses.
compile_changed() {
  local sources
  mapfile -t sources < <(changed_files | grep -E '^(lib|integrators|tools/orthodyn)/.*\.cc$' | shuf -n "${1:-30}" |
    sed "s|.*|$PWD/&^|")  # PATH^: the object of this source
  say "${#sources[@]} changed sources"
  if ((${#sources[@]} == 0)); then return; fi
  configure ci-dev dev -B build/ci/dev -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O0 -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
    -D ORTHODYN_TESTS=OFF
  logged build-ci-dev ninja -C build/ci/dev "${sources[@]}"
}

# The release build as others see it: installed, found by find_package, linked, used.
installed() {
  rm -rf "$PREFIX" build/ci/extend build/ci/comparison
  logged install cmake --install build/release --prefix "$PREFIX"
  "$PREFIX/bin/orthodyn" check "$SCENE" >/dev/null
  "$PREFIX/bin/orthodyn" compare configs/comparisons/linear_beam.yaml --out build/ci/comparison
  test -s build/ci/comparison/report.html  # drawn by the installed tool
  extensions
  python_package
}

# The examples of docs/extend.md, as a project outside of this tree.
extensions() {
  logged extend-configure cmake -G Ninja -S docs/extend -B build/ci/extend -D CMAKE_PREFIX_PATH="$PREFIX" \
    -D CMAKE_BUILD_TYPE=Release
  logged extend-build cmake --build build/ci/extend
  build/ci/extend/oscillator_chain
  "$PREFIX/bin/orthodyn" --plugin build/ci/extend/extensions.so run docs/extend/scene.yaml --quiet --force \
    --out build/ci/extended
}

# The Python package as it is installed.
python_package() {
  local script='
import sys, orthodyn
from orthodyn.studies import program
scene = orthodyn.Scene.load(sys.argv[1]).set("time.end", 0.06)
assert len(scene.run(fields=["displacement"]).displacement) > 1
assert program() == sys.argv[2], program()'
  PYTHONPATH=$(echo "$PREFIX"/lib/python3*/site-packages) logged python-installed \
    /usr/bin/python3 -c "$script" "$SCENE" "$PREFIX/bin/orthodyn"
}

# configure_sanitizers [CMAKE ARGUMENTS]: links the test objects of the release build, which are not compiled again. MPI is
# off, because its libraries leak at exit.
configure_sanitizers() {
  ninja -C build/release -t cleandead >/dev/null  # objects of sources that are gone would be linked, too
  configure ci asan -B build/ci/build -D ORTHODYN_GPL=ON -D ORTHODYN_MPI=OFF -D ORTHODYN_BUILT="$PWD/build/release" \
    -D ORTHODYN_PROCESSOR=native -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=8 "$@"
}

library_with_sanitizers() {
  local targets=("${LIBRARY_TESTS[@]/#/orthodyn_}")
  configure_sanitizers -D ORTHODYN_NOT_SANITIZED="simulation;study;cli"
  build ci/build --target "${targets[@]/%/_tests}"
}

# All tests with sanitizers, except tests/problems (accuracy of whole scenes).
with_sanitizers() {
  configure_sanitizers -D ORTHODYN_NOT_SANITIZED=
  build ci/build
  UBSAN_OPTIONS=print_stacktrace=1 run_tests ci/build -E '^(schema|draw|shipped|include_rule|ranks)' --no-tests=error
}

# Uses the folder of the sanitizers' build, so that only files that depend on the option are compiled.
without_gpl() {
  configure ci-without-gpl asan -B build/ci/build -D ORTHODYN_GPL=OFF -D ORTHODYN_CERES=OFF -D ORTHODYN_MPI=OFF \
    -D ORTHODYN_BUILT= \
    -D ORTHODYN_NOT_SANITIZED= -D ORTHODYN_PROCESSOR=native
  build ci/build --target orthodyn_cli orthodyn_linear_tests
  run_tests ci/build -R '^linear' --no-tests=error
  build/ci/build/orthodyn run "$SCENE" --quiet --force --out build/ci/scene
}

# Tests of the release build that every `ctest` leaves out.
nightly_tests() { run_tests release -C nightly -R "$1" --no-tests=error; }
ranks() { nightly_tests '^ranks\.|^(simulation|study)\.nightly$'; }
kills_and_faults() { nightly_tests '^(simulation|study|faults)\.nightly$'; }
estimates() { nightly_tests '^problems\.nightly$'; }
fuzz() { nightly_tests '^fuzz\.nightly$'; }
accuracy() { nightly_tests '^contract\.nightly$'; }
# All pictures and reports, in a browser, too.
drawing() {
  ensure chromium chromium
  ORTHODYN_LONG=1 nightly_tests '^draw\.'
}

# Every scene that is shown, at its full length.
shipped_scenes() { ORTHODYN_LONG=1 nightly_tests '^shipped$'; }

# Instructions of the kernels, against those of tools/bench/instructions.json.
instructions() {
  if grep -qw avx512f /proc/cpuinfo; then
    say "not counted: callgrind cannot run AVX-512"
    return
  fi
  ensure valgrind valgrind
  if [[ ! -e /usr/include/benchmark/benchmark.h ]]; then install_packages libbenchmark-dev; fi
  logged configure-bench cmake -D ORTHODYN_BENCH=ON build/release
  build release --target orthodyn_bench
  tools/bench/instructions.py
  logged configure-bench cmake -D ORTHODYN_BENCH=OFF build/release
}

# Every scene and the notebooks by the Python package.
python_scenes() { ORTHODYN_LONG=1 nightly_tests '^python\.'; }

# Compiles every source by itself.
each_source() {
  configure dev dev -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON -D CMAKE_CXX_FLAGS_RELWITHDEBINFO=-O0
  build dev
}

# bare_system RELEASE NAME: build/ci/NAME as debootstrap makes it. Needs root.
bare_system() {
  ensure debootstrap debootstrap
  mkdir -p build/ci
  if [[ ! -d build/ci/$2/usr ]]; then logged "debootstrap-$2" debootstrap --variant=minbase "$1" "build/ci/$2"; fi
  cp /etc/resolv.conf "build/ci/$2/etc/resolv.conf"
}

# in_system NAME COMMAND...: in its folder /orthodyn.
in_system() {
  local root=$PWD/build/ci/$1
  mount --bind /proc "$root/proc"
  logged "bare-$1" chroot "$root" bash -c "cd /orthodyn && ${*:2}" || { umount "$root/proc"; return 1; }
  umount "$root/proc"
}

# bare_debian RELEASE COMMAND...: in a clone in a system that has nothing but what debootstrap installs.
bare_debian() {
  bare_system "$1" "$1"
  rm -rf "build/ci/$1/orthodyn"
  git clone -q . "build/ci/$1/orthodyn"
  in_system "$1" "${@:2}"
}
debian12() { bare_debian bookworm 'tools/quickstart && tools/test'; }
debian13() {
  bare_debian trixie 'source tools/setup/steps.sh && source tools/setup/packages.sh && source tools/setup/build.sh &&
    ensure_packages && configure release release && build release'
}

# debian_package RELEASE: the package, made in one bare system and used in another.
debian_package() {
  local other=build/ci/$1-installed
  bare_debian "$1" 'tools/package --deb x86-64-v3'
  if mountpoint -q "$other/proc"; then umount "$other/proc"; fi
  rm -rf --one-file-system "$other"
  bare_system "$1" "$1-installed"
  mkdir "$other/orthodyn"
  cp "build/ci/$1/orthodyn/build/"orthodyn_*.deb "$other/orthodyn"
  in_system "$1-installed" 'apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends ./orthodyn_*.deb &&
    orthodyn init scene part.yaml && orthodyn run part.yaml --out part && orthodyn view part && test -s part/view.html'
}
package12() { debian_package bookworm; }
package13() { debian_package trixie; }
