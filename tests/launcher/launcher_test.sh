#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# launcher_test.sh SOURCE_TREE: the launcher in a scratch tree, with a package manager and build tools that only note
# what they are asked and whose answers each case chooses.
set -uo pipefail
source_tree=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tree=$scratch/tree tools=$scratch/tools state=$scratch/state
export STATE=$state
failures=0

check() { # check NAME CONDITION...
  local name=$1
  shift
  if "$@"; then
    printf 'ok      %s\n' "$name"
  else
    printf 'FAILED  %s\n  condition: %s\n  exit: %s\n  stdout: %s\n  stderr: %s\n  calls: %s\n' "$name" "$*" "$status" \
      "$(<"$scratch/out")" "$(tail -c 400 "$scratch/err")" "$(calls)"
    failures=$((failures + 1))
  fi
}
run() { # run ARGUMENTS...: the launcher with nothing but the scratch tools; sets status, files out and err
  : >"$state/calls"
  status=0
  (cd "$scratch/elsewhere" && PATH=$tools "$tree/limen" "$@" </dev/null >"$scratch/out" 2>"$scratch/err") || status=$?
}
calls() { cat "$state/calls"; }
called() { grep -q -- "$1" "$state/calls"; }
told() { grep -qF -- "$1" "$scratch/err"; }
is() { [[ $1 == "$2" ]]; }
not() { ! "$@"; }

tool() { # tool NAME: a stand-in whose script is stdin
  rm -f "$tools/$1"
  { printf '#!%s\n' "$(type -P bash)" && cat; } >"$tools/$1"
  chmod +x "$tools/$1"
}
make_tools() {
  mkdir -p "$tools"
  local name
  for name in bash env cat sed grep sort find touch mkdir mv rm tail flock sha256sum readlink paste sleep chmod true tr; do
    ln -sf "$(type -P "$name")" "$tools/$name"
  done
  tool dpkg-query <<'TOOL'
for package in "$@"; do grep -qx -- "$package" "$STATE/installed" && echo "installed $package"; done
exit 1
TOOL
  tool apt-cache <<<'[[ -e $STATE/has_lists ]]'
  tool apt-get <<'TOOL'
echo "apt-get $*" >>"$STATE/calls"
[[ -e $STATE/apt_fails ]] && { echo "E: no such mirror"; exit 100; }
case "$*" in
  *update*) touch "$STATE/has_lists" ;;
  *) [[ -e $STATE/has_lists ]] || exit 100; printf '%s\n' "$@" >>"$STATE/installed" ;;
esac
TOOL
  tool id <<<'cat "$STATE/uid"'
  tool cmake <<'TOOL'
echo "cmake $*" >>"$STATE/calls"
case $1 in
  --list-presets) printf 'Available configure presets:\n\n  "release" - x\n  "asan" - y\n' ;;
  --preset)
    mkdir -p "build/$2/bin"
    echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >"build/$2/CMakeCache.txt"
    [[ " $* " == *" -DLIMEN_TESTS=ON "* ]] && echo "LIMEN_TESTS:BOOL=ON" >>"build/$2/CMakeCache.txt"
    touch "build/$2/build.ninja" ;;
  --build)
    [[ -e $STATE/slow_build ]] && sleep 1
    [[ -e $STATE/build_fails ]] && { echo "error: expected ';'"; exit 1; }
    mkdir -p "$2/bin"
    for name in sweep analyse report; do
      printf '#!%s\n[[ $0$* == *-report*study* ]] && exit 3\necho "%s:$PWD:$*"\necho "${LIMEN_LAUNCHER:-}" >"$STATE/launcher"\nexit 7\n' "$(type -P bash)" $name >"$2/bin/limen-$name"
      chmod +x "$2/bin/limen-$name"
    done ;;
esac
TOOL
  tool ctest <<'TOOL'
