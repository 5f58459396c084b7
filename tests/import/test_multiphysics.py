"""tunica-import on cases of svMultiPhysics: test_multiphysics.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import json
import os
import sys
from xml.etree import ElementTree

import numpy as np

import cases
import multiphysics_case as made
from cases import PROGRAM, PROGRAMS, SCRATCH, ImportTest, run, tunica
from pages import rows_of

sys.path.insert(0, os.path.dirname(os.path.realpath(PROGRAM)))  # as the program does
from importer.multiphysics import case, waves  # noqa: E402
from importer.raw import BadMesh  # noqa: E402

STILL = "<Type> Dir </Type> <Value> 0.0 </Value>"


def parameters(text):
    """Path -> value, numbers as such."""
    found = {}

    def visit(element, place):
        for child in element:
            name = f"{place}/{child.get('name')}"
            if child.tag == "ParameterList":
                visit(child, name)
                continue
            value = child.get("value")
            found[name] = (float(value) if child.get("type") in ("double", "int") else
                           [float(word) for word in value.strip("{}").split(",") if word] if child.get("type") == "Array(double)"
                           else value)

    visit(ElementTree.fromstring(text), "")
    return found


class Multiphysics(ImportTest):
    """One tube for all; each test writes a solver.xml of its own beside it."""
    base = os.path.join(SCRATCH, "tube")

    @classmethod
    def setUpClass(cls):
        if not os.path.isdir(cls.base):
            made.write(PROGRAMS, cls.base)

    def translated(self, units="cgs", **parts):
        self.made = case.Translation(made.write_solver(self.base, **parts), units)
        self.found = parameters(self.made.text)
        self.notes = list(self.made.notes.texts())
        return self.found

    def values(self, place):
        """Of one list, without its sublists."""
        return {name[len(place) + 1:]: value for name, value in self.found.items()
                if name.startswith(place + "/") and "/" not in name[len(place) + 1:]}

    def expect_values(self, place, **expected):
        found = self.values(place)
        self.assertEqual(set(found), {name.replace("_", " ") for name in expected}, place)
        for name, value in expected.items():
            name = name.replace("_", " ")
            if isinstance(value, float):
                self.assertAlmostEqual(found[name] / value if value else found[name], 1.0 if value else 0.0, places=9, msg=name)
            else:
                self.assertEqual(found[name], value, name)

    def expect_note(self, *parts):
        self.assertTrue(any(all(part in note for part in parts) for note in self.notes), "\n".join(self.notes))

    def expect_valid(self):
        """tunica-check accepts what would be written."""
        self.made.write(self.path("out"))
        done = tunica("tunica-check", self.path("out", "case.xml"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def expect_refused(self, *parts, **texts):
        with self.assertRaises(BadMesh) as caught:
            self.translated(**texts)
        self.assertNotIn("\n", str(caught.exception))
        for part in parts:
            self.assertIn(part, str(caught.exception))

    def wall_law(self, law, **parts):
        self.translated(law=law, **parts)
        return self.values("/Wall/Layers/wall-1")


class Whole(Multiphysics):
    def test_tube_is_translated_checked_and_run(self):
        solver = made.write_solver(self.base)
        done = self.run_import(solver, "--output", self.path("out"))
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stderr)
        for text in ('96 of 96 triangles of "lumen_wall" are on the interface', "units    cgs", "0.0001 in kPa", "no counterpart",
                     "Add_equation FSI, Add_equation mesh / LS. There: linear solver"):
            self.assertIn(text, done.stdout)
        again = self.run_import(solver, "--output", self.path("out"))
        self.assertEqual(again.returncode, 1)
        self.assertIn("mesh.h5: is there already. --overwrite replaces it", again.stderr)
        self.assertEqual(self.run_import(solver, "--output", self.path("out"), "--overwrite").returncode, 0)
        mesh = cases.samples.Mesh(self.path("out", "mesh.h5"))
        self.assertEqual(sorted(mesh.surfaces), ["interface", "lumen_inlet", "lumen_outlet", "wall_inlet", "wall_outer",
                                                 "wall_outlet"])
        self.assertEqual(mesh.regions, ["fluid", "wall-1", "wall-2"])
        self.assertAlmostEqual(np.ptp(mesh.vertices[:, 2]), made.LENGTH)
        check = tunica("tunica-check", self.path("out", "case.xml"))
        self.assertEqual(check.returncode, 0, check.stderr)
        self.expect_run()

    def expect_run(self):
        """The flow through the inlet is the series with as many coefficients as inlet.flow asks for, by quadrature here."""
        done = tunica("tunica-fsi", self.path("out", "case.xml"), "--output", self.path("run"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = rows_of(self.path("run", "steps.csv"))
        self.assertEqual(len(rows), 3)
        t, q = np.array(made.FLOW).T
        fine = (np.arange(800000) + 0.5) * 1e-6
        curve = np.interp(fine, t, q)
        for row in rows:
            time = float(row["time"]) / 1000.0
            wave = [np.mean(curve)] + [2.0 * np.mean(curve * np.cos(2 * np.pi * k * (fine - time) / 0.8)) for k in range(1, 8)]
            self.assertAlmostEqual(float(row["inflow_lumen_inlet_mm3_per_ms"]), -sum(wave), places=6)
        self.assertGreater(float(rows[-1]["max_displacement_wall_mm"]), 0.0)

    def test_numbers_are_those_of_other_units(self):
        """1 dyn s/cm^5 = 1e-4 kPa ms/mm^3, 1 cm^5/dyn = 1e7 mm^3/kPa, 1 cm^3/s = 1 mm^3/ms, 1 P = 0.1 kPa ms."""
        self.translated()
        self.expect_values("/Time", step_size=1.0, steps=3.0)
        self.expect_values("/Output", folder="results", fields_every=2.0, checkpoint_every=3.0)
        self.expect_values("/Fluid", regions="{fluid}", density=1.06, viscosity=0.004, time_scheme="bdf2")
        self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="windkessel", proximal_resistance=0.0121, capacitance=150.0,
                           distal_resistance=0.1212, distal_pressure=0.01, initial_pressure=0.2, backflow_stabilisation=0.3)
        self.expect_values("/Fluid/Surfaces/lumen_inlet", condition="flow rate", flow_rate=-1.0, profile="parabolic")
        self.assertEqual(self.found["/Fluid/Surfaces/lumen_inlet/Amplitude/period"], 800.0)
        self.expect_values("/Wall/Layers/wall-1", law="neo-hookean", density=1.2, c10=1000.0 / 2.9, bulk_modulus=1000.0 / 0.3)
        self.expect_values("/Wall/Layers/wall-2", law="neo-hookean", density=1.2, c10=400.0 / 2.9, bulk_modulus=400.0 / 0.3)
        self.expect_values("/Wall/Surfaces/wall_outer", condition="support", stiffness=100.0, damping=100.0, direction="normal")
        self.expect_values("/Wall/Surfaces/wall_inlet", condition="held", components="{z}")
        self.expect_values("/Mesh Motion", law="elastic", poisson_ratio=0.25, stiffening=1.0)
        self.expect_note("Domain 1 / Dilational_penalty_model = M94")
        self.assertFalse([note for note in self.notes if "Domain 2" in note or "Verbose" in note], self.notes)
        self.translated(units="si")
        self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="windkessel", proximal_resistance=121e-9, capacitance=15.0e6,
                           distal_resistance=1212e-9, distal_pressure=0.1, initial_pressure=2.0, backflow_stabilisation=0.3)
        self.assertEqual(self.found["/Fluid/density"], 1.06e-3)
        self.assertEqual(self.made.doubt(), "")
        self.translated(units="tunica")
        self.assertEqual(self.found["/Fluid/Surfaces/lumen_outlet/capacitance"], 1.5e-5)
        self.translated(units="mm-g-s")
        self.assertAlmostEqual(self.found["/Fluid/Surfaces/lumen_outlet/initial pressure"], 2.0)

    def test_fluid_or_wall_alone(self):
        """0.5 cm^3/s through a rigid tube against 1500 dyn s/cm^5 are 750 dyn/cm^2, 0.075 kPa."""
        path = made.write_solver(self.base, outlet="<Type> Neu </Type> <Time_dependence> Resistance </Time_dependence> "
                                 "<Value> 1500 </Value>", inlet="<Type> Dir </Type> <Value> -0.5 </Value> <Impose_flux> 1 </Impose_flux>")
        with open(path, encoding="utf-8") as file:
            root = ElementTree.fromstring(file.read())
        fsi, mesh_motion = root.findall("Add_equation")
        for kind, mesh, program, moves in (("fluid", "lumen", "tunica-fluid", "wall"), ("struct", "wall", "tunica-solid", "lumen")):
            own = ElementTree.fromstring(ElementTree.tostring(root))
            for element in [*own.findall("Add_equation")[1:], own.find("Add_projection"),
                            *(m for m in own.findall("Add_mesh") if m.get("name") == moves)]:
                own.remove(element)
            equation = own.find("Add_equation")
            equation.set("type", kind)
            for element in equation.findall("Add_BC"):
                if element.get("name").startswith(moves):
                    equation.remove(element)
            face = "lumen_wall" if mesh == "lumen" else "wall_inner"
            equation.append(ElementTree.fromstring(made.condition(face, STILL if kind == "fluid" else
                                                                  "<Type> Neu </Type> <Value> 1e4 </Value>")))
            ElementTree.ElementTree(own).write(path)
            made_alone = case.Translation(path, "cgs")
            made_alone.write(self.path(kind))
            done = tunica(program, self.path(kind, "case.xml"), "--steps", 1, "--output", self.path(kind, "run"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(parameters(made_alone.text)["/Wall/Surfaces/wall_inner/pressure"], 1.0)
        row = rows_of(self.path("fluid", "run", "steps.csv"))[-1]
        self.assertAlmostEqual(float(row["inflow_lumen_outlet_mm3_per_ms"]), -0.5, places=6)
        self.assertAlmostEqual(float(row["pressure_lumen_outlet_kPa"]), 0.075, places=6)


class Curves(Multiphysics):
    def amplitude(self, dependence):
        self.translated(inlet=f"<Type> Neu </Type> <Time_dependence> Unsteady </Time_dependence> {dependence}")
        return self.values("/Fluid/Surfaces/lumen_inlet/Amplitude")

    def at(self, amplitude, t):
        k = 2.0 * np.pi * np.arange(1, len(amplitude["cosines"]) + 1) * t / amplitude["period"]
        return amplitude["mean"] + np.dot(amplitude["cosines"], np.cos(k)) + np.dot(amplitude["sines"], np.sin(k))

    def test_curve_that_begins_later_is_the_same_curve_later(self):
        made.write_flow(os.path.join(self.base, "later.flow"), [(0.3 + t, q) for t, q in made.FLOW], 12)
        made.write_flow(os.path.join(self.base, "now.flow"), made.FLOW, 12)
        now, later = (self.amplitude(f"<Temporal_values_file_path> {name}.flow </Temporal_values_file_path>")
                      for name in ("now", "later"))
        for t in (0.0, 130.0, 555.0):
            self.assertAlmostEqual(self.at(later, t + 300.0), self.at(now, t), places=9)

    def test_coefficients_are_those_of_a_file_of_them(self):
        """A period of 2 s: 3 + 5 cos(pi t) + 7 sin(pi t); the imaginary part is that of the sine, with the other sign."""
        with open(os.path.join(self.base, "inlet.fcs"), "w", encoding="utf-8") as file:
            file.write("0.0 2.0\n1.0 0.0\n2\n2.0 0.0\n5.0 -7.0\n")
        found = self.amplitude("<Fourier_coefficients_file_path> inlet.fcs </Fourier_coefficients_file_path>")
        self.assertEqual(found, {"kind": "fourier", "period": 2000.0, "mean": 3.0, "cosines": [5.0], "sines": [7.0]})

    def test_ramp_and_open_curve_are_tables(self):
        made.write_flow(os.path.join(self.base, "ramp.flow"), [(0.1, 2.0), (0.2, 5.0)], 1)
        found = self.amplitude("<Temporal_values_file_path> ramp.flow </Temporal_values_file_path> <Ramp_function> 1 </Ramp_function>")
        self.assertEqual(found, {"kind": "table", "times": [100.0, 200.0], "values": [2.0, 5.0]})
        found = self.amplitude("<Temporal_values_file_path> ramp.flow </Temporal_values_file_path>")
        self.assertAlmostEqual(found["period"], 100.0)
        self.assertAlmostEqual(np.interp(150.0, found["times"], found["values"]), 3.5)
        self.expect_note("last value is not its first")

    def test_series_converges_to_the_points(self):
        t, q = np.array(made.FLOW).T
        wave = waves.through(t, q, 400)
        self.assertLess(np.abs(wave.at(t) - q).max(), 0.005)


class Laws(Multiphysics):
    def test_laws_that_correspond(self):
        found = self.wall_law('<Constitutive_model type="stVK"/>')
        self.assertEqual((found["young modulus"], found["poisson ratio"]), (1000.0, 0.45))
        self.expect_valid()
        found = self.wall_law('<Constitutive_model type="Mooney-Rivlin"> <c1> 2e5 </c1> <c2> 3e4 </c2> </Constitutive_model>'
                              "<Penalty_parameter> 5e7 </Penalty_parameter>")
        self.assertEqual((found["c10"], found["c01"], found["bulk modulus"]), (40.0, 6.0, 5000.0))
        self.expect_note("c2 in place of c1")

    def test_fibres_become_a_frame_and_an_angle(self):
        """cos 40° e_y ± sin 40° e_z: to both sides of y, out along x."""
        hgo = ('<Constitutive_model type="HGO"> <a4> 2e5 </a4> <b4> 0.8 </b4> <a6> 2e5 </a6> <b6> 0.8 </b6>'
               "<kappa> 0.1 </kappa> </Constitutive_model>")
        c, s = np.cos(np.radians(40)), np.sin(np.radians(40))
        found = self.wall_law(hgo, directions=f"<Fiber_direction> (0, {c}, {s}) </Fiber_direction>"
                                              f"<Fiber_direction> (0, {-c}, {s}) </Fiber_direction>")
        self.expect_values("/Wall/Layers/wall-1", law="holzapfel", density=1.2, c10=1000.0 / 2.9, k1=20.0, k2=0.8, dispersion=0.1,
                           fibre_angle=40.0, bulk_modulus=1000.0 / 0.3)
        self.assertEqual(self.found["/Wall/Fibre Frame/kind"], "mesh")
        self.expect_note("tension only")
        self.expect_valid()
        mesh = cases.samples.Mesh(self.path("out", "mesh.h5"))
        axial, radial = mesh.vectors.reshape(2, -1, 3)[:, mesh.tet_region > 0]
        for found, axis in ((axial, 2), (radial, 0)):
            self.assertLess(np.abs(np.abs(found[:, axis]) - np.linalg.norm(found, axis=1)).max(), 1e-12)
        self.expect_refused("two directions of fibres", law=hgo)

    def test_laws_that_do_not_are_listed(self):
        found = self.wall_law('<Constitutive_model type="Guccione"> <c> 1 </c> <bf> 2 </bf> <bt> 3 </bt> <bfs> 4 </bfs> '
                              "</Constitutive_model>")
        self.assertEqual(found["law"], "neo-hookean")
        self.assertAlmostEqual(found["c10"], 1e-4 * (4 / 2 + 4 / 2 + 3 / 2) / 3)  # c b_fs/2 twice, c b_t/2
        self.expect_note("Constitutive_model Guccione", "stands in for it")

    def test_viscosities(self):
        path = made.write_solver(self.base)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        constant = '<Viscosity model="Constant"> <Value> 0.04 </Value> </Viscosity>'
        for model, expected in (
                ('<Viscosity model="Carreau-Yasuda"> <Limiting_high_shear_rate_viscosity> 0.0345 '
                 "</Limiting_high_shear_rate_viscosity> <Limiting_low_shear_rate_viscosity> 0.56 "
                 "</Limiting_low_shear_rate_viscosity> <Shear_rate_tensor_multiplier> 1.902 </Shear_rate_tensor_multiplier> "
                 "<Shear_rate_tensor_exponent> 1.25 </Shear_rate_tensor_exponent> <Power_law_index> 0.22 </Power_law_index> "
                 "</Viscosity>", {"law": "carreau-yasuda", "viscosity": 0.00345, "viscosity at rest": 0.056, "time constant": 1902.0,
                                  "power": 0.22, "sharpness": 1.25}),
                ('<Viscosity model="Cassons"> <Asymptotic_viscosity_parameter> 0.2 </Asymptotic_viscosity_parameter> </Viscosity>',
                 {"viscosity": 0.004})):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text.replace(constant, model))
            found = parameters(case.Translation(path, "cgs").text)
            for name, value in expected.items():
                self.assertEqual(found["/Fluid/" + name], value)


class Ends(Multiphysics):
    def test_conditions_of_the_fluid(self):
        self.translated(inlet="<Type> Dir </Type> <Value> -30 </Value> <Profile> Parabolic </Profile>",
                        outlet="<Type> Neu </Type> <Time_dependence> Resistance </Time_dependence> <Value> 1500 </Value>")
        self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="resistance", resistance=0.15, distal_pressure=0.0,
                           backflow_stabilisation=0.3)
        inlet = self.values("/Fluid/Surfaces/lumen_inlet")
        self.assertEqual((inlet["condition"], inlet["profile"]), ("velocity", "parabolic"))
        self.assertLess(np.abs(np.subtract(inlet["velocity"], [0.0, 0.0, 0.3])).max(), 1e-12)  # inward: the face looks to -z
        self.expect_valid()
        self.translated(inlet="<Type> Neu </Type> <Value> 5.0e4 </Value>", outlet=STILL)
        self.expect_values("/Fluid/Surfaces/lumen_inlet", condition="pressure", pressure=5.0, backflow_stabilisation=0.3)
        self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="no slip")

    def test_conditions_of_the_wall(self):
        self.translated(ends=STILL, outer="<Type> Neu </Type> <Value> 2e4 </Value>")
        self.expect_values("/Wall/Surfaces/wall_inlet", condition="clamped")
        self.expect_values("/Wall/Surfaces/wall_outer", condition="pressure", pressure=2.0)
        self.expect_note("Add_BC wall_outer", "on the undeformed face")
        self.translated(ends=made.SLIDES.replace("0.0", "0.02"), outer="<Type> Neu </Type> <Value> 0 </Value>")
        self.expect_values("/Wall/Surfaces/wall_inlet", condition="moved", components="{z}", displacement=[0.0, 0.0, 0.2])
        self.assertEqual(self.values("/Wall/Surfaces/wall_outer"), {})
        self.expect_valid()

    def test_windkessel_of_the_other_solver(self):
        """A block of svZeroDSolver that couples to a Windkessel alone; its pressures are in mmHg."""
        mmhg = 1333.22
        content = {"boundary_conditions": [
            {"bc_name": "RCR", "bc_type": "RCR", "bc_values": {"Rp": 121.0 / mmhg, "Rd": 1212.0 / mmhg, "C": 1.5e-5 * mmhg, "Pd": 0.0}},
            {"bc_name": "other", "bc_type": "CORONARY", "bc_values": {}}],
            "external_solver_coupling_blocks": [{"name": "one", "connected_block": "RCR"},
                                                {"name": "two", "connected_block": "other"}]}
        with open(os.path.join(self.base, "network.json"), "w", encoding="utf-8") as file:
            json.dump(content, file)
        interface = ("<svZeroDSolver_interface> <Coupling_type> implicit </Coupling_type> <Configuration_file> network.json "
                     f"</Configuration_file> <Pressure_conversion_factor> {1 / mmhg} </Pressure_conversion_factor> "
                     "<Shared_library> none </Shared_library> </svZeroDSolver_interface>")
        end = "<Type> Neu </Type> <Time_dependence> Coupled </Time_dependence> <svZeroDSolver_block> {} </svZeroDSolver_block>"
        self.translated(outlet=end.format("one"), extra=interface)
        self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="windkessel", proximal_resistance=0.0121, capacitance=150.0,
                           distal_resistance=0.1212, distal_pressure=0.0, initial_pressure=0.0, backflow_stabilisation=0.3)
        self.translated(outlet=end.format("two"), extra=interface)
        self.assertEqual(self.values("/Fluid/Surfaces/lumen_outlet"), {})
        self.expect_note("Add_BC lumen_outlet", "no Windkessel and no resistance")

    def test_windkessels_of_a_file_beside_it(self):
        """As SimVascular writes it for its other solvers, with names or without."""
        end = "<Type> Neu </Type> <Time_dependence> RCR </Time_dependence>"
        path = os.path.join(self.base, "rcrt.dat")
        self.addCleanup(os.remove, path)
        values = "121\n1.5e-5\n1212\n0.0 100\n1.0 100\n"
        for text, by in ((f"2\n2\nother\n{values}2\nlumen_outlet\n{values}", "by their name"), (f"2\n2\n{values}", "in the order")):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
            self.translated(outlet=end)
            self.expect_values("/Fluid/Surfaces/lumen_outlet", condition="windkessel", proximal_resistance=0.0121, capacitance=150.0,
                               distal_resistance=0.1212, distal_pressure=0.01, initial_pressure=0.0, backflow_stabilisation=0.3)
            self.expect_note("Add_BC lumen_outlet", by)
        with open(path, "w", encoding="utf-8") as file:
            file.write("2\n2\n121\n1.5e-5\n")
        self.expect_refused("rcrt.dat: cannot be read as Windkessels: it ends too early", outlet=end)

    def test_stress_at_the_start_becomes_a_pressure_where_one_is_known(self):
        self.translated(directions="<Prestress_file_path> stress.vtu </Prestress_file_path>")
        self.assertEqual(self.found["/Wall/Prestress/pressure"], 0.2)
        self.expect_note("Prestress_file_path", "a guess")


class Refused(Multiphysics):
    def test_wrong_words_are_named(self):
        for parts, texts in (
                (['Add_BC lumen_inlet: unknown key "Impose_fluxx". Did you mean "Impose_flux"?'],
                 {"inlet": made.INLET.replace("Impose_flux>", "Impose_fluxx>")}),
                (['Time_step_size is "soon", expected a number'], {"general": made.GENERAL.replace("1e-3", "soon")}),
                (["Time_step_size = -0.001, expected"], {"general": made.GENERAL.replace("1e-3", "-1e-3")}),
                (['"Number_of_time_steps" is missing'],
                 {"general": made.GENERAL.replace("Number_of_time_steps", "Starting_time_step")}),
                (['Add_BC lumen_inlet: Time_dependence is "Unstedy"', 'Did you mean "Unsteady"?'],
                 {"inlet": made.INLET.replace("Unsteady", "Unstedy")}),
                (['Add_BC lumen_outlt: there is no face "lumen_outlt". Did you mean "lumen_outlet"?'],
                 {"extra": made.condition("lumen_outlt", STILL)}),
                (["Constitutive_model HGOO: the type", 'Did you mean "HGO"?'], {"law": '<Constitutive_model type="HGOO"/>'}),
                (["no file", 'Did you mean "inlet.flow"?'], {"inlet": made.INLET.replace("inlet.flow", "inlt.flow")}),
                (["Effective_direction", "expected three numbers"], {"ends": made.SLIDES.replace("(0, 0, 1)", "(0, 1)")}),
                (['"RCR_values" is missing'], {"outlet": "<Type> Neu </Type> <Time_dependence> RCR </Time_dependence>"}),
                (["is no valid XML"], {"inlet": "<Type> Dir"})):
            with self.subTest(parts=parts):
                self.expect_refused(*parts, **texts)

    def test_keys_of_other_versions_are_listed(self):
        self.translated(extra="<Brand_new_feature> 1 </Brand_new_feature>")
        self.expect_note("Brand_new_feature", "unknown to tunica-import")

    def test_wrong_curves_are_named(self):
        for text, part in (("2 1\n0 1\n", "1 points, while its first line says 2"), ("2 1\n0 1\n0 2\n", ":3: the time does not increase"),
                           ("2\n0 1\n1 1\n", ":1: expected the number of points"), ("2 1\n0 x\n", ':2: "0 x", expected numbers'),
                           ("2 1\n0 1 2\n1 1 2\n", ":2: 3 numbers, expected a time and a value")):
            with open(self.path("wrong.flow"), "w", encoding="utf-8") as file:
                file.write(text)
            with self.assertRaises(BadMesh) as caught:
                waves.of_points(self.path("wrong.flow"), False)
            self.assertIn(part, str(caught.exception))

    def test_wrong_options_are_one_line(self):
        solver = made.write_solver(self.base)
        for words, part in (((solver, self.path("out.h5")), "expected --output FOLDER"), ((solver,), "expected --output FOLDER"),
                            ((solver, "--output", self.path("x"), "--scale", "10"), "there is no --scale"),
                            ((os.path.join(self.base, "tube.h5"), "--output", self.path("x")), "are for a case of svMultiPhysics"),
                            ((self.path("none.xml"), "--output", self.path("x")), "none.xml: there is no such file")):
            done = self.run_import(*words)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn(part, done.stderr)
            self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    run()
