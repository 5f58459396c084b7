#!/bin/bash
# The layout is that of .clang-format. Versions differ in taste, so only Debian 12's counts.
# Usage: format.sh CLANG_FORMAT
set -euo pipefail
tool=$1
if ! "$tool" --version 2>/dev/null | grep -q "version 14\."; then
  echo "clang-format 14 is missing; on Debian 12 it is in the package clang-format"
  exit 1
fi
if ! find src drivers tests bench examples \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z |
  xargs -0 "$tool" --dry-run --Werror; then
  echo
  echo "These files are not in our layout. This mends them:"
  echo "  find src drivers tests bench examples -name '*.[ch]pp' -exec clang-format -i {} +"
  exit 1
fi
