"""Bad inputs: one clear message, exit status 1, nothing written; what takes long is named.

Usage: bad_inputs.py FOLDER_OF_PROGRAMS SCRATCH [NAME ...]
"""
import pathlib
import sys

from runs import ROOT, Run, Verdict, command, fresh

DATA = ROOT / "tests" / "data"
SECONDS = 2.0  # printed where exceeded; the machine of a test may be busy


def replace(old, new):
    def damage(text):
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times in the good file"
        return text.replace(old, new)
    return damage


def untouched(text):
    return text


def parameter(name, kind, value):
    return f'<Parameter name="{name}" type="{kind}" value="{value}"/>'


def set_parameter(name, kind, old, new, new_kind=None):
    return replace(parameter(name, kind, old), parameter(name, new_kind or kind, new))


def split_interface(mesh):
    """The wall's tetrahedron and triangles get vertices of their own at the same places."""
    lines = []
    for line in mesh.splitlines():
        words = line.split()
        is_of_wall = len(words) > 7 and words[3] in ("15", "16", "2")
        if is_of_wall:
            words[5:] = [{"1": "6", "2": "7", "3": "8"}.get(v, v) for v in words[5:]]
        lines.append(" ".join(words) if is_of_wall else line)
    text = "\n".join(lines) + "\n"
    text = replace("5 0 0 -1\n", "5 0 0 -1\n6 0 0 0\n7 1 0 0\n8 0 1 0\n")(text)
    text = replace("9 4 2 2 2 6 8 7 5\n", "9 4 2 2 2 6 8 7 5\n10 2 2 14 14 6 7 8\n")(text)
    return replace("$Elements\n9\n", "$Elements\n10\n")(replace("$Nodes\n5\n", "$Nodes\n8\n")(text))


class Bad:
    """One fault and what its message must hold."""

    def __init__(self, name, parts, case=untouched, mesh=untouched, ranks=1, words=(),
                 output="results", program="tunica-fsi"):
        self.name, self.parts, self.case, self.mesh = name, parts, case, mesh
        self.ranks, self.words, self.output, self.program = ranks, list(words), output, program