echo "ctest $*" >>"$STATE/calls"
echo "100% tests passed"
exit 8
TOOL
}
age() { # makes all of the tree old, but for what was built
  find "$tree" -path "$tree/build" -prune -o -exec touch -d '1 hour ago' {} +
}
make_tree() { # a fresh tree and machine: root, nothing installed, package lists at hand
  rm -rf "$tree" "$state" "$scratch/elsewhere"
  mkdir -p "$tree"/{experiments/{base,descriptors},analysis,tests} "$state" "$scratch/elsewhere"
  cp "$source_tree/limen" "$source_tree/packages.txt" "$tree"
  echo 'project(limen VERSION 9.8.7 LANGUAGES CXX)' >"$tree/CMakeLists.txt"
  echo '{"configurePresets": [{"name": "release"}, {"name": "asan"}]}' >"$tree/CMakePresets.json"
  echo 'add_executable(limen-sweep main.cpp)' >"$tree/experiments/CMakeLists.txt"
  printf 'add_executable(\n  limen-analyse main.cpp)\nadd_executable(limen-report main.cpp)\n' >"$tree/analysis/CMakeLists.txt"
  touch "$tree/experiments/base/text.cpp" "$tree/experiments/base/hash.cpp" "$tree/tests/text_test.cpp"
  age
  : >"$state/installed"
  : >"$state/calls"
  touch "$state/has_lists"
  echo 0 >"$state/uid"
  make_tools
  rm -f "$tools/sudo"
}

make_tree
run sweep a.yaml "b c"
check "a first call installs what programs need" called 'install -y --no-install-recommends g++ cmake'
check "and leaves alone what only tests need" not called chromium
check "it says what is missing and what for" told 'libepoxy-dev         OpenGL and EGL entry points (build)'
check "package lists at hand are not fetched again" not called 'apt-get.*update'
check "it configures the release preset" called 'cmake --preset release'
check "it builds the program and the one that writes its report" called '--target limen-sweep limen-report$'
check "the program gets the arguments and the caller's folder" is "$(<"$scratch/out")" "sweep:$scratch/elsewhere:a.yaml b c"
check "the exit code is the program's" is $status 7
check "the program is told how it was called" is "$(<"$state/launcher")" 1

run sweep
check "a second call asks nothing of anybody" is "$(calls)" ""
check "and says nothing of its own" is "$(<"$scratch/err")" ""
for ((i = 0; i < 400; ++i)); do : >"$tree/experiments/base/file$i.cpp"; done
age
best=1000000
for _ in 1 2 3 4 5; do
  start=${EPOCHREALTIME/./}
  run sweep
  took=$((${EPOCHREALTIME/./} - start))
  ((took < best)) && best=$took
done
check "a call with nothing to do costs less than 0.3 s ($((best / 1000)) ms)" test $best -lt 300000

touch "$tree/experiments/base/text.cpp"
run sweep
check "a changed source is built" called '--target limen-sweep'
check "without configuring again" not called '--preset'
age
rm "$tree/build/release/bin/limen-report"
run sweep
check "a sweep without its report's program builds it" called '--target limen-sweep limen-report$'
run analyse
check "analyse is built alone" called '--target limen-analyse$'
age
rm "$tree/experiments/base/hash.cpp"
run sweep
check "a deleted source is noticed" called '--target limen-sweep'
age
touch "$tree/experiments/descriptors/mine.yaml" "$tree/tests/text_test.cpp"
run sweep
check "descriptors and tests are no part of a program" is "$(calls)" ""
touch "$tree/packages.txt"
echo "newlib-dev build a new library" >>"$tree/packages.txt"
run sweep
check "a package that joins the list is installed" called 'recommends newlib-dev$'

run report store.sqlite
check "the report of a sweep is written by the small program" is "$(<"$scratch/out")" "report:$scratch/elsewhere:store.sqlite"
run report study.sqlite
check "that of a study by analyse report" is "$(<"$scratch/out")" "analyse:$scratch/elsewhere:report study.sqlite"
run help sweep
check "help of a command is that of its program" is "$(<"$scratch/out")" "sweep:$scratch/elsewhere:--help"
run submit a.yaml --array 4
check "a command without a program of its own is handed to the one it belongs to" \
  is "$(<"$scratch/out")" "sweep:$scratch/elsewhere:submit a.yaml --array 4"
