"""Surfaces of vessels as a segmentation gives them: tubes sampled on voxels, contoured, their ends cut.

shapes.py NAME OUT.stl [--voxel 0.4] [--closed] [--grey] [--noise 0]
NAME: tube, fork, aneurysm, or a number: a vessel of that seed. Lengths in mm.
"""
import argparse

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkImplicitBoolean, vtkPlane, vtkSphere
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkConnectivityFilter, vtkFlyingEdges3D, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkFillHolesFilter
from vtkmodules.vtkIOGeometry import vtkSTLWriter


def tube(length=24.0, radius=2.0):
    t = np.linspace(0.0, 1.0, 24)[:, None]
    return [(np.hstack([2.0 * np.sin(2.0 * t), 0 * t, length * t]), np.full(24, radius))]


def fork():
    t = np.linspace(0.0, 1.0, 16)[:, None]
    return [(np.hstack([0 * t, 0 * t, 14.0 * t]), np.full(16, 2.0)),
            (np.hstack([-7.0 * t ** 0.9, 0 * t, 14.0 + 13.0 * t]), np.linspace(1.7, 1.4, 16)),
            (np.hstack([6.0 * t, 2.0 * t ** 2, 14.0 + 12.0 * t]), np.linspace(1.5, 1.2, 16))]


def aneurysm():
    """A bent artery with a sac on a neck, and two thin branches."""
    t = np.linspace(0.0, np.pi, 40)
    trunk = np.stack([12.0 * np.cos(t), 0 * t, 12.0 * np.sin(t)], axis=1)
    neck = np.array([[0.0, 0, 12.0], [0.0, 0, 15.0]])
    sac = np.array([[0.0, 0, 17.2], [0.0, 0.1, 17.3]])
    thin = [np.array([trunk[k] + s * np.array(way) for s in np.linspace(0.0, 9.0, 8)])
            for k, way in ((8, (0.7, 0.7, 0.1)), (32, (-0.6, -0.8, 0.0)))]
    return [(trunk, np.full(40, 2.0)), (neck, np.full(2, 1.6), "blind"), (sac, np.full(2, 4.0), "blind"),
            (thin[0], np.full(8, 0.8)), (thin[1], np.full(8, 0.7))]


def of_seed(seed):
    """A trunk that bends, with one to three branches of any radius."""
    random = np.random.default_rng(seed)
    radius, length = random.uniform(1.5, 9.0), random.uniform(9.0, 16.0)
    t = np.linspace(0.0, 1.0, 40)
    bend = radius * random.uniform(-3.0, 3.0, 2)
    trunk = np.stack([bend[0] * t ** 2, bend[1] * np.sin(2.5 * t), length * radius * t], axis=1)
    found = [(trunk, radius * np.linspace(1.0, random.uniform(0.6, 0.9), 40))]
    for k in range(int(random.integers(1, 4))):
        at = 10 + 8 * k + int(random.integers(0, 4))
        turn = random.uniform(0.0, 2.0 * np.pi)
        way = np.array([np.cos(turn), np.sin(turn), random.uniform(0.0, 0.9)])
        own = radius * random.uniform(0.28, 0.7)
        s = np.linspace(0.0, radius + own * random.uniform(5.0, 9.0), 20)[:, None]
        found.append((trunk[at] + s * way / np.linalg.norm(way), np.linspace(own, 0.85 * own, 20)))
    return found


def union(lines, low, count, voxel, blend):
    """Distances of the voxels to the wall, below zero inside; each piece in its own box."""
    value = np.full(tuple(count[::-1]), 1e3)
    for line, radii in (entry[:2] for entry in lines):
        own = np.full_like(value, 1e3)
        for a, b, ra, rb in zip(line[:-1], line[1:], radii[:-1], radii[1:]):
            reach = max(ra, rb) + 3.0 * voxel + blend
            first = np.maximum(((np.minimum(a, b) - reach - low) / voxel).astype(int), 0)
            last = np.minimum(((np.maximum(a, b) + reach - low) / voxel).astype(int) + 2, count)
            axes = [low[k] + voxel * np.arange(first[k], last[k]) for k in range(3)]
            z, y, x = np.meshgrid(axes[2], axes[1], axes[0], indexing="ij")
            points, way = np.stack([x, y, z], axis=-1) - a, b - a
            part = np.clip(points @ way / (way @ way), 0.0, 1.0)
            distance = np.linalg.norm(points - part[..., None] * way, axis=-1) - (ra + part * (rb - ra))
            box = tuple(slice(first[k], last[k]) for k in (2, 1, 0))
            own[box] = np.minimum(own[box], distance)
        mix = np.clip(0.5 + 0.5 * (own - value) / blend, 0.0, 1.0)
        value = value * mix + own * (1.0 - mix) - blend * mix * (1.0 - mix)
    return value


