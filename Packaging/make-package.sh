# ./multispectral package: sourced by the launcher, which gives $root, $build, prepare, build_preset and fail.
prepare run build package
tree=$build/plugin
[ -f "$tree/build.ninja" ] && set -- || set -- -DBUILD_TESTING=OFF
build_preset plugin Multispectral "$@"
# Made aside, so that an interrupted run leaves no half package.
rm -rf "$build/package.part"
mkdir -p "$build/package.part" || fail "cannot write to $build"
(cd "$tree" && cpack -G DEB -B "$build/package.part") >"$build/package.log" 2>&1 ||
  fail "the package could not be made: $(grep -m1 -i error "$build/package.log"); the log is $build/package.log"
file=$(basename "$build"/package.part/*.deb)
mkdir -p "$build/package" && mv "$build/package.part/$file" "$build/package/$file" || fail "cannot write to $build/package"
rm -rf "$build/package.part"
echo "$build/package/$file"