run view
check "a program that this version lacks is named, with those it has" told "no 'view'; it has: sweep submit status analyse report test"
check "and is bad input" is $status 2
run sweeep
check "an unknown command is bad input" is $status 2
check "and the nearest one is named, with those there are" told "did you mean 'sweep'? commands: sweep submit status analyse report test"
run reprot
check "swapped letters are one mistake" told "did you mean 'report'?"
run xylophone
check "a word unlike any is not guessed" not told "did you mean"
run --help
check "help names the commands that this version has" grep -q '^  sweep ' "$scratch/out"
check "and none that it lacks" not grep -qE '^  (view|study) |benchmark' "$scratch/out"
run --version
check "the version is the project's" is "$(<"$scratch/out")" "limen 9.8.7"
mkdir -p "$scratch/decoy/tree"
(cd "$scratch" && CDPATH=$scratch/decoy PATH=$tools tree/limen --version >"$scratch/out" 2>"$scratch/err")
check "wherever CDPATH points" is "$(<"$scratch/out")" "limen 9.8.7"

run test -L unit
check "test installs what tests need" called chromium
check "test configures with tests, in the same folder" called 'cmake --preset release -DLIMEN_TESTS=ON'
check "test builds everything" called '--target all'
check "arguments reach ctest" called "^ctest --test-dir $tree/build/release .* -L unit$"
check "the exit code is ctest's" is $status 8
age
run test
check "a second test call only tests" is "$(calls | cut -d' ' -f1)" ctest
run sweep
check "after tests a program is built without configuring" not called '--preset'
run test --sanitize
check "sanitizers have a build of their own" called 'cmake --preset asan -DLIMEN_TESTS=ON'

make_tree
rm "$state/has_lists"
run sweep
check "missing package lists are fetched first" is "$(calls | grep -c apt-get)" 2
make_tree
touch "$state/apt_fails"
run sweep
check "a failed installation ends the call" is $status 1
check "with the package manager's words" told 'E: no such mirror'
check "and builds nothing" not called ^cmake

make_tree
echo 1000 >"$state/uid"
run sweep
check "without root and sudo the command to run is printed" told 'apt-get install --no-install-recommends g++ cmake'
check "and nothing is tried" is "$(calls):$status" ":2"
tool sudo <<'TOOL'
[[ $1 == -n ]] && shift
echo "sudo $1" >>"$STATE/calls"
exec "$@"
TOOL
run sweep
check "with sudo packages are installed through it" called '^sudo env'
check "and the program runs" is $status 7

make_tree
rm "$tools/apt-get" "$tools/dpkg-query"
run sweep
check "a system without apt gets the list of what is needed" told 'libembree-dev'
check "and is refused" is "$(calls):$status" ":2"
export LIMEN_PACKAGES=skip
run sweep
check "unless its user has seen to the packages" is $status 7
unset LIMEN_PACKAGES

make_tree
touch "$state/build_fails"
run sweep
check "a failed build is told with its last lines" told "error: expected ';'"
check "with the log's path" told "$tree/build/release/build.log"
check "and is a failure" is $status 1
rm "$state/build_fails"
run sweep
check "the next call builds" is $status 7

make_tree
touch "$state/slow_build"
run sweep &
sleep 0.4
(cd "$scratch" && PATH=$tools "$tree/limen" sweep >"$scratch/out2" 2>"$scratch/err2")
wait
check "a call during another's build waits" grep -q 'waiting' "$scratch/err2"
check "and builds nothing twice" is "$(calls | grep -c -- --build)" 1
check "and runs" grep -q '^sweep:' "$scratch/out2"

mv "$tree" "$scratch/moved"
tree=$scratch/moved
run sweep
check "a moved tree is configured afresh" called 'cmake --preset release --fresh'
export LIMEN_PRESET=fastest
run sweep
check "an unknown preset is refused with those there are" told "known: release asan"
unset LIMEN_PRESET

if ((failures)); then printf '%d checks failed\n' "$failures"; fi
exit $((failures > 0))
