#!/bin/bash
# The layout is that of .clang-format. Versions differ in taste: write what those of Debian 12 (14)
# and of Debian unstable (21) both leave alone, a name for a lambda and no braces behind a space.
# Usage: format.sh CLANG_FORMAT
set -euo pipefail
tool=$1
if ! "$tool" --version; then
  echo "clang-format is missing; on Debian it is in the package clang-format"
  exit 1
fi
if ! find src drivers tests bench examples \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z |
  xargs -0 "$tool" --dry-run --Werror; then
  echo
  echo "These files are not in our layout. This mends them:"
  echo "  find src drivers tests bench examples -name '*.[ch]pp' -exec clang-format -i {} +"
  exit 1
fi
