#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Debian package of a build, unpacked into a folder: programs run there without the source tree, and completion, manual
# pages and files of the package are what they say. package_test.sh SOURCE BUILD
set -euo pipefail
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
check() { # WORDS COMMAND...
  local words=$1
  shift
  if "$@" >"$folder/out" 2>&1; then return; fi
  echo "FAILED: $words: $*"
  tail -n 5 "$folder/out"
  failures=$((failures + 1))
}

(cd "$build" && cpack -G DEB -B "$folder/packages" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip) >"$folder/cpack.log" 2>&1 || {
  tail -n 20 "$folder/cpack.log"
  exit 1
}
package=("$folder"/packages/limen_*.deb)
dpkg-deb -x "${package[0]}" "$folder/root"
bin=$folder/root/usr/bin

# What the programs were built from is hidden where the machine allows that.
hidden=()
if unshare --mount true 2>/dev/null; then
  mkdir "$folder/empty"
  hidden=(unshare --mount bash -c 'mount --bind "$1" "$2" && cd "$3" && shift 3 && exec "$@"' bash "$folder/empty" "$source" "$folder")
fi
cd "$folder"
check "an installed program finds its features" "${hidden[@]}" "$bin/limen" sweep --features
cp "$source/experiments/descriptors/quick.yaml" .
check "an installed program measures and reports" "${hidden[@]}" "$bin/limen" sweep quick.yaml
check "a report is written" test -s results/quick_report/report.html
check "shipped examples of studies are found" "${hidden[@]}" "$bin/limen" study example --list
"$bin/limen" help >help.txt
check "an installed version builds nothing" bash -c '! grep -E "LIMEN_PRESET|^  test " help.txt'
code=0
"$bin/limen" test >/dev/null 2>&1 || code=$?
check "an installed version has no tests" test "$code" = 2

for name in limen limen-sweep limen-view limen-perceive limen-study limen-analyse limen-report limen-export; do
  check "a manual page of $name" gzip -t "root/usr/share/man/man1/$name.1.gz"
done
zcat root/usr/share/man/man1/limen-sweep.1.gz >page.txt
check "a manual page has the options that the program prints" grep -q 'fail' page.txt
dpkg-deb -f "${package[0]}" Depends >depends.txt
check "libraries are among what a package depends on" grep -q libopenimageio depends.txt
check "and so is what programs start" grep -q gnuplot-nox depends.txt

# complete WORDS...: what bash offers for the last of them.
complete_words() {
  PATH=$bin:$PATH bash -c 'complete() { :; }; compopt() { :; }; source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _limen
                           printf "%s\n" "${COMPREPLY[@]}"' bash root/usr/share/bash-completion/completions/limen "$@"
}
complete_words limen sw >commands.txt
check "commands are completed" grep -qx sweep commands.txt
complete_words limen sweep --sh >options.txt
check "options are completed" grep -qx -e --shard options.txt
complete_words limen sweep --list soft_shadows/bit >names.txt
check "names of techniques are completed" grep -qx soft_shadows/bitmask names.txt
touch 'a file with spaces.yaml'
complete_words limen sweep 'a fi' >files.txt
check "files are completed whole" grep -qx 'a file with spaces.yaml' files.txt

if ((failures)); then
  echo "$failures checks failed"
  exit 1
fi
echo "package: all checks passed"
