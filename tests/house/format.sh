#!/bin/bash
# The layout is that of .clang-format. Versions differ in taste, so only Debian 12's counts;
# without it the test is skipped. Usage: format.sh CLANG_FORMAT
set -euo pipefail
tool=$1
if ! "$tool" --version 2>/dev/null | grep -q "version 14\."; then
  echo "clang-format 14 is not installed"
  exit 77
fi
bad=0
while IFS= read -r -d '' file; do
  "$tool" --dry-run --Werror "$file" 2>/dev/null || { echo "$file"; bad=$((bad + 1)); }
done < <(find src drivers tests bench examples \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z)
if [ "$bad" -gt 0 ]; then
  echo
  echo "$bad file(s) are not in our layout. This mends them:"
  echo "  find src drivers tests bench examples -name '*.[ch]pp' -exec clang-format -i {} +"
  exit 1
fi
