#!/bin/sh
# Proves the diagnosis on withheld effects: run-withheld.sh [SEED] [fast|full] [THREADS] [OUTPUT]
# Builds what it needs, writes the cases and, apart, their key, diagnoses without the key, scores.
# With RESUME=1 goes on with the results of a run that was stopped, made by the same version.
set -eu

seed=${1:-2026}
size=${2:-full}
threads=${3:-1}
root=$(cd "$(dirname "$0")/../.." && pwd)
build="$root/build/withheld"
output=${4:-$build/run-$size-$seed}

cmake -S "$root" -B "$build" -G Ninja -DMULTISPECTRAL_FACE=formats -DMULTISPECTRAL_WITHHELD=ON \
  -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF >/dev/null
cmake --build "$build" --target GenerateWithheld DiagnoseWithheld ScoreWithheld
programs="$build/Testing/Withheld"
mkdir -p "$output/sealed"
[ "${RESUME:-0}" = 1 ] || rm -f "$output/diagnoses.csv"
"$programs/GenerateWithheld" "$output/cases" "$output/sealed/key.csv" "$size" "$seed"
"$programs/DiagnoseWithheld" "$output/cases" "$output/diagnoses.csv" "$threads"
"$programs/ScoreWithheld" "$output/sealed/key.csv" "$output/diagnoses.csv" \
  "$output/confusion.svg" | tee "$output/score.txt"
