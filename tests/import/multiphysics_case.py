"""A small case of svMultiPhysics, as SimVascular's users have it: a tube of lumen and wall in cm, solver.xml, a flow curve.

multiphysics_case.py FOLDER_OF_PROGRAMS FOLDER    writes it
"""
import os
import subprocess
import sys
import textwrap

import numpy as np

import samples

FLUID = {"inlet": "lumen_inlet", "outlet": "lumen_outlet", "interface": "lumen_wall"}
WALL = {"struct_in": "wall_inlet", "struct_out": "wall_outlet", "interface": "wall_inner", "outer": "wall_outer"}
LENGTH = 9.0  # mm

NEO_HOOKEAN = ('<Constitutive_model type="neoHookean"> </Constitutive_model>\n'
               "<Dilational_penalty_model> M94 </Dilational_penalty_model>")
INLET = """<Type> Dir </Type> <Time_dependence> Unsteady </Time_dependence>
<Temporal_values_file_path> inlet.flow </Temporal_values_file_path>
<Profile> Parabolic </Profile> <Impose_flux> true </Impose_flux>"""
OUTLET = """<Type> Neu </Type> <Time_dependence> RCR </Time_dependence>
<RCR_values>
  <Capacitance> 1.5e-5 </Capacitance> <Distal_resistance> 1212 </Distal_resistance>
  <Proximal_resistance> 121 </Proximal_resistance> <Distal_pressure> 100 </Distal_pressure>
  <Initial_pressure> 2000 </Initial_pressure>
</RCR_values>"""
SLIDES = """<Type> Dir </Type> <Value> 0.0 </Value>
<Impose_on_state_variable_integral> true </Impose_on_state_variable_integral>
<Zero_out_perimeter> false </Zero_out_perimeter> <Effective_direction> (0, 0, 1) </Effective_direction>"""
OUTER = """<Type> Robin </Type> <Stiffness> 1e7 </Stiffness> <Damping> 1e4 </Damping>
<Apply_along_normal_direction> true </Apply_along_normal_direction>"""
GENERAL = """<Continue_previous_simulation> 0 </Continue_previous_simulation>
<Number_of_spatial_dimensions> 3 </Number_of_spatial_dimensions>
<Number_of_time_steps> 3 </Number_of_time_steps>
<Time_step_size> 1e-3 </Time_step_size>
<Spectral_radius_of_infinite_time_step> 0.50 </Spectral_radius_of_infinite_time_step>
<Save_results_to_VTK_format> true </Save_results_to_VTK_format>
<Increment_in_saving_VTK_files> 2 </Increment_in_saving_VTK_files>
<Start_saving_after_time_step> 1 </Start_saving_after_time_step>
<Increment_in_saving_restart_files> 3 </Increment_in_saving_restart_files>
<Verbose> 1 </Verbose>"""
SOLVER = """<Max_iterations> 7 </Max_iterations> <Tolerance> 1e-12 </Tolerance>
<LS type="GMRES"> <Linear_algebra type="fsils"> <Preconditioner> fsils </Preconditioner> </Linear_algebra> </LS>"""

FLOW = [(0.0, -0.1), (0.1, -0.9), (0.3, -0.4), (0.5, -0.2), (0.8, -0.1)]  # s, cm^3/s


def tube(programs, folder):
    """Mesh of Tunica's own, which a fluid and a wall of SimVascular are taken from."""
    path = os.path.join(folder, "tube.h5")
    subprocess.run([os.path.join(programs, "tunica-mesh"), "tube", path, "--around", "8", "--axial", "6", "--length", str(LENGTH),
                    "--media-layers", "1", "--layer-surface", "off"], check=True, capture_output=True)
    return samples.Mesh(path)


def write_part(folder, mesh, regions, names, domain=None):
    """Vertices of some regions, in cm, and the surfaces of these names."""
    chosen = np.isin(mesh.tet_region, [mesh.regions.index(name) for name in regions])
    used, tets = np.unique(mesh.tets[chosen], return_inverse=True)
    at = np.full(len(mesh.vertices), -1)
    at[used] = np.arange(len(used))
    faces = {new: at[mesh.triangles[mesh.triangle_surface == mesh.surfaces.index(old)]] for old, new in names.items()}
    samples.write_simvascular(folder, mesh.vertices[used] / 10, tets.reshape(-1, 4), faces)
    if domain:
        samples.write_vtu(os.path.join(folder, domain), mesh.vertices[used] / 10, [(10, tets.reshape(-1, 4))], of_cells={
            "DOMAIN_ID": (1 + (mesh.tet_region[chosen] == mesh.regions.index("adventitia"))).astype(np.int32)})


