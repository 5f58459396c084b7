#!/bin/bash
# Every case in xml/ is valid, and so is its mesh. Usage: shipped_cases.sh TUNICA_CHECK
set -uo pipefail
status=0
while IFS= read -r -d '' file; do
  "$1" "$file" > /dev/null || status=1
done < <(find xml -name '*.xml' -print0 | sort -z)
exit $status
