# ./multispectral test: sourced by the launcher, which gives $root, $build, prepare, build_preset and fail, and CTest's
# arguments as "$@".
#
# One ctest runs over the build trees of all faces, so that one summary closes the output. The face 'vtk' joins
# in where the environment variable MULTISPECTRAL_OSMESA names a VTK built with OSMesa (Testing/OSMesa/README.md):
# its folder, or an archive of it.

# require_ctest_options ARGS: ctest itself passes over options that it does not know.
require_ctest_options() {
  known=$(ctest --help) || fail "ctest does not run"
  first=yes
  for argument in "$@"; do
    case $argument in
      -j[0-9]*) option=-j ;;
      -*) option=${argument%%=*} ;;
      *)
        [ -z "$first" ] || wrong "test: '$argument' is no option of ctest"
        continue
        ;;
    esac
    first=
    printf '%s\n' "$known" | grep -q -e "^  .*$option\([ ,=<]\|\$\)" ||
      wrong "test: ctest has no option '$option'"
  done
}

# vtk_prefix PATH: the folder of a VTK, unpacked from an archive where PATH is one.
vtk_prefix() {
  if [ -f "$1" ]; then
    unpacked=$build/osmesa
    if [ ! -e "$unpacked/.complete" ] || [ "$1" -nt "$unpacked/.complete" ]; then
      rm -rf "$unpacked"
      mkdir -p "$unpacked" && tar -xf "$1" -C "$unpacked" && touch "$unpacked/.complete" ||
        fail "$1: cannot be unpacked into $unpacked"
    fi
    set -- "$unpacked"
  fi
  for candidate in "$1" "$1"/*; do
    for config in "$candidate"/lib/cmake/vtk-*/vtk-config.cmake; do
      [ -f "$config" ] && (cd "$candidate" && pwd) && return 0
    done
  done
  fail "MULTISPECTRAL_OSMESA: there is no lib/cmake/vtk-*/vtk-config.cmake in $1"
}

case ${1:-} in
  -h | --help)
    echo "usage: ./multispectral test [CTEST ARGS], for example -R Estimation, -L structure, -j 4"
    exit 0
    ;;
esac
require_ctest_options "$@"
prepare run window build test
faces="plugin sanitize"
build_preset plugin all -DBUILD_TESTING=ON
build_preset sanitize all
if [ -n "${MULTISPECTRAL_OSMESA:-}" ]; then
  prefix=$(vtk_prefix "$MULTISPECTRAL_OSMESA") || exit 1
  build_preset vtk all "-DCMAKE_PREFIX_PATH=$prefix"
  faces="$faces vtk"
else
  echo "Left out: the regression images without a display; MULTISPECTRAL_OSMESA is not set (Testing/OSMesa/README.md)."
fi
exec 9>&-
mkdir -p "$build/test" || fail "cannot write to $build/test"
for face in $faces; do
  printf 'subdirs("%s")\n' "$build/$face"
done >"$build/test/CTestTestfile.cmake"
ctest --test-dir "$build/test" -j "$(nproc)" --output-on-failure "$@"
case $? in
  0) exit 0 ;;
  *) exit 1 ;;
esac
