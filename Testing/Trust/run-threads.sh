#!/bin/sh
# The threaded filters and readers under ThreadSanitizer:
#   Testing/Trust/run-threads.sh [CTEST ARGS]
# Builds the tests of the modules in build/threads and runs them with several threads each. Exit status 1 where two
# threads meet at a datum without order.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/threads
mkdir -p "$build"
launcher=
command -v ccache >/dev/null 2>&1 && launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
cmake -S "$root" -B "$build" -G Ninja -DMULTISPECTRAL_FACE=plugin -DMULTISPECTRAL_PYTHON=OFF -DMULTISPECTRAL_UNITY=ON \
  -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -fsanitize=thread" \
  -DCMAKE_EXE_LINKER_FLAGS=-fsanitize=thread $launcher >"$build/configure.log" 2>&1 || {
  echo "run-threads.sh: configuring failed; the log is $build/configure.log" >&2
  exit 1
}
tests="TestFiltersSampling TestFiltersCalibration TestFiltersColorimetry TestFiltersSimulation TestFiltersDiagnosis TestReaders"
cmake --build "$build" --target $tests >"$build/build.log" 2>&1 || {
  echo "run-threads.sh: the build failed; the log is $build/build.log" >&2
  exit 1
}
# VTK itself is not instrumented: what it does between its own threads is not judged.
TSAN_OPTIONS="suppressions=$root/Testing/Trust/threads-outside.txt halt_on_error=0 exitcode=66 second_deadlock_stack=1" \
  VTK_SMP_BACKEND_IN_USE=STDThread VTK_SMP_MAX_THREADS=4 \
  ctest --test-dir "$build" -R '[.](Filters[A-Z][a-z]*|Readers)[.]' --output-on-failure "$@"
