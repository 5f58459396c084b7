"""The words of the command line."""
import dataclasses
import os

from command_line import Parser
from importer.raw import BadMesh

ENDINGS = (".h5", ".msh")


def make_parser():
    parser = Parser(BadMesh, prog="tunica-lumen", usage="%(prog)s SURFACE OUT.h5 [options]",
                    description="Makes a mesh of tetrahedra, with boundary layers, of a lumen's surface.")
    parser.add_argument("paths", metavar="SURFACE OUT.h5", nargs="*",
                        help="surface of a lumen, .stl, .vtp, .ply, .obj or .vtk, open at its ends or closed by flat caps; and "
                             "what to write, .h5 or .msh. Beside it OUT.json and OUT.png are written")
    add = parser.add_argument
    add("--scale", type=float, default=1.0, metavar="F", help="factor to mm: 10 for cm, 1000 for m; default 1")
    add("--across", type=float, default=13.0, metavar="N",
        help="elements across each branch, as wide as it is, by the local radius and curvature; default 13")
    add("--size", type=float, metavar="MM", help="of all elements of the wall, instead of --across")
    add("--thinnest", type=float, metavar="MM",
        help="thickness of the thinnest layer of a wall that is to be grown: triangles are at most --flatness times as wide")
    add("--flatness", type=float, default=4.0, metavar="F", help="for --thinnest; default 4")
    add("--layers", type=int, default=3, metavar="N", help="boundary layers; 0: none; default 3")
    add("--first", type=float, default=0.1, metavar="F",
        help="thickness of the layer at the wall, as a part of the local size of elements; default 0.1")
    add("--growth", type=float, default=1.3, metavar="F", help="thickness of each layer over the one before; default 1.3")
    add("--extend", type=float, default=0.0, metavar="R", help="lengthens the ends by so many radii; default 0")
    add("--names", metavar="FILE",
        help='names of openings: lines "name,x,y,z" with a point near each, in the units of SURFACE; or the .mdl or .facenames of '
             "SimVascular, for faces with numbers")
    add("--no-smoothing", action="store_true", help="leaves the surface as it is, but for its ends")
    add("--overwrite", action="store_true", help="replaces OUT, OUT.json and OUT.png")
    return parser


RANGES = {"scale": (0, 1e9), "across": (2, 200), "size": (0, 1e4), "thinnest": (0, 1e3), "flatness": (0.1, 100),
          "layers": (-1, 21), "first": (0, 2.0), "growth": (0.5, 4), "extend": (-1e-9, 100)}


def read(words):
    parser = make_parser()
    options, unknown = parser.parse_known_intermixed_args(without_on(words))
    if unknown:
        parser.refuse(unknown)
    check_ranges(options, RANGES)
    if len(options.paths) != 2:
        raise BadMesh(f"{len(options.paths)} names are given, expected two: SURFACE OUT.h5. --help says more")
    options.surface, options.out = options.paths
    if not options.out.endswith(ENDINGS):
        raise BadMesh(f"{options.out}: expected a name that ends in .h5, Tunica's own format, or in .msh")
    files = beside(options.out)
    check_target(options.out, (options.out, files.json, files.png), options.overwrite)
    return options


def check_ranges(options, ranges):
    for name, (low, high) in ranges.items():
        value = getattr(options, name)
        if value is not None and not low < value < high:
            raise BadMesh(f"--{name} is {value:g}, expected more than {low:g} and less than {high:g}")


def without_on(words):
    """Other commands of tunica-mesh say "--overwrite on"."""
    kept = []
    for word in words:
        if not (kept and kept[-1] == "--overwrite" and word == "on"):
            kept.append(word)
    return kept


@dataclasses.dataclass
class Beside:
    """Names of the files next to the mesh."""
    json: str
    png: str


def beside(out):
    stem = os.path.splitext(out)[0]
    return Beside(stem + ".json", stem + ".png")


def check_target(out, files, overwrite):
    """Before the long work; files: all that is written, out among them."""
    if os.path.isdir(out) or not os.path.isdir(os.path.dirname(os.path.abspath(out))):
        raise BadMesh(f"{out}: cannot be written: there is no such folder, or a folder has this name")
    for path in files:
        if os.path.exists(path) and not overwrite:
            raise BadMesh(f"{path}: is there already. --overwrite replaces it")
