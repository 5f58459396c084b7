"""The words of the command line."""
import os
import sys

from command_line import Parser
from importer.raw import BadMesh
from lumen.options import check_ranges, check_target, without_on

from .new_case import files


def make_parser():
    parser = Parser(BadMesh, prog="tunica-mesh adapt", usage="%(prog)s RUN OUT.h5 [options]",
                    description="Makes the mesh of a run anew, with elements where its errors are: in the velocity's gradient, in the "
                                "shear at the wall and in the wall's stress.")
    parser.add_argument("paths", metavar="RUN OUT.h5", nargs="*",
                        help="output folder of a run with fields; and the mesh to write. Beside it are written OUT.xml, the run's case "
                             "on this mesh, which begins where the run ended, and OUT.json")
    add = parser.add_argument
    add("--tetrahedra", type=float, metavar="N", help="how many the mesh is to have, those of the wall included; default: as the run")
    add("--factor", type=float, default=1.0, metavar="F", help="so many times as many; default 1")
    add("--from", dest="start", type=float, metavar="MS",
        help="fields from this time on count, up to the end of the run; default: its \"averages from\"")
    add("--over", choices=("mean", "max"), default="mean", help="what counts of an error over these fields; default mean")
    add("--layers", type=int, metavar="N", help="boundary layers in the lumen; 0: none; default: as many as the shear at the wall asks for")
    add("--growth", type=float, metavar="F", help="thickness of each layer over the one before; default: as the errors ask for")
    add("--surface", metavar="FILE",
        help="the surface that the wall is drawn to, open at the same ends, in mm: .stl, .vtp, .ply, .obj, .vtk, or a mesh of "
             "tunica-mesh lumen; default: the one of which the run's mesh was made, if it is known, or the run's own")
    add("--overwrite", action="store_true", help="replaces OUT.h5, OUT.xml and OUT.json")
    return parser


RANGES = {"tetrahedra": (99, 1e9), "factor": (1e-3, 1e3), "layers": (-1, 21), "growth": (0.5, 4)}


def read(words):
    parser = make_parser()
    options, unknown = parser.parse_known_intermixed_args(without_on(words))
    if unknown:
        parser.refuse(unknown)
    check_ranges(options, RANGES)
    if len(options.paths) != 2:
        raise BadMesh(f"{len(options.paths)} names are given, expected two: RUN OUT.h5. --help says more")
    options.run, options.out = options.paths
    options.programs = os.path.dirname(os.path.abspath(sys.argv[0]))
    if not options.out.endswith(".h5"):
        raise BadMesh(f"{options.out}: expected a name that ends in .h5, Tunica's own format")
    check_target(options.out, files(options.out), options.overwrite)
    return options
