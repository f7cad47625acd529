#!/bin/sh
# The sources for Highway also compile where it has no vectors at all, as with GCC before 12.3.
#
# usage: check_scalar.sh COMPILER ROOT EIGEN
set -u
compiler=$1
cd "$2" || exit 1
status=0
for source in $(grep -rl --include='*.cpp' --include='*.cxx' 'hwy/foreach_target' Filters Readers); do
  "$compiler" -std=c++17 -fsyntax-only -DHWY_COMPILE_ONLY_SCALAR -DHWY_SHARED_DEFINE -I. -IFilters -isystem "$3" "$source" || status=1
done
exit $status
