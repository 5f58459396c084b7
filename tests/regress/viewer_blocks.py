"""What a reader of VTK makes of an XDMF file: viewer_blocks.py READER FILE OUTPUT

READER is vtkXdmfReader or vtkXdmf3Reader. OUTPUT is a .npz file with "times", and for step k, block b and
array a "k/b/point/a" or "k/b/cell/a". Blocks are found by their names, as ParaView's Extract Block does.
Exit status 3: this Python has no such reader.
"""
import sys

import numpy as np

try:
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    from vtkmodules.util.numpy_support import vtk_to_numpy
    if sys.argv[1] == "vtkXdmfReader":
        from vtkmodules.vtkIOXdmf2 import vtkXdmfReader as Reader
    else:
        from vtkmodules.vtkIOXdmf3 import vtkXdmf3Reader as Reader
except ImportError:
    sys.exit(3)


def block(data, name):
    found = [data.GetBlock(i) for i in range(data.GetNumberOfBlocks())
             if data.HasMetaData(i) and data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()) == name]
    return found[0] if len(found) == 1 else None


def arrays(grid):
    yield "point/points", grid.GetPoints().GetData()
    for place, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
        for i in range(data.GetNumberOfArrays()):
            yield f"{place}/{data.GetArrayName(i)}", data.GetArray(i)


def main(file, output):
    reader = Reader()
    reader.SetFileName(file)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    found = {"times": np.array(times)}
    for k, time in enumerate(times):
        reader.UpdateTimeStep(time)
        for name in ("fluid", "wall"):
            grid = block(reader.GetOutputDataObject(0), name)
            if grid is not None:
                found.update({f"{k}/{name}/{a}": vtk_to_numpy(v).copy() for a, v in arrays(grid)})
    np.savez(output, **found)


main(*sys.argv[2:])
