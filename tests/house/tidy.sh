#!/bin/bash
# clang-tidy finds nothing in the sources of these folders; .clang-tidy says what it looks for.
# Usage: tidy.sh CLANG_TIDY BUILD FOLDER...
set -euo pipefail
tool=$1
build=$2
shift 2
if ! "$tool" --version; then
  echo "clang-tidy is missing; on Debian it is in the package clang-tidy"
  exit 1
fi
find "$@" -name '*.cpp' -print0 | sort -z |
  xargs -0 -n 1 -P "$(env -u OMP_NUM_THREADS nproc)" \
    "$tool" -p "$build" --quiet --warnings-as-errors='*' 2> >(grep -v ' warnings generated\.$' >&2)
