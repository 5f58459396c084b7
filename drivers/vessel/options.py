"""The command line. Every option belongs to the stage that reads it first."""
import os

from command_line import Parser

from .errors import BadInput, nearest
from .presets import PRESETS

STAGES = ("mesh", "wall", "tune", "case", "run", "report")
# The first stage whose result an option changes. Options that are not here change no result.
STAGE_OF = {"lumen": "mesh", "scale": "mesh", "across": "mesh", "size": "mesh", "layers": "mesh",
            "lumen_wall": "mesh", "inlet": "mesh", "wall": "wall", "thickness": "wall", "tissue": "wall",
            "wall_elements": "wall", "pressure": "tune", "flow": "tune", "mean_flow": "tune", "heart_rate": "tune",
            "splits": "tune", "proximal": "tune", "start_from": "tune", "profile": "case", "step": "case",
            "ends": "case", "beats": "run", "tolerance": "run", "pdf": "report"}
FREE = ("beats",)  # more of them continue what there is


def add_physics(parser):
    add = parser.add_argument
    add("--pressure", metavar="S/D", default="120/80", help="pressure at the inlet, systolic/diastolic, mmHg; default 120/80")
    add("--flow", metavar="L/MIN|FILE", help="mean flow into the vessel in l/min, or a file with time and flow in each "
        "line (ms and ml/s, unless a heading names s, l/min, ...) over one beat; default: usual for --wall")
    add("--mean-flow", type=float, metavar="L/MIN", help="scales the flow of a file to this mean")
    add("--heart-rate", type=float, metavar="BPM", help="beats per minute; default 75, or what the file of --flow spans")
    add("--inlet", metavar="NAME", help="opening into which blood flows; default: the largest one")
    add("--splits", metavar="NAME=SHARE,...", help="share of the mean flow that leaves through an outlet; the others "
        "divide the rest by Murray's law, the cube of the radius, as all do by default")
    add("--proximal", type=float, metavar="SHARE", default=0.08,
        help="largest share of the proximal in the whole resistance of an outlet; default 0.08")
    add("--wall", metavar="KIND|FILE", default="aorta",
        help=f"wall: {', '.join(PRESETS)}, or a file of one's own; default aorta")
    add("--thickness", type=float, metavar="SHARE",
        help="thickness of the wall as a share of the local radius; default: of --wall")
    add("--tissue", type=float, metavar="KPA/MM", help="stiffness of the tissue around the wall; default: of --wall")
    add("--ends", choices=("slide", "clamped"), default="clamped",
        help="ends of the wall: clamped, or they slide in their planes; default clamped")
    add("--profile", choices=("womersley", "parabolic", "flat"), default="womersley",
        help="velocity profile of the inflow; default womersley")


def add_numerics(parser):
    add = parser.add_argument
    add("--scale", type=float, metavar="F", help="of a surface: factor to mm, 10 for cm")
    add("--across", type=float, metavar="N",
        help="of a surface: elements across each branch; default: that of tunica-mesh lumen, 13")
    add("--size", type=float, metavar="MM", help="of a surface: edge of the triangles, instead of --across")
    add("--layers", type=int, metavar="N",
        help="of a surface: thin layers of elements at the wall; default: that of tunica-mesh lumen")
    add("--lumen-wall", metavar="NAME", default="lumen_wall",
        help="of a mesh: its surface on which the wall grows; default lumen_wall")
    add("--wall-elements", type=int, metavar="N", help="elements through the wall; default: three or more, as suits the lumen")
    add("--step", type=float, metavar="MS", default=5.0, help="largest time step; the beat has a whole number of them; default 5")
    add("--start-from", metavar="DIR", help="begins where the beats in another folder of tunica-vessel ended, of the same vessel on "
        "another, coarser mesh: with its Windkessels and its state")
    add("--beats", type=int, metavar="N", default=8, help="most beats to compute; default 8")
    add("--tolerance", type=float, metavar="SHARE", default=0.05, help="of pressures and splits against the goals; default 0.05")
    add("--pdf", action="store_const", const=True, help="the report as a PDF file, too")
    add("--ranks", type=int, metavar="N", default=1, help="MPI ranks of tunica-fsi; default 1")


