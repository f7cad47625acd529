#!/bin/sh
# Fails where clang-format would change a file. usage: check_format.sh CLANG_FORMAT ROOT
set -u
formatter=$1
cd "$2" || exit 1
# Another version formats otherwise.
case $("$formatter" --version) in
  *"version 14."*) ;;
  *)
    echo "skipped: .clang-format is written for clang-format 14, this is $("$formatter" --version)"
    exit 77
    ;;
esac
count=$(find Filters Readers Plugin Testing \( -name '*.h' -o -name '*.cpp' -o -name '*.cxx' \) | wc -l)
[ "$count" -gt 0 ] || {
  echo "no sources found in $2"
  exit 1
}
echo "$count files"
find Filters Readers Plugin Testing \( -name '*.h' -o -name '*.cpp' -o -name '*.cxx' \) -print0 |
  xargs -0 -n 20 -P 2 "$formatter" --dry-run -Werror
