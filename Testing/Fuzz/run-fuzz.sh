#!/bin/sh
# Fuzzing guided by coverage, under AddressSanitizer and UndefinedBehaviorSanitizer:
#   Testing/Fuzz/run-fuzz.sh SECONDS [TARGET...]
# Builds all targets (or those named: EnviHeader, SampleTable, ...) with Clang into build/fuzz and runs each for SECONDS.
# New inputs that reach new code are kept in build/fuzz/corpus, so that the next run goes on from there; an input that
# makes a target fail stands in build/fuzz/findings. Exit status 1 where one did.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$root/build/fuzz
case ${1:-} in
  '' | *[!0-9]*)
    sed -n '2,6s/^# //p' "$0" >&2
    exit 2
    ;;
esac
seconds=$1
shift
command -v clang++ >/dev/null || {
  echo "run-fuzz.sh: there is no clang++; install the package clang" >&2
  exit 1
}
mkdir -p "$build"
launcher=
command -v ccache >/dev/null 2>&1 && launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
[ -f "$build/build.ninja" ] || cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ $launcher \
  -DMULTISPECTRAL_FACE=formats -DMULTISPECTRAL_FUZZ=ON -DMULTISPECTRAL_SANITIZE=ON -DBUILD_TESTING=OFF \
  "-DMULTISPECTRAL_KERNEL_ROOMS=Spectra;Camera" >"$build.log" 2>&1 || {
  rm -f "$build/build.ninja"
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
ninja -C "$build" $targets >"$build.log" 2>&1 || {
  echo "run-fuzz.sh: the build failed; the log is $build.log" >&2
  exit 1
}
mkdir -p "$build/findings"
failed=0
printf '%-20s %12s %10s %8s\n' target executions "per second" edges
for target in "$@"; do
  corpus=$build/corpus/$target
  mkdir -p "$corpus"
  log=$build/corpus/$target.log
  status=ok
  "$build/Testing/Fuzz/Fuzz$target" -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=2048 \
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
