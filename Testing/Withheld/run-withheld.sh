#!/bin/sh
# Judges the diagnosis on cases whose effects it is not told: run-withheld.sh [small|full] [SEED] [SETS] [ENGINE]
#   SETS    of "bench second cameras curved next images developed spotted scenes raw linearised careless ridge chart", default all: a virtual
#           bench; a second generator that shares nothing with the first; a third one, in Python, with cameras of 3 to 30
#           channels and other lamps; such cameras with curved detectors, fitted as linear; those of "cameras" for which a next
#           capture is recommended, together with that capture (the column "open" has them without); image pairs; the same with
#           noise that neighbours share and noise in the simulated image, and with hot pixels and highlights; others, in Python,
#           of 3 to 12 channels; effects planted in real measurements: as they are, after every channel was made linear, these
#           with rounded and with wrong readings and labels, with the camera fitted by ridge regression, and of a filter-wheel camera.
#           cameras, curved, raw, linearised, careless, ridge and chart need MULTISPECTRAL_DATA, next needs cameras, scenes has
#           photographs where it is set
#   ENGINE  a diagnosis known to Diagnose/Engines.cpp, default "present"
# Builds what it needs, writes the cases and, apart, their keys, diagnoses without the keys, prints all sets side by side.
# THREADS=2: cases at a time. RESUME=1 goes on with the results of a run that was stopped, made by the same version.
set -eu

size=${1:-small}
seed=${2:-2026}
sets=${3:-bench second cameras curved next images developed spotted scenes raw linearised careless ridge chart}
engine=${4:-present}
root=$(cd "$(dirname "$0")/../.." && pwd)
build="$root/build/withheld"
output="$build/run-$size-$seed"

cmake -S "$root" -B "$build" -G Ninja -DMULTISPECTRAL_FACE=formats -DMULTISPECTRAL_WITHHELD=ON \
  -DCMAKE_BUILD_TYPE=Release -DMULTISPECTRAL_UNITY=ON -DBUILD_TESTING=OFF >/dev/null
cmake --build "$build" --target GenerateWithheld DiagnoseWithheld ScoreWithheld
programs="$build/Testing/Withheld"
mkdir -p "$output/sealed"
scored=
for set in $sets; do
  key="$output/sealed/$set.csv"
  result="$output/$set-$engine.csv"
  if ! { [ "${RESUME:-0}" = 1 ] && [ -s "$key" ]; }; then
    case $set in
      cameras) /usr/bin/python3 "$root/Testing/Withheld/Cameras/cameras.py" "$output/$set" "$key" "$size" "$seed" ;;
      curved) /usr/bin/python3 "$root/Testing/Withheld/Cameras/cameras.py" "$output/$set" "$key" "$size" "$seed" curved ;;
      next) rm -rf "${output:?}/$set" # captures of another version's recommendations
        /usr/bin/python3 "$root/Testing/Withheld/Cameras/cameras.py" "$output/$set" "$key" "$size" "$seed" "$output/cameras-$engine.csv" ;;
      scenes) /usr/bin/python3 "$root/Testing/Withheld/Scenes/scenes.py" "$output/$set" "$key" "$size" "$seed" ;;
      *) "$programs/GenerateWithheld" "$set" "$output/$set" "$key" "$size" "$seed" ;;
    esac
  fi
  [ "${RESUME:-0}" = 1 ] || rm -f "$result"
  "$programs/DiagnoseWithheld" "$output/$set" "$result" "${THREADS:-1}" "$engine"
  [ "$set" != next ] || scored="$scored open $key $output/cameras-$engine.csv"
  scored="$scored $set $key $result"
done
# shellcheck disable=SC2086
"$programs/ScoreWithheld" --failures $scored | tee "$output/score-$engine.txt"
