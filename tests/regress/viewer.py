"""Viewers find each block by its name at every time, and in it what fields.h5 holds.

Usage: viewer.py FOLDER_OF_PROGRAMS SCRATCH

Debian has the readers in ParaView only, which is too large to ask for; without it what is left is the
structure that they need. pvpython is searched, or this Python has the readers.
"""
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from runs import ENVIRONMENT, ROOT, Run, Verdict, command, fresh

READERS = {"fields.xdmf": "vtkXdmf3Reader", "fields.xdmf2": "vtkXdmfReader"}
STEPS = 3


def check_structure(verdict, results):
    """Rules of the readers, see xdmf.hpp."""
    top = xml.parse(results / "fields.xdmf").getroot().find("Domain/Grid")
    steps = top.findall("Grid")
    verdict.claim(top.get("CollectionType") == "Temporal" and len(steps) == STEPS,
                  f"fields.xdmf has {len(steps)} steps")
    verdict.claim(all(s.get("Name") is None for s in steps), "none of them has a name")
    verdict.claim(all([g.get("Name") for g in s.findall("Grid")] == ["fluid", "wall"] for s in steps),
                  "each has the blocks fluid and wall")
    top = xml.parse(results / "fields.xdmf2").getroot().find("Domain/Grid")
    blocks = {g.get("Name"): g.findall("Grid") for g in top.findall("Grid")}
    verdict.claim(list(blocks) == ["fluid", "wall"] and {len(b) for b in blocks.values()} == {STEPS},
                  f"fields.xdmf2 has the blocks {', '.join(blocks)} over {STEPS} steps")
    times = [[float(g.find("Time").get("Value")) for g in grids] for grids in blocks.values()]
    verdict.claim(times[0] == times[1] == sorted(times[0]), f"at the times {times[0]}")


def check_values(verdict, what, found, file):
    """Arrays of all blocks against the file."""
    steps = sorted(name for name in file if name.startswith("step_"))
    verdict.claim(list(found["times"]) == [file[s].attrs["time"] for s in steps], f"{what}: the times")
    for k, step in enumerate(steps):
        for block, names in (("fluid", ("point/displacement", "point/velocity", "point/pressure")),
                             ("wall", ("point/displacement", "cell/von_mises", "cell/cauchy_stress"))):
            have = [n for n in names if f"{k}/{block}/{n}" in found]
            verdict.claim(have == list(names), f"{what}: {step} has the block {block} with {', '.join(have)}")
            for name in have:
                values = found[f"{k}/{block}/{name}"]
                expected = file[f"{step}/{block}/{name.split('/')[1]}"][...]
                if values.ndim == 2 and values.shape[1] == 9:  # version 3 leaves tensors as they are
                    values = values[:, [0, 1, 2, 4, 5, 8]]
                verdict.claim(np.array_equal(values.reshape(expected.shape), expected),
                              f"{what}: {block}, {name} of {step} is that of fields.h5")


def read(reader, path, output):
    """What the reader finds, None where no Python has it."""
    script = pathlib.Path(__file__).with_name("viewer_blocks.py")
    for python in (sys.executable, shutil.which("pvpython")):
        if python is None:
            continue
        done = subprocess.run([python, str(script), reader, str(path), str(output)], env=ENVIRONMENT,
                              capture_output=True, text=True)
        if done.returncode != 3:
            if done.returncode != 0:
                print(done.stderr)
            return np.load(output) if done.returncode == 0 else {"times": []}
    return None


def check_vtu(verdict, programs, results, file):
    """tunica-report --vtu, read by VTK."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    done = Run(command(programs / "tunica-report", [results, "--vtu"]), results)
    verdict.claim(done.status == 0, f"--vtu ends with 0 {done.err}")
    steps = sorted(name for name in file if name.startswith("step_"))
    for name in ("fluid", "wall"):
        series = xml.parse(results / "vtu" / f"{name}.pvd").getroot().findall("Collection/DataSet")
        verdict.claim([float(s.get("timestep")) for s in series] == [file[s].attrs["time"] for s in steps],
                      f"{name}.pvd: the times")
        for step, entry in zip(steps, series):
            reader = vtkXMLUnstructuredGridReader()
            reader.SetFileName(str(results / "vtu" / entry.get("file")))
            reader.Update()
            grid = reader.GetOutput()
            same = np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), file[f"{name}/points"][...])
            for array, stored in file[f"{step}/{name}"].items():
                data = grid.GetPointData() if len(stored) == grid.GetNumberOfPoints() else grid.GetCellData()
                values, expected = vtk_to_numpy(data.GetArray(array)), stored[...]
                if expected.ndim == 2 and expected.shape[1] == 6:  # xx, xy, xz, yy, yz, zz and VTK's xx, yy, zz, xy, yz, xz
                    expected = expected[:, [0, 3, 5, 1, 4, 2]]
                same = same and np.array_equal(values, expected)
            names = grid.GetFieldData().GetAbstractArray("region_names")
            names = [names.GetValue(k) for k in range(names.GetNumberOfValues())]
            same = same and names == ["fluid", "media", "adventitia"]
            count = grid.GetCellType(0) == 10 and grid.GetNumberOfCells() == len(file[f"{name}/tets"])
            verdict.claim(same and count, f"{entry.get('file')} has what fields.h5 has, {len(file[f'{step}/{name}'])} arrays")
    refused = Run(command(programs / "tunica-report", [results.parent, "--vtu"]), results)
    verdict.claim(refused.status == 1 and "run.json is missing" in refused.err, refused.err.strip())


def main(programs, scratch):
    verdict = Verdict()
    folder = fresh(scratch)
    results = folder / "results"
    run = Run(command(programs / "tunica-fsi",
                      [ROOT / "xml" / "pulse-tiny.xml", "--output", "results", "--steps", STEPS,
                       "--set", "Output/fields every=1"]), folder)
    verdict.claim(run.status == 0, "the run is done")
    check_structure(verdict, results)
    with h5py.File(results / "fields.h5", "r") as file:
        check_vtu(verdict, programs, results, file)
        for name, reader in READERS.items():
            found = read(reader, results / name, folder / f"{reader}.npz")
            if found is None:
                print(f"skip  {reader} is not installed: {name} is not opened by it")
            else:
                check_values(verdict, f"{name} in {reader}", found, file)
    return verdict.status()


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])))
