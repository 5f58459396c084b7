"""Who takes part in the arena, with which settings, and where these come from.

A list of Tunica is an element of a case in the tree, with few keys changed. Options of PETSc are those of its manual.
"""
import copy
import dataclasses
import os
import xml.etree.ElementTree as xml

from pages import ROOT

PAPER = os.path.join(ROOT, "xml", "paper")
MUELU = "https://trilinos.github.io/pdfs/mueluguide.pdf"
TEKO = "https://trilinos.github.io/docs/teko/teko_navier_stokes.html"
FROSCH = "https://doi.org/10.1137/18M1184047, monolithic, a block for each component"
PETSC = "https://petsc.org/release/manual/ksp/"
PAGES = "https://petsc.org/release/manualpages/PC/"


@dataclasses.dataclass
class Contestant:
    name: str
    kind: str  # "tunica", "petsc" or "scipy"
    group: str  # "ours", "Trilinos", "PETSc", "SciPy"
    source: str  # of the settings
    settings: object = None  # an element "ParameterList" or a text of options; none: the default
    ranks: tuple = ()  # it is limited to
    needs: str = ""  # "schur": systems of which an approximation of the Schur complement is known
    keys: tuple = ()  # of the case, "path=value"


def listed(file, name, **changes):
    """The settings of that name in a case of the tree; changes: keys at any depth, "/" for levels of lists."""
    root = xml.parse(os.path.join(PAPER, file)).getroot()
    found = next(node for node in root.find("ParameterList[@name='Solvers']").iter("ParameterList")
                 if node.get("name") == name)
    return tried(copy.deepcopy(found), changes)


def put(element, path, value):
    *lists, key = path.split("/")
    for name in lists:
        inner = element.find(f"ParameterList[@name='{name}']")
        element = xml.SubElement(element, "ParameterList", name=name) if inner is None else inner
    kind = {bool: "bool", int: "int", float: "double", str: "string"}[type(value)]
    text = str(value).lower() if kind == "bool" else str(value)
    node = element.find(f"Parameter[@name='{key}']")
    if node is None:
        node = xml.SubElement(element, "Parameter", name=key)
    node.set("type", kind)
    node.set("value", text)


def made(**keys):
    return tried(xml.Element("ParameterList"), keys)


def tried(element, keys):
    element.set("name", "tried")
    put(element, "max iterations", 500)
    for path, value in keys.items():
        put(element, path, value)
    return element


def teko(block, **settings):
    """A Teko preconditioner whose inverses are MueLu's with its defaults."""
    element = made(method="flexible gmres", preconditioner="block")
    put(element, "Stratimikos/Preconditioner Type", "Teko")
    place = "Stratimikos/Preconditioner Types/Teko/"
    put(element, place + "Inverse Type", "Block")
    library = place + "Inverse Factory Library/"
    put(element, library + "Block/Type", block)
    for path, value in settings.items():
        put(element, library + "Block/" + path, value)
    for name in ("Velocity", "Pressure"):
        put(element, library + name + "/Type", "MueLu")
    return element


SWEEPS = "MueLu/Factories/Sweeps/"
GMRES = "-ksp_type gmres -ksp_pc_side right -ksp_gmres_restart 100 "
SCHUR = ("-ksp_type fgmres -ksp_gmres_restart 100 -pc_type fieldsplit -pc_fieldsplit_type schur "
         "-pc_fieldsplit_schur_fact_type upper -fieldsplit_0_ksp_type preonly -fieldsplit_1_ksp_type preonly ")

