#!/bin/bash
# xml/PARAMETERS.md is what the program prints. Usage: parameters_are_fresh.sh TUNICA_CHECK
set -euo pipefail
if ! diff -u xml/PARAMETERS.md <("$1" --reference); then
  echo
  echo "xml/PARAMETERS.md is stale. This mends it:"
  echo "  $1 --reference > xml/PARAMETERS.md"
  exit 1
fi
