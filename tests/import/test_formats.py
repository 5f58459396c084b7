"""tunica-import on the formats of others: test_formats.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import contextlib
import io
import os

import h5py
import meshio
import numpy as np
from vtkmodules.vtkIOExodus import vtkExodusIIWriter
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import samples
from cases import ImportTest, run, tunica
from samples import Column, flat_faces, grid_of, write_vtu

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data")
MODES = ("ascii none", "binary none", "binary zlib", "appended none", "appended zlib")


class OwnVtu(ImportTest):
    """What tunica-mesh writes for ParaView comes back as it was."""

    def setUp(self):
        super().setUp()
        tunica("tunica-mesh", "tube", self.path("tube.h5"))
        tunica("tunica-mesh", "convert", self.path("tube.h5"), self.path("tube.vtu"))
        self.tube = samples.Mesh(self.path("tube.h5"))

    def expect_same(self, mesh, with_names=True):
        for name in ("vertices", "tets", "triangles", "tet_region", "triangle_surface"):
            self.assertTrue((getattr(mesh, name) == getattr(self.tube, name)).all(), name)
        self.assertEqual(mesh.ids, self.tube.ids)
        if with_names:
            self.assertEqual((mesh.regions, mesh.surfaces), (self.tube.regions, self.tube.surfaces))

    def test_mesh_of_our_own_comes_back_whole(self):
        self.expect_same(self.imported("tube.vtu"))
        self.expect_conforming("fluid", "media,adventitia", "interface")

    def test_own_hdf5_is_read(self):
        self.expect_same(self.imported("tube.h5"))

    def test_every_encoding_is_read(self):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path("tube.vtu"))
        reader.Update()
        for k, mode in enumerate(MODES):
            with self.subTest(mode=mode):
                write_vtu(self.path(f"{k}.vtu"), reader.GetOutput(), mode=mode)
                self.expect_same(self.imported(f"{k}.vtu", out=f"{k}.h5"), with_names=False)

    def test_vectors_on_tetrahedra_come_back(self):
        directions = np.cross(self.tube.vertices[self.tube.tets].mean(axis=1), [0, 0, 1])
        with h5py.File(self.path("tube.h5"), "r+") as file:
            file["tet_vector_names"] = np.array([b"fibre"])
            file["tet_vectors"] = directions
        tunica("tunica-mesh", "convert", self.path("tube.h5"), self.path("fibres.vtu"))
        mesh = self.imported("fibres.vtu")
        self.assertTrue((mesh.vectors == directions).all())

    def test_damaged_files_are_one_line(self):
        with open(self.path("tube.vtu"), "rb") as file:
            text = file.read()
        damaged = {"half.vtu": text[:len(text) // 2], "empty.vtu": b"", "other.vtu": b"no XML", "half.vtp": text[:1000],
                   "half.msh": b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n1 0 0", "other.mesh": b"no mesh\n",
                   "half.bdf": b"BEGIN BULK\n", "other.exo": b"nothing", "other.xyz": b"?", "other.h5": b"?"}
        for name, content in damaged.items():
            with open(self.path(name), "wb") as file:
                file.write(content)
            with self.subTest(name=name):
                self.expect_error(name, parts=[name + ": "])


class OtherFormats(ImportTest):
    def setUp(self):
        super().setUp()
        self.column = Column()
        self.faces = flat_faces(self.column.points, self.column.tets)

    def expect_column(self, mesh, regions, surfaces):
        self.expect_sizes(mesh.volumes(), {name: 1 for name in regions})
        self.expect_sizes(mesh.areas(), surfaces)
        order = np.lexsort(mesh.vertices.T), np.lexsort(self.column.points.T)
        self.assertTrue(np.allclose(mesh.vertices[order[0]], self.column.points[order[1]], atol=1e-6))

    def blocks(self):
        """meshio's cells: two of tetrahedra, two of triangles."""
        tets, region = self.column.tets, self.column.region
        return [("tetra", tets[region == 1]), ("tetra", tets[region == 2]), ("triangle", self.faces["z_low"]),
                ("triangle", self.faces["z_high"])]

    def write(self, name, cells, **content):
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            meshio.Mesh(self.column.points, cells, **content).write(self.path(name), **self.how)
        return name

    def write_gmsh_22(self, name, binary, groups=(1, 2, 1, 2), names=None):
        """Groups of volumes and of surfaces have numbers of their own."""
        self.how = {"file_format": "gmsh22", "binary": binary}
        cells = self.blocks()
        entities = [np.full(len(c), k + 1) for k, (_, c) in enumerate(cells)]
        return self.write(name, cells, cell_data={
            "gmsh:physical": [np.full(len(c), g) for g, (_, c) in zip(groups, cells)], "gmsh:geometrical": entities},
            field_data={"fluid": np.array([1, 3]), "wall": np.array([2, 3]), "inlet": np.array([1, 2]),
                        "outlet": np.array([2, 2])} if names is None else names)

    def test_gmsh_2_2_in_text_and_binary(self):
        for binary in (False, True):
            mesh = self.imported(self.write_gmsh_22("c.msh", binary), out=f"{binary}.h5")
            self.expect_column(mesh, ("fluid", "wall"), {"inlet": 1, "outlet": 1, "interface": 1, "surface-0": 8})
            self.expect_conforming("fluid", "wall", "interface", out=f"{binary}.h5")

    def test_gmsh_4_1_in_text(self):
        tunica("tunica-mesh", "tube", self.path("tube.h5"))
        tunica("tunica-mesh", "convert", self.path("tube.h5"), self.path("tube.msh"), "--gmsh", "4.1")
        tube = samples.Mesh(self.path("tube.h5"))
        mesh = self.imported("tube.msh")
        self.assertEqual((mesh.regions, mesh.surfaces), (tube.regions, tube.surfaces))
        self.expect_sizes(mesh.volumes(), tube.volumes(), 1e-12)
        self.expect_sizes(mesh.areas(), tube.areas(), 1e-12)

    def write_gmsh_41(self, name, *groups):
        cells = [c for _, c in self.blocks()]
        samples.write_gmsh_41_binary(self.path(name), self.column.points, [
            (d, g, n, c) for d, g, n, c in zip((3, 3, 2, 2), groups, ("fluid", "wall", "inlet", "outlet"), cells)])
        return name

    def test_gmsh_4_1_in_binary(self):
        mesh = self.imported(self.write_gmsh_41("c.msh", [1], [2], [1], [2]))
        self.expect_column(mesh, ("fluid", "wall"), {"inlet": 1, "outlet": 1, "interface": 1, "surface-0": 8})

    def test_gmsh_4_1_needs_one_group_for_each(self):
        self.expect_error(self.write_gmsh_41("two.msh", [1], [2, 1], [1], [2]),
                          parts=["two.msh: ", "are in the physical groups fluid and wall, expected one"])
        name = self.write_gmsh_41("some.msh", [1], [2], [1], [2])
        samples.write_gmsh_41_binary(self.path(name), self.column.points, [
            (3, [1], "fluid", self.column.tets), (2, [], None, self.faces["z_low"])])
        self.expect_error(name, parts=["some.msh: ", "some elements have a physical group and others have none"])

    def test_volume_and_surface_of_one_name_keep_it(self):
        name = self.write_gmsh_22("c.msh", False)
        with open(self.path(name), encoding="utf-8") as file:
            text = file.read().replace('"inlet"', '"fluid"')
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        self.expect_column(self.imported(name), ("fluid", "wall"),
                           {"fluid": 1, "outlet": 1, "interface": 1, "surface-0": 8})

    def test_gmsh_without_groups_is_numbered(self):
        mesh = self.imported(self.write_gmsh_22("c.msh", True, groups=(0, 0, 0, 0), names={}))
        self.expect_sizes(mesh.volumes(), {"region-1": 2})
        self.expect_sizes(mesh.areas(), {"surface-0": 10})

    def test_medit(self):
        self.how = {}
        mesh = self.imported(self.write("c.mesh", self.blocks(), cell_data={
            "medit:ref": [np.full(len(c), n) for n, (_, c) in zip((1, 2, 3, 4), self.blocks())]}))
        self.expect_column(mesh, ("region-1", "region-2"), {"surface-3": 1, "surface-4": 1, "surface-0": 8})

    def test_abaqus_takes_the_sets_of_element_lines_and_of_lists(self):
        self.how = {}
        name = self.write("c.inp", self.blocks())
        with open(self.path(name), encoding="utf-8") as file:
            head, first, second, low, high = file.read().split("*ELEMENT")
        low = low.split("*")[0]
        number = int(high.splitlines()[1].split(",")[0])
        count = len(self.faces["z_high"])
        lists = f"*ELSET, ELSET=outlet, GENERATE\n{number}, {number + count - 1}, 1\n"
        first, second = (part.replace("TYPE=C3D4", "TYPE=C3D4, ELSET=" + set_name)
                         for part, set_name in ((first, "fluid"), (second, "wall")))
        with open(self.path(name), "w", encoding="utf-8") as file:
            # The line without a set comes first: meshio gives the sets to the wrong blocks.
            file.write("*ELEMENT".join([head, low, first, second, high]) + lists)
        self.expect_column(self.imported(name), ("fluid", "wall"), {"outlet": 1, "interface": 1, "surface-0": 9})

    def test_surfaces_of_abaqus_are_sides_of_tetrahedra(self):
        mesh = self.imported(os.path.join(DATA, "import-surface.inp"))
        self.expect_sizes(mesh.volumes(), {"BLOOD": 1 / 6, "WALL": 1 / 3})
        # S1 of element 1 is z = 0; S3 of it is the face between the two, of a side of sqrt(2).
        self.expect_sizes(mesh.areas(), {"INLET": 0.5, "INTERFACE": 3 ** 0.5 / 2, "surface-0": 1 + 1.5 * 3 ** 0.5})
        self.expect_conforming("BLOOD", "WALL", "INTERFACE")
        with open(os.path.join(DATA, "import-surface.inp"), encoding="utf-8") as file:
            text = file.read()
        with open(self.path("more.inp"), "w", encoding="utf-8") as file:
            file.write(text + "*Surface, type=ELEMENT, name=AGAIN\n_in_s1, s1\n*Surface, type=NODE, name=POINTS\n1,\n"
                       "*Surface, type=ELEMENT, name=SHELL\n1, SPOS\n")
        self.expect_sizes(self.imported("more.inp", out="more.h5").areas(), mesh.areas())
        for note in ('1 faces of the *SURFACE "AGAIN"', 'the *SURFACE "POINTS" of the type NODE',
                     '"SHELL" has 1 lines without a side'):
            self.assertIn(note, self.said)
        for name, content, part in (("set.inp", "NONE, S1", 'names the set "NONE"'),
                                    ("number.inp", "7, S1", "a side of element 7, expected one of the tetrahedra")):
            with open(self.path(name), "w", encoding="utf-8") as file:
                file.write(text + "*Surface, type=ELEMENT, name=X\n" + content + "\n")
            self.expect_error(name, parts=[part], out="x.h5")

    def test_hybrid_elements_of_abaqus_are_tetrahedra(self):
        with open(os.path.join(DATA, "import-surface.inp"), encoding="utf-8") as file:
            text = file.read().replace("type=C3D4", "type=C3D4H")
        with open(self.path("hybrid.inp"), "w", encoding="utf-8") as file:
            file.write(text)
        self.expect_sizes(self.imported("hybrid.inp").volumes(), {"BLOOD": 1 / 6, "WALL": 1 / 3})

    def test_groups_of_med_may_have_accents(self):
        self.how = {}
        tets, region = self.column.tets, self.column.region
        low, high = self.faces["z_low"], self.faces["z_high"]
        name = self.write("c.med", [("tetra", tets), ("triangle", np.concatenate([low, high]))], cell_data={
            "cell_tags": [-region.astype(int), np.repeat([-3, -4], [len(low), len(high)])]})
        with h5py.File(self.path(name), "r+") as file:
            families = next(iter(file["FAS"].values())).require_group("ELEME")
            for tag, group in zip((-1, -2, -3, -4), ("lumen", "Gefäßwand", "entrée", "sortie")):
                family = families.create_group(f"FAM_{tag}")
                family.attrs["NUM"] = tag
                names = family.create_group("GRO")
                names.attrs["NBR"] = 1
                letters = np.frombuffer(group.encode("utf-8").ljust(80, b"\0"), dtype=np.int8)
                names.create_dataset("NOM", (1,), dtype="80int8")[0] = letters
        self.expect_column(self.imported(name, "--fluid-regions", "lumen"), ("lumen", "Gefäßwand"),
                           {"entrée": 1, "sortie": 1, "interface": 1, "surface-0": 8})

    def test_meshes_of_fluent_are_named(self):
        path = os.path.join(DATA, "import-fluent.msh")
        self.expect_error(path, parts=["a mesh of Fluent (ANSYS), which is not read", "save it as VTU"])
        done = tunica("tunica-mesh", "info", path)
        self.assertEqual(done.returncode, 1)
        self.assertIn("a mesh of Fluent (ANSYS), which is not read", done.stderr)

    def test_what_meshio_stumbles_over_has_a_cure(self):
        with open(self.path("c.inp"), "w", encoding="utf-8") as file:
            file.write("*NODE\n1, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n")
        self.expect_error("c.inp", parts=["c.inp: ", "it stumbles (KeyError: 2)", "save it as Gmsh or VTU"])

    def test_legacy_vtk(self):
        writer = vtkUnstructuredGridWriter()
        writer.SetInputData(grid_of(self.column.points, [(10, self.column.tets)],
                                    of_cells={"material": self.column.region.astype(np.int32)}))
        writer.SetFileName(self.path("c.vtk"))
        writer.SetFileTypeToBinary()
        writer.Write()
        self.expect_column(self.imported("c.vtk", "--region-array", "material"), ("region-1", "region-2"),
                           {"surface-0": 10})

    def test_exodus_blocks_are_regions(self):
        writer = vtkExodusIIWriter()
        writer.SetInputData(grid_of(self.column.points, [(10, self.column.tets)],
                                    of_cells={"ObjectId": self.column.region.astype(np.int32)}))
        writer.SetFileName(self.path("c.exo"))
        writer.Write()
        self.expect_column(self.imported("c.exo", "--fluid-regions", "region-1"), ("region-1", "region-2"),
                           {"surface-0": 10, "interface": 1})

    def test_exodus_side_sets_are_surfaces(self):
        self.column = Column(1)
        self.expect_column(self.imported(os.path.join(DATA, "mesh-column.exo")), ("fluid", "wall"),
                           {"inlet": 1, "outlet": 1, "interface": 1, "surface-0": 8})

    def test_quadratic_and_other_elements_are_refused(self):
        tets = self.column.tets
        quadratic = np.concatenate([tets, tets[:, [0, 1, 0, 0, 1, 2]]], axis=1)
        hexahedra = np.concatenate([tets, tets], axis=1)
        for name, elements, parts in (
                ("second", [(24, quadratic)], ["324 elements are of the kind tetra10", "ElementOrder = 1"]),
                ("mixed", [(10, tets), (12, hexahedra)], ["324 hexahedron beside 324 tetrahedra"]),
                ("surface", [(5, self.faces["z_low"])], ["no tetrahedra, but 18 triangles", "filled first"])):
            write_vtu(self.path(name + ".vtu"), self.column.points, elements)
            self.expect_error(name + ".vtu", parts=[name + ".vtu: "] + parts)
        self.how = {"file_format": "gmsh22", "binary": True}
        name = self.write("second.msh", [("tetra10", quadratic)])
        self.expect_error(name, parts=["second.msh: 324 elements are of the kind tetra10"])

    def test_triangles_that_do_not_fit_are_refused(self):
        low = self.faces["z_low"]
        for name, triangles, numbers, parts in (
                ("stray", np.vstack([low, [[0, 1, 100]]]), np.ones(19), ["1 triangles are no faces", '"surface-1"']),
                ("twice", np.vstack([low, low]), np.repeat([1, 2], 18),
                 ["18 faces belong to two surfaces", '"surface-1" and "surface-2"'])):
            write_vtu(self.path(name + ".vtu"), self.column.points, [(10, self.column.tets), (5, triangles)], of_cells={
                "region": np.concatenate([self.column.region, np.zeros(len(triangles))]).astype(np.int32),
                "surface": np.concatenate([np.zeros(324), numbers]).astype(np.int32)})
            self.expect_error(name + ".vtu", parts=[name + ".vtu: "] + parts)


if __name__ == "__main__":
    run()