FAULTS = [
    Bad("misspelled_key_at_depth_3",
        ["case.xml: Fluid / Surfaces / inlet", "tracton", 'Did you mean "traction"?'],
        replace('name="traction" type="Array(double)"', 'name="tracton" type="Array(double)"')),
    Bad("misspelled_list",
        ["case.xml", "Cupling", 'Did you mean "Coupling"?'],
        replace('  <ParameterList name="Wall">',
                '  <ParameterList name="Cupling"/>\n  <ParameterList name="Wall">')),
    Bad("wrong_type", ["case.xml: Fluid", '"density"', "heavy", "number (double)"],
        set_parameter("density", "double", "1.0", "heavy", "string")),
    Bad("text_where_the_type_says_number", ["case.xml", '"viscosity"', "thin"],
        set_parameter("viscosity", "double", "3.5e-3", "thin")),
    Bad("negative_density", ["case.xml: Fluid", '"density"', "-1", "> 0"],
        set_parameter("density", "double", "1.0", "-1.0")),
    Bad("zero_time_step", ["case.xml: Time", '"step size"', "0", "1e-12..1e+09"],
        set_parameter("step size", "double", "0.125", "0.0")),
    Bad("time_steps_beyond_all_numbers", ["case.xml: Time", '"step size" is 1e+307 ms', "1e-12..1e+09"],
        set_parameter("step size", "double", "0.125", "1e307")),
    Bad("fields_at_more_times_than_memory_holds",
        ["case.xml: Output", '"fields interval" is 1e-300 ms', "expected at least"],
        replace('  <ParameterList name="Wall">', '<ParameterList name="Output">' +
                parameter("fields interval", "double", "1e-300") + '</ParameterList><ParameterList name="Wall">')),
    Bad("parameter_without_its_first_character", ["case.xml: at line", "a part of a tag", '"<"'],
        replace(parameter("density", "double", "1.0"), parameter("density", "double", "1.0")[1:])),
    Bad("missing_required_key", ["case.xml: Time", '"steps"'],
        replace(parameter("steps", "int", "1"), "")),
    Bad("table_not_increasing_in_time",
        ["case.xml: Fluid / Surfaces / inlet / Amplitude", "increase", "0.5 ms follows 1 ms"],
        set_parameter("times", "Array(double)", "{0, 1, 2}", "{0, 1, 0.5}")),
    Bad("not_xml", ["case.xml"], lambda text: text[:400]),
    Bad("lists_20000_deep", ["case.xml: at line", "more than 100 deep", "at most 100"],
        replace('  <ParameterList name="Wall">', '<ParameterList name="Wall">\n' * 20000 +
                "</ParameterList>\n" * 20000 + '  <ParameterList name="Wall">')),
    Bad("missing_mesh", ["case.xml: Mesh", '"file"', "nowhere.msh"],
        replace("bad-two-tets.msh\"/>", "nowhere.msh\"/>")),
    Bad("truncated_mesh", ["mesh.msh"], mesh=lambda text: text[:len(text) * 3 // 4]),
    Bad("empty_mesh", ["mesh.msh"], mesh=lambda text: ""),
    Bad("unknown_surface_tag",
        ["mesh.msh: Fluid / Surfaces", "inlett", 'Did you mean "inlet"?'],
        replace('<ParameterList name="inlet">', '<ParameterList name="inlett">')),
    Bad("unknown_region", ["mesh.msh: Wall / Layers", "walls", 'Did you mean "wall"?'],
        replace('<ParameterList name="wall">', '<ParameterList name="walls">')),
    Bad("no_region", ["Fluid", '"regions"'],
        replace(parameter("density", "double", "1.0"),
                parameter("density", "double", "1.0") +
                parameter("regions", "Array(string)", "{}"))),
    Bad("surface_of_the_other_field", ["mesh.msh: Fluid / Surfaces", "outer", "does not bound"],
        replace('<ParameterList name="inlet">', '<ParameterList name="outer">')),
    Bad("surface_inside_the_field", ["mesh.msh: Wall / Surfaces", "interface", "does not bound"],
        lambda text: text.replace(
            text[text.index('  <ParameterList name="Fluid">'):
                 text.index('  <ParameterList name="Wall">')], "")
        .replace('<ParameterList name="wall">', '<ParameterList name="fluid"/><ParameterList '
                 'name="wall">').replace('value="interface"', 'value="clamped"'),
        program="tunica-solid"),
    Bad("interface_on_one_side_only", ["interface"],
        replace('value="clamped"', 'value="interface"')),
    Bad("non_conforming_interface", ["mesh.msh", "interface", "share"], mesh=split_interface),
    Bad("inverted_element", ["mesh.msh", "element 9", "inver"],
        mesh=replace("9 4 2 2 2 1 3 2 5", "9 4 2 2 2 1 2 3 5")),
    Bad("law_without_stiffness", ["Wall / Layers / wall", "mooney-rivlin"],
        replace(parameter("law", "string", "mooney-rivlin"),
                parameter("law", "string", "mooney-rivlin") + parameter("c10", "double", "0.0") +
                parameter("c01", "double", "0.0"))),
    Bad("unknown_surface_in_the_report",
        ["mesh.msh: Output / surfaces", "inlett", 'Did you mean "inlet"?'],
        words=["--set", "Output/surfaces={outer, inlett}"]),
    Bad("surface_of_no_field_in_the_report",
        ["mesh.msh: Output / surfaces", "outer", "does not bound fluid or wall"],
        lambda text: text.replace(
            text[text.index('  <ParameterList name="Wall">'):], "</ParameterList>\n")
        .replace('value="interface"', 'value="no slip"'),
        words=["--set", "Output/surfaces={outer}"], program="tunica-fluid"),
    Bad("all_surfaces_and_one_more", ["case.xml: Output", '"surfaces" holds "all" beside'],
        words=["--set", "Output/surfaces={all, inlet}"]),
    Bad("probe_outside_the_mesh",
        ["mesh.msh: Probes / here", '"position" {0.25, 0.25, 4}', "mm outside the undeformed wall"],
        replace('  <ParameterList name="Wall">',
                '  <ParameterList name="Probes"><ParameterList name="here">' +
                parameter("quantity", "string", "wall displacement") +
                parameter("position", "Array(double)", "{0.25, 0.25, 4}") +
                '</ParameterList></ParameterList>\n  <ParameterList name="Wall">')),
    Bad("probe_of_a_missing_field", ["Probes / here", "fluid pressure"],
        lambda text: text.replace(
            '  <ParameterList name="Wall">',
            '  <ParameterList name="Probes"><ParameterList name="here">' +
            parameter("quantity", "string", "fluid pressure") +
            parameter("position", "Array(double)", "{0, 0, 0}") +
            '</ParameterList></ParameterList>\n  <ParameterList name="Wall">')
        .replace(text[text.index('  <ParameterList name="Fluid">'):
                      text.index('  <ParameterList name="Wall">')], "")
        .replace('''      <ParameterList name="interface">
        <Parameter name="condition" type="string" value="interface"/>
      </ParameterList>
''', ""), program="tunica-solid"),
    Bad("output_below_a_file", ["/dev/null/results", "--output"], output="/dev/null/results"),
    Bad("output_is_a_file", ["case.xml", "--output"], output="case.xml"),
    Bad("more_ranks_than_elements", ["mesh.msh", "more ranks than elements: 3 ranks, 2 tetra"],
        ranks=3),
    Bad("unknown_option", ["--otput", 'Did you mean "--output"?'], words=["--otput", "x"]),
    Bad("unknown_key_in_set", ['"densty"', 'Did you mean "density"?'],
        words=["--set", "Fluid/densty=1"]),
    Bad("bad_value_in_set", ["density", "heavy"], words=["--set", "Fluid/density=heavy"]),
    Bad("missing_case", ["nowhere.xml"], words=["nowhere.xml"]),
    Bad("misspelled_key_on_two_ranks", ["case.xml: Fluid", '"densty"', 'Did you mean "density"?'],
        replace('name="density"', 'name="densty"'), ranks=2),
    Bad("missing_mesh_on_two_ranks", ["case.xml: Mesh", "nowhere.msh"],
        replace("bad-two-tets.msh\"/>", "nowhere.msh\"/>"), ranks=2),
    Bad("truncated_mesh_on_two_ranks", ["mesh.msh"], mesh=lambda text: text[:len(text) * 3 // 4],
        ranks=2),
    Bad("output_below_a_file_on_two_ranks", ["/dev/null/results"], output="/dev/null/results",
        ranks=2),
]


def snapshot(folder):
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None
            for p in sorted(folder.rglob("*"))}


def prepare(bad, folder):
    case = bad.case((DATA / "bad-case.xml").read_text())
    (folder / "case.xml").write_text(case.replace("bad-two-tets.msh\"/>", "mesh.msh\"/>"))
    (folder / "mesh.msh").write_text(bad.mesh((DATA / "bad-two-tets.msh").read_text()))


def words_of(bad, programs):
    words = [] if bad.name == "missing_case" else ["case.xml"]
    return command(programs / bad.program, words + ["--output", bad.output] + bad.words, bad.ranks)


def check(bad, programs, scratch, verdict):
    folder = fresh(scratch / bad.name)
    prepare(bad, folder)
    before = snapshot(folder)
    run = Run(words_of(bad, programs), folder)
    lines = [line for line in run.err.splitlines() if line.startswith(bad.program + ": ")]
    print(f"{bad.name} ({run.seconds:.2f} s): {' | '.join(lines)}")
    verdict.claim(run.status == 1, f"{bad.name}: exit status {run.status} is 1")
    verdict.claim(len(lines) == 1, f"{bad.name}: {len(lines)} messages are one")
    if bad.ranks == 1:  # mpirun adds lines of its own
        rest = [line for line in run.err.splitlines() if line and line not in lines]
        verdict.claim(not rest, f"{bad.name}: nothing but the message: {rest}")
    for part in bad.parts:
        verdict.claim(part in " ".join(lines), f"{bad.name}: the message holds: {part}")
    verdict.claim(snapshot(folder) == before, f"{bad.name}: nothing was written")
    if run.seconds > SECONDS:
        print(f"slow  {bad.name}: {run.seconds:.1f} s instead of {SECONDS:.0f}")


def main(programs, scratch, names):
    verdict = Verdict()
    folder = fresh(scratch / "good")
    prepare(Bad("good", []), folder)
    good = Run(command(programs / "tunica-fsi", ["case.xml", "--dry-run"]), folder)
    verdict.claim(good.status == 0, f"the undamaged case passes {good.err}")
    for bad in FAULTS:
        if not names or bad.name in names:
            check(bad, programs, scratch, verdict)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(),
                  sys.argv[3:]))
