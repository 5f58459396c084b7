#!/bin/sh
# Makes the meshes of this folder. Usage: meshes/make.sh [tunica-mesh [verify-quarter-tube]]
set -eu
tool=${1:-tunica-mesh}
quarter=${2:-verify-quarter-tube}
folder=$(dirname "$0")
"$tool" tube "$folder/tube-tiny.h5" --around 12 --axial 18 --media-layers 2 --adventitia-layers 1
"$tool" tube "$folder/tube-medium.h5" --around 16 --axial 40 --media-layers 2 --adventitia-layers 1
"$tool" tube "$folder/tube-coarse.h5" --around 20 --axial 62 --media-layers 3 --adventitia-layers 1
"$tool" block "$folder/block.h5" --patch-x 4 --patch-y 4
flap=$(mktemp --suffix .msh)
python3 "$folder/make_flap.py" "$flap"
"$tool" convert "$flap" "$folder/flap.h5"
rm "$flap"
"$quarter" "$folder/quarter-tube.h5"
