#!/bin/sh
# Fuzzing guided by coverage, under AddressSanitizer and UndefinedBehaviorSanitizer:
#   Testing/Fuzz/run-fuzz.sh SECONDS|long [TARGET...]
# Builds all targets (or those named: EnviHeader, SampleTable, ...) with Clang, as the preset 'sanitize' does, and runs each
# for SECONDS; long: 10 million executions or an hour each. New inputs that reach new code are kept in build/fuzz/corpus, so
# that the next run goes on from there; an input that makes a target fail stands in build/fuzz/findings. Exit status 1 where
# one did. Inputs have at most 4096 bytes, or as many as FUZZ_LENGTH says: long ones are few in the same time.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
tree=$root/build/sanitize
build=$root/build/fuzz
case ${1:-} in
  long) limits='-runs=10000000 -max_total_time=3600' ;;
  '' | *[!0-9]*)
    sed -n '2,7s/^# //p' "$0" >&2
    exit 2
    ;;
  *) limits=-max_total_time=$1 ;;
esac
shift
command -v clang++ >/dev/null || {
  echo "run-fuzz.sh: there is no clang++; install the package clang" >&2
  exit 1
}
mkdir -p "$build"
launcher=
command -v ccache >/dev/null 2>&1 && launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
grep -q '^MULTISPECTRAL_FUZZ:BOOL=ON' "$tree/CMakeCache.txt" 2>/dev/null ||
  (cd "$root" && cmake --preset sanitize $launcher) >"$build.log" 2>&1 || {
  echo "run-fuzz.sh: configuring failed; the log is $build.log" >&2
  exit 1
}
[ $# -gt 0 ] || set -- $(cd "$root/Testing/Fuzz/Corpus" && ls)
targets=
for target in "$@"; do
  [ -d "$root/Testing/Fuzz/Corpus/$target" ] || {
    echo "run-fuzz.sh: there is no target '$target'; expected one of" $(ls "$root/Testing/Fuzz/Corpus") >&2
    exit 2
  }
  targets="$targets Fuzz$target"
done
echo "Building$targets"
cmake --build "$tree" --target $targets >"$build.log" 2>&1 || {
  echo "run-fuzz.sh: the build failed; the log is $build.log" >&2
  exit 1
}
mkdir -p "$build/findings"
# A short memory of freed blocks and no traces of where they came from: more executions in the same time.
export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
# Targets that write files write them into memory.
[ ! -w /dev/shm ] || export TMPDIR=/dev/shm
failed=0
printf '%-20s %12s %10s %8s\n' target executions "per second" edges
for target in "$@"; do
  corpus=$build/corpus/$target
  mkdir -p "$corpus"
  log=$build/corpus/$target.log
  status=ok
  "$tree/Testing/Fuzz/Fuzz$target" $limits -max_len="${FUZZ_LENGTH:-4096}" -timeout=10 -rss_limit_mb=2048 \
    -malloc_limit_mb=1024 -print_final_stats=1 -artifact_prefix="$build/findings/$target-" "$corpus" \
    "$root/Testing/Fuzz/Corpus/$target" >"$log" 2>&1 || status=FAILED
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  edges=$(sed -n 's/.* cov: \([0-9]*\).*/\1/p' "$log" | tail -1)
  printf '%-20s %12s %10s %8s\n' "$target" "${executions:-?}" "${rate:-?}" "${edges:-?}"
  if [ "$status" != ok ]; then
    failed=1
    grep -m1 -e 'ERROR' -e 'runtime error' -e 'SUMMARY' "$log" >&2 || true
    echo "run-fuzz.sh: $target failed; the log is $log" >&2
  fi
done
exit $failed