def ends_of(lines):
    """(a point beyond which to cut, direction outward, radius): the trunk's both, the last one of each branch."""
    line, radii = lines[0][:2]
    found = [(line[0], line[0] - line[1], radii[0])]
    if not (len(lines) > 1 and any(np.allclose(other[0][0], line[-1]) for other in lines[1:])):
        found.append((line[-1], line[-1] - line[-2], radii[-1]))
    found += [(other[0][-1], other[0][-1] - other[0][-2], other[1][-1]) for other in lines[1:] if len(other) == 2]
    return [(at - 1.2 * r * way / np.linalg.norm(way), way / np.linalg.norm(way), r) for at, way, r in found]


def cut_at(flow, at, way, radius):
    plane, sphere, beyond = vtkPlane(), vtkSphere(), vtkImplicitBoolean()
    plane.SetOrigin(*at)
    plane.SetNormal(*(-way))
    sphere.SetCenter(*at)
    sphere.SetRadius(2.4 * radius)
    beyond.SetOperationTypeToIntersection()
    beyond.AddFunction(plane)
    beyond.AddFunction(sphere)
    clip, largest = vtkClipPolyData(), vtkConnectivityFilter()
    clip.SetInputConnection(flow.GetOutputPort())
    clip.SetClipFunction(beyond)
    largest.SetInputConnection(clip.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    return largest


def contour(lines, voxel, grey=False, noise=0.0, seed=0):
    every = np.vstack([entry[0] for entry in lines])
    widest = max(entry[1].max() for entry in lines)
    low = every.min(axis=0) - widest - 4.0 * voxel
    count = np.ceil((every.max(axis=0) + widest + 4.0 * voxel - low) / voxel).astype(int) + 1
    value = union(lines, low, count, voxel, 0.4 * min(entry[1].min() for entry in lines))
    if noise:
        value = value + noise * voxel * np.random.default_rng(seed).standard_normal(value.shape)
    value = np.clip(value, -2.0 * voxel, 2.0 * voxel) if grey else np.where(value < 0.0, -1.0, 1.0)
    image = vtkImageData()
    image.SetDimensions(*map(int, count))
    image.SetOrigin(*low)
    image.SetSpacing(voxel, voxel, voxel)
    image.GetPointData().SetScalars(numpy_to_vtk(np.ascontiguousarray(value.ravel().astype(np.float32)), deep=True))
    flying = vtkFlyingEdges3D()
    flying.SetInputData(image)
    flying.SetValue(0, 0.0)
    flying.ComputeNormalsOff()
    return flying


def surface(lines, voxel, closed=False, grey=False, noise=0.0, seed=0):
    """The filter at the end of the pipeline, with triangles."""
    flow = contour(lines, voxel, grey, noise, seed)
    for at, way, radius in ends_of(lines):
        flow = cut_at(flow, at, way, radius)
    if closed:
        fill = vtkFillHolesFilter()
        fill.SetInputConnection(flow.GetOutputPort())
        fill.SetHoleSize(1e6)
        flow = fill
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(flow.GetOutputPort())
    triangles.Update()
    return triangles


def write(flow, path):
    writer = vtkSTLWriter()
    writer.SetInputConnection(flow.GetOutputPort())
    writer.SetFileName(str(path))
    writer.SetFileTypeToBinary()
    writer.Write()


def lines_of(name):
    return of_seed(int(name)) if str(name).isdigit() else {"tube": tube, "fork": fork, "aneurysm": aneurysm}[name]()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("name")
    parser.add_argument("out")
    parser.add_argument("--voxel", type=float, default=0.4)
    parser.add_argument("--noise", type=float, default=0.0)
    parser.add_argument("--closed", action="store_true")
    parser.add_argument("--grey", action="store_true")
    options = parser.parse_args()
    write(surface(lines_of(options.name), options.voxel, options.closed, options.grey, options.noise), options.out)


if __name__ == "__main__":
    main()
