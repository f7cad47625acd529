# ./multispectral bench: sourced by the launcher, which gives $root, $build, prepare, build_preset, fail and wrong, and the command's
# arguments as "$@".
#
# Every program Benchmark* of the preset 'bench', every *Peer.py beside this file, and FilterThreads.py where the plugin is
# built, runs once, one after another; bench_table.py lays their times side by side.

output=
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help)
      echo "usage: ./multispectral bench [--output FILE]"
      echo "  --output FILE   the table also as FILE: .json, else CSV"
      exit 0
      ;;
    --output)
      [ $# -ge 2 ] || wrong "bench: --output needs a file"
      output=$2
      shift
      ;;
    --output=*) output=${1#--output=} ;;
    *) wrong "bench: '$1' is no option" ;;
  esac
  shift
done
if [ -n "$output" ]; then
  [ -d "$(dirname "$output")" ] || fail "$output: there is no folder $(dirname "$output")"
fi

prepare run build test measure
build_preset bench all
exec 9>&-
results=$build/bench/results
rm -rf "$results"
mkdir -p "$results" || fail "cannot write to $results"

# run_benchmark NAME COMMAND...: its JSON into $results/NAME.json.
run_benchmark() {
  name=$1
  shift
  echo "Running $name" >&2
  "$@" >"$results/$name.json" 2>"$results/$name.log" || {
    rm -f "$results/$name.json"
    echo "multispectral: note: $name did not run: $(tail -n 1 "$results/$name.log")" >&2
    return 1
  }
}

ran=0
for program in "$build"/bench/Testing/Benchmarks/Benchmark*; do
  [ -f "$program" ] && [ -x "$program" ] || continue
  run_benchmark "$(basename "$program")" "$program" --benchmark_format=json --benchmark_min_time=0.2 && ran=$((ran + 1))
done
[ "$ran" -gt 0 ] || fail "no benchmark ran; the logs are in $results"
# Debian's Python, which python3-spectral and python3-numpy belong to.
for peer in "$root"/Testing/Benchmarks/*Peer.py; do
  run_benchmark "$(basename "$peer" .py)" env PYTHONDONTWRITEBYTECODE=1 OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 /usr/bin/python3 "$peer" || :
done
if [ -f "$package/multispectral/_classes.so" ]; then
  run_benchmark FilterThreads env PYTHONDONTWRITEBYTECODE=1 MULTISPECTRAL_PYTHON="$package" \
    /usr/bin/python3 "$root/Testing/Benchmarks/FilterThreads.py" || :
else
  echo "multispectral: note: the filters with two threads are not measured; ./multispectral setup builds them" >&2
fi
/usr/bin/python3 "$root/Testing/Benchmarks/bench_table.py" "$results" ${output:+"$output"} || fail "the table could not be made"
