#!/bin/sh
# Makes the meshes of this folder. Usage: meshes/make.sh [tunica-mesh [verify-quarter-tube]]
set -eu
tool=${1:-tunica-mesh}
quarter=${2:-verify-quarter-tube}
folder=$(dirname "$0")
"$tool" tube "$folder/tube-tiny.h5" --around 12 --axial 18 --media-layers 2 --adventitia-layers 1 --overwrite on
"$tool" tube "$folder/tube-medium.h5" --around 16 --axial 40 --media-layers 2 --adventitia-layers 1 --overwrite on
"$tool" tube "$folder/tube-coarse.h5" --around 20 --axial 62 --media-layers 3 --adventitia-layers 1 --overwrite on
"$tool" block "$folder/block.h5" --patch-x 4 --patch-y 4 --overwrite on
flap=$(mktemp --suffix .msh)
python3 "$folder/make_flap.py" "$flap"
"$tool" convert "$flap" "$folder/flap.h5" --overwrite on
rm "$flap"
plain=$(mktemp --suffix .msh)
python3 "$folder/make_obstacle.py" "$plain" "$folder/../xml/benchmarks/obstacle-inlet.csv"
"$tool" convert "$plain" "$folder/obstacle.h5" --overwrite on
python3 "$folder/make_ring.py" "$plain"
"$tool" convert "$plain" "$folder/ring.h5" --overwrite on
python3 "$folder/make_elastic_tube.py" "$plain"
"$tool" convert "$plain" "$folder/elastic-tube.h5" --overwrite on
python3 "$folder/make_collapsible_channel.py" "$plain"
"$tool" convert "$plain" "$folder/collapsible-channel.h5" --overwrite on
python3 "$folder/make_nozzle.py" "$plain"
"$tool" convert "$plain" "$folder/nozzle.h5" --overwrite on
python3 "$folder/make_cylinder.py" "$plain" "$folder/../xml/benchmarks/cylinder-inlet.csv"
"$tool" convert "$plain" "$folder/cylinder.h5" --overwrite on
rm "$plain"
tube=$(mktemp --suffix .h5)
"$tool" tube "$tube" --radius 5 --length 50 --around 16 --axial 32 --rings 5 --ring-grading 0.15 --wall off --overwrite on
"$tool" wall "$tube" "$folder/pressure-pulse.h5" --surfaces interface --layers media=1:2 --overwrite on
rm "$tube"
"$quarter" "$folder/quarter-tube.h5"

# Planes and lumens by Gmsh, slabs and walls by tunica-mesh. Another version of Gmsh makes other elements.
if ! python3 -c "import gmsh" 2>/dev/null; then
  echo "make.sh: without python3-gmsh turek-hron.h5, silicone-flap.h5 and the meshes of vessels stay as they are"
  exit 0
fi
lumen=$(mktemp --suffix .msh)
trap 'rm -f "$lumen"' EXIT
python3 "$folder/make_turek_hron.py" "$lumen"
"$tool" slab "$lumen" "$folder/turek-hron.h5" --thickness 5 --overwrite on
python3 "$folder/make_silicone_flap.py" "$lumen" 0.5
"$tool" convert "$lumen" "$folder/silicone-flap.h5" --overwrite on
python3 "$folder/make_bend.py" "$lumen"
"$tool" wall "$lumen" "$folder/bend.h5" --layers media=0.3:2,adventitia=0.15:1 --overwrite on
python3 "$folder/make_bulge.py" "$lumen"
"$tool" wall "$lumen" "$folder/bulge.h5" --layers media=0.3:2,adventitia=0.15:1 --overwrite on
python3 "$folder/make_bifurcation.py" "$lumen"
"$tool" wall "$lumen" "$folder/bifurcation.h5" --surfaces interface --layers media=0.3:2,adventitia=0.15:1 --overwrite on
python3 "$folder/make_vessel.py" arch "$lumen" --size 4
"$tool" wall "$lumen" "$folder/arch.h5" --layers media=0.66:1,adventitia=0.34:1 --thickness-fraction 0.15 --overwrite on
python3 "$folder/make_vessel.py" carotid "$lumen" --size 1.5
"$tool" wall "$lumen" "$folder/carotid.h5" --layers media=0.66:1,adventitia=0.34:1 --thickness-fraction 0.2 --overwrite on

# Of a surface with the steps of its voxels, with a thin layer of elements in the lumen, as tunica-vessel has it.
surface=$(mktemp --suffix .stl)
openings=$(mktemp --suffix .csv)
layered=$(mktemp --suffix .h5)
trap 'rm -f "$lumen" "$surface" "$openings" "$layered" "${layered%.h5}.json" "${layered%.h5}.png"' EXIT
python3 "$folder/make_vessel.py" arch "$surface" --raw on
printf '%s\n' inlet,-25,3.9,10.4 outlet_descending,18.2,12.8,-30.8 outlet_brachiocephalic,-28.3,-7.1,89.5 \
  outlet_subclavian,29.7,12.4,88.3 outlet_carotid,-1.2,-5.8,97.9 > "$openings"
"$tool" lumen "$surface" "$layered" --across 4 --layers 1 --first 0.2 --names "$openings" --overwrite
"$tool" wall "$layered" "$folder/aorta.h5" --surfaces lumen_wall --layers media=0.666667:1,adventitia=0.333333:1 \
  --thickness-fraction 0.15 --overwrite on
