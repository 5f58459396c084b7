#!/bin/bash
# clang-tidy finds nothing in the sources of these folders; .clang-tidy says what it looks for.
# Sources that are compiled together are read together, so that Trilinos' headers are read once for
# six; what it says of such includes, and of names in two of them, is left out. Those that the build
# keeps apart are read one by one.
# Usage: tidy.sh CLANG_TIDY SCRATCH FOLDER...
set -euo pipefail
tool=$1
scratch=$2
shift 2
if ! "$tool" --version; then
  echo "clang-tidy is missing; on Debian it is in the package clang-tidy"
  exit 1
fi
cmake -S . -B "$scratch" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_UNITY_BUILD_BATCH_SIZE=6 -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
sed -i 's/ -fno-ipa-[a-z-]*//g' "$scratch/compile_commands.json"  # GCC's alone

# What is compiled of each folder: a folder may be part of one that stands in the list of sources.
units=$(sed -n 's/^ *"file": "\(.*\)".*/\1/p' "$scratch/compile_commands.json" | sort -u)
together=$(grep '/unity_[0-9]*_cxx\.cxx$' <<<"$units")
chosen=()
for source in $(find "$@" -name '*.cpp'); do
  unit=$(grep -lF "\"$PWD/$source\"" $together || echo "$PWD/$source")
  chosen+=("$unit")
done
printf '%s\n' "${chosen[@]}" | sort -u | tr '\n' '\0' |
  xargs -0 -n 1 -P "$(env -u OMP_NUM_THREADS nproc)" "$tool" -p "$scratch" --quiet \
    --config-file=.clang-tidy --checks=-bugprone-suspicious-include --extra-arg=-Wno-shadow \
    --warnings-as-errors='*' 2> >(grep -v ' warnings generated\.$' >&2)
