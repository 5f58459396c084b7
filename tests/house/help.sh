#!/bin/bash
# Every driver answers --help, and a misspelt option with the nearest name. Usage: help.sh BIN
set -uo pipefail
bin=$1
status=0

complain() {
  echo "$1"
  status=1
}

answers_help() {
  local text
  text=$("$@" --help 2>&1) || complain "$* --help: exit status $?, expected 0"
  [ "$(wc -l <<<"$text")" -ge 3 ] || complain "$* --help says too little: $text"
}

# corrects EXPECTED WORDS...: the words are refused with exit status 1, naming what was meant.
corrects() {
  local expected=$1 text code
  shift
  text=$("$@" 2>&1)
  code=$?
  [ $code -eq 1 ] || complain "$*: exit status $code, expected 1"
  grep -qF "Did you mean \"$expected\"?" <<<"$text" || complain "$*: does not name $expected: $text"
}

for program in "$bin"/tunica-*; do
  answers_help "$program"
  case $(basename "$program") in
    tunica-mesh)
      corrects tube "$program" tub
      corrects --around "$program" tube never-written.h5 --aroun 20
      for command in tube block lumen adapt wall info refine convert partition; do answers_help "$program" "$command"; done
      ;;
    tunica-adapt) corrects --factor "$program" never-read never-written.h5 --facto 2 ;;
    tunica-certify) corrects --budget "$program" never-read.xml --budgte 2 ;;
    tunica-import) corrects --scale "$program" never-read.vtu never-written.h5 --scal 2 ;;
    tunica-lumen) corrects --across "$program" never-read.stl never-written.h5 --acros 9 ;;
    tunica-report) corrects --magnify "$program" . --magnifi 2 ;;
    tunica-vessel) corrects --pressure "$program" never-read.stl --output never-made --presure 120/80 ;;
    *) corrects --steps "$program" never-read.xml --stesp 2 ;;
  esac
done
exit $status