def add_mesh(name, folder, faces, domain):
    files = "".join(f'<Add_face name="{face} "> <Face_file_path> {folder}/mesh-complete/mesh-surfaces/{face}.vtp '
                    "</Face_file_path> </Add_face>\n" for face in faces)
    return (f'<Add_mesh name="{name}">\n<Mesh_file_path> ./{folder}/mesh-complete/mesh-complete.mesh.vtu </Mesh_file_path>\n'
            f"{files}{domain}\n</Add_mesh>\n")


def condition(name, text):
    return f'<Add_BC name="{name}">\n{text}\n</Add_BC>\n'


def solver_xml(**parts):
    """The text of the file, with other parts than these where they are given."""
    part = {"law": NEO_HOOKEAN, "inlet": INLET, "outlet": OUTLET, "ends": SLIDES, "outer": OUTER, "general": GENERAL, "extra": "",
            "directions": ""} | parts
    adventitia = '<Constitutive_model type="neoHookean"/> <Dilational_penalty_model> Quad </Dilational_penalty_model>'
    domains = "".join(f'<Domain id="{number}"> <Equation> struct </Equation> {text} <Density> 1.2 </Density>\n'
                      f"<Elasticity_modulus> {E} </Elasticity_modulus> <Poisson_ratio> 0.45 </Poisson_ratio> </Domain>\n"
                      for number, E, text in ((1, "1.0e7", part["law"]), (2, "4.0e6", adventitia)))
    conditions = "".join(condition(name, part[key]) for name, key in (
        ("lumen_inlet", "inlet"), ("lumen_outlet", "outlet"), ("wall_inlet", "ends"), ("wall_outlet", "ends"), ("wall_outer", "outer")))
    still = "<Type> Dir </Type> <Value> 0.0 </Value>"
    text = f"""<?xml version="1.0" encoding="UTF-8" ?>
<svMultiPhysicsFile version="0.1">
<GeneralSimulationParameters>
{part['general']}
</GeneralSimulationParameters>
{add_mesh("lumen", "lumen", FLUID.values(), "<Domain> 0 </Domain>")}
{add_mesh("wall", "tissue", WALL.values(), "<Domain_file_path> tissue/domains.vtu </Domain_file_path>" + part['directions'])}
<Add_projection name="wall_inner"> <Project_from_face> lumen_wall </Project_from_face> </Add_projection>
<Add_equation type="FSI">
<Coupled> true </Coupled> {SOLVER}
<Domain id="0"> <Equation> fluid </Equation> <Density> 1.06 </Density>
<Viscosity model="Constant"> <Value> 0.04 </Value> </Viscosity>
<Backflow_stabilization_coefficient> 0.3 </Backflow_stabilization_coefficient> </Domain>
{domains}
<Output type="Spatial"> <Velocity> true </Velocity> </Output>
{conditions}{part['extra']}
</Add_equation>
<Add_equation type="mesh"> {SOLVER} <Poisson_ratio> 0.25 </Poisson_ratio>
{condition("lumen_inlet", still)}{condition("lumen_outlet", still)}
</Add_equation>
</svMultiPhysicsFile>
"""
    return textwrap.dedent(text)


def write_flow(path, points=FLOW, coefficients=8):
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"{len(points)} {coefficients}\n" + "".join(f"{t} {q}\n" for t, q in points))


def write(programs, folder, **parts):
    """solver.xml and what it names; the path of the first."""
    os.makedirs(folder, exist_ok=True)
    mesh = tube(programs, folder)
    write_part(os.path.join(folder, "lumen"), mesh, ["fluid"], FLUID)
    write_part(os.path.join(folder, "tissue"), mesh, ["media", "adventitia"], WALL, "domains.vtu")
    write_flow(os.path.join(folder, "inlet.flow"))
    return write_solver(folder, **parts)


def write_solver(folder, **parts):
    path = os.path.join(folder, "solver.xml")
    with open(path, "w", encoding="utf-8") as file:
        file.write(solver_xml(**parts))
    return path


if __name__ == "__main__":
    print(write(sys.argv[1], sys.argv[2]))
