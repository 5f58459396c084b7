"""The command line."""
import os

from command_line import Parser
from vessel.errors import BadInput
from vessel.options import check_limits

DEFAULT_FOLDER = "certified"


def make_parser(about):
    parser = Parser(BadInput, prog="tunica-certify", description=about, usage="%(prog)s CASE.xml [options]")
    add = parser.add_argument
    add("case", metavar="CASE.xml", help="the case; its numbers are those in the table")
    add("--output", metavar="DIR", default=DEFAULT_FOLDER, help=f"folder of the runs and of the page; it is continued if it exists; "
        f"default {DEFAULT_FOLDER}")
    add("--cores", type=int, metavar="N", default=os.cpu_count() or 1, help="processes at a time; default: all of this machine")
    add("--ranks", type=int, metavar="N", default=1, help="MPI ranks of each run; default 1")
    add("--budget", type=float, metavar="HOURS", help="the runs that can be had in this time on those cores, the most telling ones first")
    add("--levels", type=int, metavar="N", choices=(1, 2, 3), help="meshes: 1 none but that of the case, 2 with h/2, 3 with h/4, too; "
        "default 2, or what --budget permits")
    add("--steps", type=int, metavar="N", choices=(1, 2, 3), help="steps in time: 1, 2 with half of them, 3 with a quarter, too; "
        "default 3")
    add("--smooth", metavar="NAME,...", help="curved surfaces that are smooth: h/2 follows paraboloids through their vertices; cylinders "
        "about the z axis are always followed")
    add("--coarser", metavar="FILE", help="a coarser mesh of the same vessel, with the same names: for meshes of which h/2 is too dear, "
        "and for an observed order")
    add("--finer", metavar="FILE", help="a finer mesh of the same vessel, with the same names, instead of h/2 by refinement: follows a "
        "shape that only its maker knows")
    add("--period", type=float, metavar="MS", help="beat over which means are taken; default: the longest period of a load")
    add("--set", dest="settings", action="append", default=[], metavar="A/b=c", help="sets a key of the case in all runs; may be "
        "repeated")
    add("--fields", metavar="NAME,...", help="arrays of fields.h5 of which the errors at the end are shown; default: velocity, pressure, "
        "displacement, wall_shear_stress, recovered_von_mises; none")
    add("--dry-run", action="store_true", help="say what would be done, how long and how large; do nothing")
    add("--overwrite", action="store_true", help="begin anew, and replace the runs in the folder; without it those of another case or mesh "
        "are refused")
    add("--programs", metavar="DIR", help="folder of the other programs; default: that of this one")
    return parser


def read(about, words=None):
    """The options, checked as far as they need no case."""
    parser = make_parser(about)
    options, unknown = parser.parse_known_args(words)
    if unknown:
        parser.refuse(unknown)
    check_limits(options, {"cores": (0, 10000), "ranks": (0, 10000), "budget": (0, 1e5), "period": (0, 1e9)})
    if options.ranks > options.cores:
        raise BadInput(f"--ranks is {options.ranks}, expected at most --cores, {options.cores}")
    for path in (options.case, options.coarser, options.finer):
        if path is not None and not os.path.isfile(path):
            raise BadInput(f"{path}: there is no such file")
    for setting in options.settings:
        if "=" not in setting:
            raise BadInput(f"--set {setting}: expected List/key=value, such as Fluid/viscosity=4e-3")
    options.coarser, options.finer = (path and os.path.abspath(path) for path in (options.coarser, options.finer))
    return options
