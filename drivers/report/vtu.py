"""A run's fields as VTU files, one for each grid and output, and a PVD file for each grid with their times: what every
reader of VTK takes."""
import os

import numpy as np

from report.run_data import BadRun, region_names

TETRAHEDRON = 10  # VTK's number
SYMMETRIC = ("XX", "YY", "ZZ", "XY", "YZ", "XZ")  # VTK's order of six components
FROM_XDMF = [0, 3, 5, 1, 4, 2]  # which of xx, xy, xz, yy, yz, zz these are


def _vtk():
    try:
        from vtkmodules import vtkCommonCore, vtkCommonDataModel, vtkIOXML
        from vtkmodules.util import numpy_support
    except ImportError:
        raise BadRun("--vtu needs VTK: install python3-vtk9") from None
    return vtkCommonCore, vtkCommonDataModel, vtkIOXML, numpy_support


def _add(data, name, values):
    numpy_support = _vtk()[3]
    is_tensor = values.ndim == 2 and values.shape[1] == 6
    array = numpy_support.numpy_to_vtk(np.ascontiguousarray(values[:, FROM_XDMF] if is_tensor else values), deep=True)
    array.SetName(name)
    for k, component in enumerate(SYMMETRIC if is_tensor else ()):
        array.SetComponentName(k, component)
    data.AddArray(array)


def _grid(file, name):
    """The undeformed grid with region, partition, and names of the regions."""
    core, model, _, numpy_support = _vtk()
    points, tets = file[f"{name}/points"][:], file[f"{name}/tets"][:].astype(np.int64)
    grid = model.vtkUnstructuredGrid()
    place = core.vtkPoints()
    place.SetData(numpy_support.numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    grid.SetPoints(place)
    cells = model.vtkCellArray()
    offsets = np.arange(0, 4 * len(tets) + 1, 4, dtype=np.int64)
    cells.SetData(numpy_support.numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_support.numpy_to_vtkIdTypeArray(tets.ravel(), deep=True))
    grid.SetCells(TETRAHEDRON, cells)
    for constant in ("region", "partition"):
        if f"{name}/{constant}" in file:
            _add(grid.GetCellData(), constant, file[f"{name}/{constant}"][:])
    names = core.vtkStringArray()
    names.SetName("region_names")
    for region in region_names(file, name):
        names.InsertNextValue(region)
    grid.GetFieldData().AddArray(names)
    return grid


def _write_output(file, grid, group, name, path):
    model, xml = _vtk()[1:3]
    now = model.vtkUnstructuredGrid()
    now.ShallowCopy(grid)
    for array in file[f"{group}/{name}"]:
        values = file[f"{group}/{name}/{array}"][:]
        is_of_points = len(values) == grid.GetNumberOfPoints()
        _add(now.GetPointData() if is_of_points else now.GetCellData(), array, values)
    writer = xml.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputData(now)
    if not writer.Write():
        raise OSError(f"{path} cannot be written")


def write(run, folder, outputs):
    """Writes the outputs, pairs of a time and a group of fields.h5; returns the names of the PVD files."""
    if run.fields is None:
        raise BadRun(f"{run.folder} has no fields that are finished: nothing becomes a VTU file")
    os.makedirs(folder, exist_ok=True)
    series = []
    for name in run.grids():
        grid, lines = _grid(run.fields, name), []
        for time, group in outputs:
            file = f"{name}-{group[len('step_'):]}.vtu"
            _write_output(run.fields, grid, group, name, os.path.join(folder, file))
            lines.append(f'    <DataSet timestep="{time!r}" part="0" file="{file}"/>')
        series.append(name + ".pvd")
        with open(os.path.join(folder, series[-1]), "w", encoding="utf-8") as out:
            out.write('<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n  <Collection>\n'
                      + "\n".join(lines) + "\n  </Collection>\n</VTKFile>\n")
    return series
