#!/bin/bash
# The case printed in the README is valid. Usage: readme_case.sh TUNICA_CHECK SCRATCH
set -euo pipefail
check=$1
scratch=$2
mkdir -p "$scratch"
sed -n '/^```xml$/,/^```$/p' README.md | sed '1d;$d' > "$scratch/my-case.xml"
cp meshes/tube-tiny.h5 "$scratch/my-tube.h5"
"$check" "$scratch/my-case.xml"
