#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# measure_scale.sh SWEEP_FAKE FOLDER [RUNS...]: the figures of docs/scale.md. Sweeps without a renderer: what is measured is
# planning, storing and merging. Prints for each size: runs, seconds of the processor to plan, to plan and store in ten tasks, and to
# merge these, bytes of the merged store; then the exponents of power laws fitted to them.
set -euo pipefail
readonly sweep=$1 folder=$2
shift 2
(($#)) || set -- 1000 3000 10000 30000 100000
mkdir -p "$folder"
cd "$folder"

# Processor time of a command in seconds, which other work on the machine does not lengthen.
timed() {
  local TIMEFORMAT='%U %S'
  { time "$@" >"$folder/said" 2>"$folder/warned"; } 2>&1 | awk '{ printf "%.3f", $1 + $2 }'
}
measureAll() { # measureAll RUNS
  local task
  for ((task = 1; task <= 10; ++task)); do
    "$sweep" "$1.yaml" --shard "$task/10" --store "$1.$task.sqlite" --no-report --json
  done
}

descriptor() { # descriptor RUNS: 10 scenes x 10 image sizes x RUNS/100 techniques
  awk -v n="$(($1 / 100))" 'BEGIN {
    print "title: scale\nquestion: how long\nscenes: [{name: grid, light_size: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1]}]"
    printf "techniques:\n  - {name: soft/pcss, radius: ["
    for (i = 1; i <= n; ++i) printf "%s%.6g", (i > 1 ? ", " : ""), i / (n + 1)
    print "]}\nimage:"
    for (i = 1; i <= 10; ++i) printf "  - {width: %d, height: 48}\n", 32 + i
  }'
}

for runs; do
  descriptor "$runs" >"$runs.yaml"
  rm -f "$runs".*.sqlite* "$runs".sqlite*
  plan=$(timed "$sweep" "$runs.yaml" --dry-run --shard "1/$runs")
  measure=$(timed measureAll "$runs")
  merge=$(timed "$sweep" merge "$runs.sqlite" "$runs".[0-9]*.sqlite)
  printf '%s %s %s %s %s\n' "$runs" "$plan" "$measure" "$merge" "$(stat -c %s "$runs.sqlite")"
done | tee figures

awk 'function log10(x) { return log(x) / log(10) }
  { for (c = 2; c <= 5; ++c) { x = log10($1); y = log10($c); sx[c] += x; sy[c] += y; sxx[c] += x * x; sxy[c] += x * y } ++n }
  END { split("- plan measure merge bytes", name, " ")
        for (c = 2; c <= 5; ++c) printf "%s grows with runs to the power %.2f\n", name[c], (n * sxy[c] - sx[c] * sy[c]) / (n * sxx[c] - sx[c]^2) }' figures
