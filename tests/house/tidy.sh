#!/bin/bash
# clang-tidy finds nothing in the sources of these folders; .clang-tidy says what it looks for.
# Files are read as they are compiled one by one: where some are compiled together the build does
# not know them by name, and flags would be guessed.
# Usage: tidy.sh CLANG_TIDY SCRATCH FOLDER...
set -euo pipefail
tool=$1
scratch=$2
shift 2
if ! "$tool" --version; then
  echo "clang-tidy is missing; on Debian it is in the package clang-tidy"
  exit 1
fi
cmake -S . -B "$scratch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=OFF \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
sed -i 's/ -fno-ipa-[a-z-]*//g' "$scratch/compile_commands.json"  # GCC's alone
find "$@" -name '*.cpp' -print0 | sort -z |
  xargs -0 -n 1 -P "$(env -u OMP_NUM_THREADS nproc)" \
    "$tool" -p "$scratch" --quiet --warnings-as-errors='*' 2> >(grep -v ' warnings generated\.$' >&2)
