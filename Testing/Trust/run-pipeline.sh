#!/bin/sh
# One whole command under valgrind (memcheck), with the plugin of build/plugin (./multispectral setup):
#   Testing/Trust/run-pipeline.sh [COMMAND OPTIONS...]
# By default `estimate` on the demo's image: reading, patches, calibration, correction, estimate, error maps, writing. Only
# errors with code of ours among the callers count: Python and numpy have some of their own. Exit status 1 where there is
# one; build/valgrind.log has all of them. Takes ten minutes.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
output=$root/build/valgrind
image=$root/Data/Images/demo-fabric
mkdir -p "$output"
[ $# -gt 0 ] || set -- estimate --image "$image"/channel_*.tif --white "$image"/white/*.tif --dark "$image"/dark/*.tif \
  --calibration "$root/Data/Samples/demo-chart.csv" --labels "$image/labels.png" --patches "$image/patches.csv"
command=$1
shift
MULTISPECTRAL_ROOT=$root MULTISPECTRAL_PYTHON=$root/build/plugin/python \
  MULTISPECTRAL_PLUGIN=$root/build/plugin/lib/Multispectral/Multispectral.so \
  PYTHONMALLOC=malloc PYTHONDONTWRITEBYTECODE=1 VTK_SMP_BACKEND_IN_USE=STDThread VTK_SMP_MAX_THREADS=2 \
  valgrind --num-callers=40 --log-file="$root/build/valgrind.log" \
  /usr/bin/python3 "$root/Plugin/Scripts/$command.py" "$@" --output "$output"
# An error is a block of lines between empty ones.
sed 's/^==[0-9]*== \{0,1\}//' "$root/build/valgrind.log" | awk '
  BEGIN { RS = ""; ORS = "\n\n" }
  /multispectral\/_classes|msi::/ && /(at|by) 0x/ { print; found++ }
  END { if (found) exit 1; print "no error below code of this project" }'
