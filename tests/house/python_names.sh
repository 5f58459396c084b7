#!/bin/bash
# Every name in our Python is defined and every import used. A script that makes pages in hours would tell late.
set -euo pipefail
if ! /usr/bin/python3 -m pyflakes --version; then
  echo "pyflakes is missing; on Debian it is in the package python3-pyflakes"
  exit 1
fi
{
  find bench cmake drivers meshes tests xml -name '*.py'
  grep -rlE --exclude='*.*' '^#!/usr/bin/python3' bench cmake drivers meshes xml
} | sort -u | xargs /usr/bin/python3 -m pyflakes
