#!/usr/bin/env bash
# Runs every fuzz target from its corpus: tests/fuzz/run.sh BUILD [LENGTH] [FOLDER FOR WHAT IS FOUND]
# The length is an option of libFuzzer: -max_total_time=SECONDS, with another seed in each run, or -runs=INPUTS, the same
# inputs in every run. A failure leaves its input beside the new inputs, and ends the run with an error.
set -euo pipefail
build=$(realpath "$1")
length=${2:--max_total_time=20}
found=${3:-$build/found}
corpus=$(dirname "$(realpath "$0")")/corpus
targets=("$build"/tests/fuzz/fuzz_*)
[[ -x ${targets[0]} ]] || { echo "no fuzz targets in $build: cmake --build --preset fuzz"; exit 1; }
seed=$((RANDOM + 1))
if [[ $length == -runs=* ]]; then seed=1; fi
feed() {
  local target=$1 name longest
  name=$(basename "$target") && name=${name#fuzz_}
  if [[ $length == -runs=* ]]; then rm -rf "${found:?}/$name"; fi # what an earlier run found
  mkdir -p "$found/$name"
  # Bytes are few: a robot takes 130, a certificate with a tree some thousands.
  longest=256
  if [[ $name == certificate ]]; then longest=2500; fi
  "$target" -seed="$seed" "$length" -timeout=120 -rss_limit_mb=2000 -max_len=$longest -print_final_stats=1 \
    -artifact_prefix="$found/$name-" "$found/$name" "$corpus/$name" >"$found/$name.log" 2>&1 || {
    tail -n 40 "$found/$name.log"
    echo "fuzz target $name failed: its input is $found/$name-*"
    return 1
  }
  awk -v name="$name, seed $seed" '
    /stat::number_of_executed_units/ { runs = $2 }
    /stat::average_exec_per_sec/ { speed = $2 }
    END { printf "%s: %d inputs, %d a second, nothing found\n", name, runs, speed }' "$found/$name.log"
}
# Two targets at a time: each takes one core.
running=()
for target in "${targets[@]}"; do
  if ((${#running[@]} == 2)); then
    wait "${running[0]}"
    running=("${running[1]}")
  fi
  feed "$target" &
  running+=($!)
done
for feeder in "${running[@]}"; do wait "$feeder"; done