CONTESTANTS = [
    Contestant("default", "tunica", "ours", "docs/choosing.md: `tunica-solvers K.mtx b.mtx`"),
    Contestant("default without LU", "tunica", "ours", "the same, `direct operations` = 0", keys=("Solvers/direct operations=0",)),
    Contestant("node ILU", "tunica", "ours", "xml/paper/amg-fluid.xml",
               listed("amg-fluid.xml", "nodal ILU(0) 1+1, GCR", **{SWEEPS + "sweeps": 2})),
    Contestant("Vanka", "tunica", "ours", "xml/paper/muelu-fluid.xml", listed("muelu-fluid.xml", "Vanka 2+2, GCR")),
    Contestant("additive Vanka", "tunica", "ours", "the same, `combine` = `additive`",
               listed("muelu-fluid.xml", "Vanka 2+2, GCR", **{SWEEPS + "combine": "additive"})),
    Contestant("Braess–Sarazin", "tunica", "ours", "xml/paper/muelu-fluid.xml",
               listed("muelu-fluid.xml", "Braess-Sarazin 2+2, GCR", **{SWEEPS + "schur sweeps": 4})),
    Contestant("field by field", "tunica", "ours", "the default of `block`", made(method="gcr", preconditioner="block")),
    Contestant("MueLu Braess–Sarazin", "tunica", "Trilinos", "xml/paper/muelu-fluid.xml, after " + MUELU,
               listed("muelu-fluid.xml", "MueLu Braess-Sarazin 2+2")),
    Contestant("MueLu SIMPLE", "tunica", "Trilinos", "the same", listed("muelu-fluid.xml", "MueLu SIMPLE 2+2")),
    Contestant("MueLu Uzawa", "tunica", "Trilinos", "the same", listed("muelu-fluid.xml", "MueLu Uzawa 2+2")),
    Contestant("MueLu indefinite diagonal", "tunica", "Trilinos", "the same",
               listed("muelu-fluid.xml", "MueLu indefinite diagonal 2+2")),
    Contestant("MueLu block Gauss–Seidel", "tunica", "Trilinos", "the same",
               listed("muelu-fluid.xml", "MueLu block Gauss-Seidel 2+2")),
    Contestant("Teko SIMPLE + MueLu", "tunica", "Trilinos", TEKO + ", SIMPLE",
               teko("NS SIMPLE", **{"Inverse Velocity Type": "Velocity", "Inverse Pressure Type": "Pressure",
                                    "Explicit Velocity Inverse Type": "AbsRowSum", "Alpha": 0.9})),
    Contestant("Teko LSC + MueLu", "tunica", "Trilinos", TEKO + ", LSC",
               teko("NS LSC", **{"Strategy Name": "Basic Inverse", "Strategy Settings/Inverse Velocity Type": "Velocity",
                                 "Strategy Settings/Inverse Pressure Type": "Pressure",
                                 "Strategy Settings/Ignore Boundary Rows": False, "Strategy Settings/Use LDU": False}), (1,)),
    Contestant("Ifpack2 ILU(1)", "tunica", "Trilinos", "https://trilinos.github.io/pdfs/ifpack2guide.pdf, RILUK and Schwarz",
               made(**{"method": "gmres", "preconditioner": "ilu", "fill level": 1})),
    Contestant("Ifpack2 ILU(2) overlap 1", "tunica", "Trilinos", "the same",
               made(**{"method": "gmres", "preconditioner": "ilu", "fill level": 2, "overlap": 1})),
    Contestant("FROSch GDSW", "tunica", "Trilinos", FROSCH,
               made(**{"method": "gmres", "preconditioner": "two-level schwarz", "overlap": 1}), (2, 4, 8)),
    Contestant("FROSch RGDSW", "tunica", "Trilinos", "the same",
               made(**{"method": "gmres", "preconditioner": "two-level schwarz", "overlap": 1, "coarse space": "RGDSW"}),
               (2, 4, 8)),
    Contestant("PETSc Schur selfp + GAMG", "petsc", "PETSc", PETSC + ", Solving Block Matrices, and " + PAGES + "PCFieldSplitSetSchurPre",
               SCHUR + "-pc_fieldsplit_schur_precondition selfp -fieldsplit_0_pc_type gamg -fieldsplit_1_pc_type gamg"),
    Contestant("PETSc Schur selfp + BoomerAMG", "petsc", "PETSc", "the same",
               SCHUR + "-pc_fieldsplit_schur_precondition selfp -fieldsplit_0_pc_type hypre -fieldsplit_1_pc_type hypre"),
    Contestant("PETSc Schur mass + GAMG", "petsc", "PETSc",
               "the same, and https://petsc.org/release/src/ksp/ksp/tutorials/ex70.c.html",
               SCHUR + "-arena_schur_given -fieldsplit_0_pc_type gamg -fieldsplit_1_pc_type bjacobi", needs="schur"),
    Contestant("PETSc Schur LSC + GAMG", "petsc", "PETSc", PAGES + "PCLSC",
               SCHUR + "-pc_fieldsplit_schur_precondition self -fieldsplit_0_pc_type gamg -fieldsplit_1_pc_type lsc "
               "-fieldsplit_1_lsc_pc_type gamg"),
    Contestant("PETSc ILU(1)", "petsc", "PETSc", PETSC + ", Block Jacobi and Overlapping Additive Schwarz Preconditioners",
               GMRES + "-pc_type bjacobi -sub_pc_type ilu -sub_pc_factor_levels 1 -sub_pc_factor_shift_type nonzero"),
    Contestant("PETSc Schwarz", "petsc", "PETSc", "the same",
               GMRES + "-pc_type asm -pc_asm_blocks 8 -pc_asm_overlap 2 -sub_pc_type lu -sub_pc_factor_shift_type nonzero"),
    Contestant("PETSc MUMPS", "petsc", "PETSc", PETSC + ", Using External Linear Solvers",
               "-ksp_type fgmres -pc_type lu -pc_factor_mat_solver_type mumps -mat_mumps_icntl_24 1 -mat_mumps_icntl_14 80"),
    Contestant("PETSc SuperLU_DIST", "petsc", "PETSc", "the same",
               "-ksp_type fgmres -pc_type lu -pc_factor_mat_solver_type superlu_dist"),
    Contestant("SciPy SuperLU", "scipy", "SciPy",
               "https://docs.scipy.org/doc/scipy/reference/generated/scipy.sparse.linalg.splu.html", ranks=(1,)),
]

FROSCHS = ["FROSch GDSW", "FROSch RGDSW"]
# The pairs of the page in the tree, in the order in which they are run: sizes, ranks, contestants (none: all).
PUBLISHED = [
    (["small"], [1], None),
    (["medium"], [1], ["default", "default without LU", "node ILU", "Vanka", "Braess–Sarazin", "field by field", "Teko SIMPLE + MueLu",
                       "PETSc MUMPS", "PETSc Schur selfp + BoomerAMG", "SciPy SuperLU"]),
    (["small", "medium"], [2, 4, 8], ["default"]),
    (["small"], [2, 4, 8], FROSCHS),
    (["medium"], [4], FROSCHS),
    (["large"], [1], ["default", "default without LU"]),
    (["large"], [2, 4], ["default"]),
    (["large"], [1], ["PETSc MUMPS", "PETSc Schur selfp + BoomerAMG"]),
]


def case_of(contestant, folder):
    """The text of a case of tunica-solvers."""
    case = xml.Element("ParameterList", name="Case")
    put(case, "System/K", os.path.join(folder, "K.mtx"))
    put(case, "System/rhs", os.path.join(folder, "b.mtx"))
    put(case, "Solvers/tolerance", 1e-8)
    settings = xml.SubElement(case.find("ParameterList[@name='Solvers']"), "ParameterList", name="Settings")
    settings.append(contestant.settings)
    return xml.tostring(case, encoding="unicode")