def make_parser(about):
    parser = Parser(BadInput, prog="tunica-vessel", description=about,
                    usage="%(prog)s LUMEN --output DIR [options]")
    parser.add_argument("lumen", metavar="LUMEN", help="surface (.stl, .vtp, ...) or mesh (.h5, .msh) of the lumen, in mm")
    parser.add_argument("--output", metavar="DIR", required=True, help="folder of the case; it is continued if it exists")
    add_physics(parser)
    add_numerics(parser)
    parser.add_argument("--stage", choices=STAGES, metavar="STAGE", help="make this stage anew, and nothing after it")
    parser.add_argument("--from", dest="first", choices=STAGES, metavar="STAGE",
                        help=f"make this stage and those after it anew: {', '.join(STAGES)}")
    parser.add_argument("--to", dest="last", choices=STAGES, metavar="STAGE", help="stop after this stage")
    parser.add_argument("--dry-run", action="store_true", help="say what would be done, how long and how large; do nothing")
    parser.add_argument("--programs", metavar="DIR", help="folder of the other programs; default: that of this one")
    return parser


def read(about, words=None):
    """The options, checked as far as they need no mesh."""
    parser = make_parser(about)
    options, unknown = parser.parse_known_intermixed_args(words)
    if unknown:
        parser.refuse(unknown)
    if options.stage and (options.first or options.last):
        raise BadInput("--stage does not go with --from and --to: it is both")
    if options.stage:
        options.first = options.last = options.stage
    if options.first and options.last and STAGES.index(options.first) > STAGES.index(options.last):
        raise BadInput(f"--from {options.first} comes after --to {options.last}")
    check_numbers(options)
    options.goal = read_pressure(options.pressure)
    options.given_splits = read_splits(options.splits)
    check_files(options)
    return options


def check_numbers(options):
    check_limits(options, {"scale": (0, 1e6), "across": (1, 200), "size": (0, 1e3), "layers": (-1, 20), "thickness": (0.01, 1),
              "wall_elements": (0, 20), "mean_flow": (0, 50),
              "heart_rate": (10, 400), "proximal": (0, 0.9), "step": (0, 100), "beats": (0, 1000),
              "tolerance": (0, 0.5), "ranks": (0, 10000), "tissue": (-1e-9, 1e4)})


def check_limits(options, limits):
    for name, (low, high) in limits.items():
        value = getattr(options, name)
        if value is not None and not low < value <= high:
            raise BadInput(f"--{name.replace('_', '-')} is {value:g}, expected more than {low:g} and at most {high:g}")


def read_pressure(text):
    """Systolic and diastolic pressure [mmHg]."""
    try:
        systolic, diastolic = (float(word) for word in text.split("/"))
    except ValueError:
        raise BadInput(f"--pressure is {text}, expected systolic/diastolic in mmHg, such as 120/80") from None
    if not 10 <= diastolic < systolic <= 300:
        raise BadInput(f"--pressure is {text}, expected 10 <= diastolic < systolic <= 300 mmHg")
    if systolic < 20:
        raise BadInput(f"--pressure is {text}, less than 20 mmHg in systole. Are these kPa? 1 kPa is 7.5 mmHg")
    return systolic, diastolic


def read_splits(text):
    """Outlet -> share; the names are compared with those of the mesh later."""
    shares = {}
    for word in (text or "").split(","):
        name, _, value = word.partition("=")
        if not word:
            continue
        name = name.strip()
        if name in shares:
            raise BadInput(f"--splits: {name} has two shares, expected one")
        try:
            shares[name] = float(value) if name else float("no name")
        except ValueError:
            raise BadInput(f"--splits: {word} is no NAME=SHARE, such as opening-2=0.7") from None
    if any(not 0 < share < 1 for share in shares.values()) or sum(shares.values()) > 1 + 1e-9:
        raise BadInput(f"--splits is {text}, expected shares between 0 and 1 that add up to at most 1")
    return shares


def check_files(options):
    if not os.path.isfile(options.lumen):
        raise BadInput(f"{options.lumen}: there is no such file")
    if options.wall not in PRESETS and not os.path.isfile(options.wall):
        raise BadInput(f"--wall {options.wall}: neither a kind of wall nor a file. {nearest(options.wall, list(PRESETS))}")
    if options.flow is None or is_number(options.flow):
        if options.mean_flow is not None:
            raise BadInput("--mean-flow scales the flow of a file, which --flow does not name")
    elif not os.path.isfile(options.flow):
        raise BadInput(f"--flow {options.flow}: neither a number in l/min nor a file")
    if options.flow and is_number(options.flow) and not 0 < float(options.flow) <= 50:
        raise BadInput(f"--flow is {options.flow}, expected more than 0 and at most 50 l/min")


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False
