"""The parts of tunica-lumen: test_parts.py PROGRAM FOLDER_OF_PROGRAMS SCRATCH"""
import argparse
import dataclasses
import unittest

import numpy as np

import cases
import shapes
from importer.raw import BadMesh
from lumen import (centreline, crossings, edits, ends, handles, labels, layers, make, medial, names, quality, repair, rims,
                   smooth, unfold, volume)
from lumen import surface as base
from lumen.faults import BadSurface
from lumen.surface import Surface
from tubes import pipe


def silent(_):
    pass


def openings(surface):
    return rims.openings(surface, "pipe", silent)[1]


class Repair(unittest.TestCase):
    def test_turned_and_repeated_triangles_are_put_in_order(self):
        good = pipe(16, 12)
        turned = np.random.default_rng(1).random(len(good.triangles)) < 0.3
        bad = np.where(turned[:, None], good.triangles[:, ::-1], good.triangles)
        notes = []
        mended = repair.mended(Surface(good.points, np.vstack([bad, bad[:5]])), "pipe", notes.append)
        self.assertEqual(len(mended.triangles), len(good.triangles))
        self.assertGreater(base.volume(*base.closed(mended)), 17.0)
        self.assertIn("5 triangles that are there twice", notes[0])

    def test_slivers_are_contracted(self):
        good = pipe(16, 12)
        first = int(np.flatnonzero((good.triangles == 40).any(axis=1))[0])
        a, b = good.triangles[first][good.triangles[first] != 40][0], 40
        new = len(good.points)
        points = np.vstack([good.points, good.points[a] + 1e-4 * (good.points[b] - good.points[a])])
        beside = ((good.triangles == a) | (good.triangles == b)).sum(axis=1) == 2
        halves = [np.where(good.triangles[beside] == end, new, good.triangles[beside]) for end in (a, b)]
        triangles = np.vstack([good.triangles[~beside], *halves])
        mended = repair.mended(Surface(points, triangles), "pipe", silent)
        self.assertEqual(len(mended.points), len(good.points))
        self.assertEqual(len(base.loops(mended.triangles)), 2)

    def test_two_vessels_are_refused_and_specks_dropped(self):
        good = pipe(16, 12)
        two = Surface(np.vstack([good.points, good.points + 9.0]), np.vstack([good.triangles, good.triangles + len(good.points)]))
        with self.assertRaisesRegex(BadSurface, "2 pieces"):
            repair.mended(two, "pipe", silent)
        speck = Surface(np.vstack([good.points, 9.0 + 0.1 * good.points]), two.triangles)
        self.assertEqual(len(repair.mended(speck, "pipe", silent).triangles), len(good.triangles))

    def test_a_small_handle_is_cut(self):
        bumps = pipe(24, 40, 1.0, 12.0)
        far = [np.flatnonzero((bumps.triangles == v).any(axis=1)) for v in (24 * 12, 24 * 20)]
        kept = np.setdiff1d(np.arange(len(bumps.triangles)), np.concatenate(far))
        holed = bumps.take(kept)
        inner = sorted((loop for loop in base.loops(holed.triangles) if len(loop) == 6), key=lambda loop: loop.min())
        one, other = inner[0], inner[1][::-1]
        way = [np.linalg.norm(holed.points[one] - holed.points[np.roll(other, k)], axis=1).sum() for k in range(6)]
        other = np.roll(other, int(np.argmin(way)))
        bridge = np.concatenate([np.stack([np.roll(one, -1), one, other], axis=1),
                                 np.stack([np.roll(one, -1), other, np.roll(other, -1)], axis=1)])
        ringed = Surface(holed.points, np.vstack([holed.triangles, bridge]))
        cut = handles.cut(ringed, "pipe", silent)
        filled, found = rims.openings(cut, "pipe", silent)
        closed = base.closed(filled)
        self.assertEqual(len(found), 2)
        self.assertEqual(int(closed[1].max()) + 1 - len(base.Edges(closed[1]).count) + len(closed[1]), 2)

    def test_folds_are_taken_out(self):
        good = pipe(24, 24, 1.0, 6.0)
        points = good.points.copy()
        points[24 * 12 + 3] = points[24 * 12] * [0.9, 0.9, 1.0]
        self.assertTrue(unfold.folded(points, good.triangles).any())
        flat, moved = unfold.unfolded(Surface(points, good.triangles))
        self.assertFalse(unfold.folded(flat.points, flat.triangles).any())
        self.assertLess(moved, 100)


class Openings(unittest.TestCase):
    def test_small_holes_are_filled_and_tears_refused(self):
        good = pipe(24, 40, 1.0, 12.0)
        middle = good.points[good.triangles].mean(axis=1)
        hole = good.take(~((middle[:, 0] > 0.93) & (np.abs(middle[:, 2] - 6.0) < 0.2)))
        mended, found = rims.openings(repair.mended(hole, "pipe", silent), "pipe", silent)
        self.assertEqual((len(found), len(base.loops(mended.triangles))), (2, 2))
        tear = good.take(~((middle[:, 0] > 0.6) & (np.abs(middle[:, 2] - 6.0) < 2.0)))
        with self.assertRaisesRegex(BadSurface, "torn open") as caught:
            rims.openings(repair.mended(tear, "pipe", silent), "pipe", silent)
        self.assertLess(np.linalg.norm(caught.exception.place - [0.85, 0, 6]), 0.2)

    def test_flat_caps_of_voxels_are_found_and_plateaus_left(self):
        self.assertEqual(self.ends_of(shapes.fork(), 0.5), 3)

    def test_plateaus_beside_the_end_of_a_branch_of_two_voxels_are_no_caps(self):
        lines = shapes.of_seed(108)
        self.assertEqual(self.ends_of(lines, lines[0][1][0] / 4), 5)

    def test_closed_surface_with_a_small_hole_loses_its_caps(self):
        self.assertEqual(self.ends_of(shapes.fork(), 0.5, lost=2000), 3)

    def ends_of(self, lines, voxel, lost=None):
        """How many openings are left of a closed surface, which may have lost a triangle."""
        from vtkmodules.util.numpy_support import vtk_to_numpy
        found = shapes.surface(lines, voxel, closed=True).GetOutput()
        surface = Surface(vtk_to_numpy(found.GetPoints().GetData()).astype(float),
                          vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(np.int64))
        surface = repair.mended(surface, "voxels", silent)
        if lost is not None:
            surface = surface.take(np.arange(len(surface.triangles)) != lost)
        wall, _ = make.without_caps(surface, "voxels", argparse.Namespace(say=silent))
        return len(openings(wall))

    def test_oblique_ends_are_cut_square(self):
        tilted = pipe(32, 48, 1.0, 8.0)
        tilted.points[:, 2] += 0.4 * tilted.points[:, 0] * (tilted.points[:, 2] - 4.0) / 4.0
        cut, found = ends.cut(tilted, openings(tilted), "pipe", silent)
        for rim in found:
            self.assertGreater(abs(rim.normal[2]), 0.999)
            self.assertLess(np.ptp(cut.points[rim.loop] @ rim.normal), 1e-9)

    def test_names_belong_to_the_nearest_opening(self):
        found = names.settle(openings(pipe()), [], "n.csv", 1.0, [("in", np.array([0, 0, -0.3]))])
        self.assertEqual(sorted(rim.name for rim in found), ["in", "opening-1"] if found[0].name != "in" else ["in", "opening-2"])
        with self.assertRaisesRegex(BadMesh, "near no opening"):
            names.settle(openings(pipe()), [], "n.csv", 1.0, [("in", np.array([0, 0, -30.0]))])

    def test_crossings_are_found_and_neighbours_are_none(self):
        good = pipe(16, 12)
        self.assertEqual(len(crossings.crossing(good.points, good.triangles)), 0)
        points = np.vstack([good.points, [[0, 0, 3.02], [3, 0.1, 3.04], [3, 0.2, 3.5]]])
        through = np.vstack([good.triangles, [[len(points) - 3, len(points) - 2, len(points) - 1]]])
        self.assertGreater(len(crossings.crossing(points, through)), 0)


class Sizes(unittest.TestCase):
    def test_balls_and_line_of_a_tube(self):
        tube = pipe(32, 60, 2.0, 16.0)
        found = openings(tube)
        for number, rim in enumerate(found, 1):
            rim.name = f"opening-{number}"
        balls = medial.balls(tube, found)
        self.assertLess(np.abs(balls.of_vertex - 2.0).max(), 0.06)
        (branch,) = centreline.branches(balls, found, "tube")
        self.assertEqual((branch.start, branch.end), ("opening-1", "opening-2"))
        self.assertLess(np.abs(branch.points[:, :2]).max(), 0.1)

    def test_branch_leaves_its_trunk_without_a_kink(self):
        x = np.arange(0.0, 12.0, 0.2)
        trunk = np.column_stack([x, 0 * x, 0 * x, 1.0 + 0 * x])
        leaving = np.column_stack([x, 0.6 * np.maximum(x - 3.0, 0), 0 * x, 0.8 + 0 * x])  # 31 degrees
        rim = lambda name: type("Rim", (), {"name": name})  # noqa: E731
        found = centreline.tree([trunk, leaving], [rim("in"), rim("ahead"), rim("aside")])
        self.assertEqual([(b.start, b.end) for b in found], [("in", "junction-1"), ("junction-1", "ahead"), ("junction-1", "aside")])
        self.assertLess(np.abs(found[2].points[0] - found[0].points[-1]).max(), 1e-12)
        self.assertAlmostEqual(found[0].points[-1, 0], 3.4, delta=0.3)  # a little behind where the lines part
        for points, most in ((found[2].points, 5.0), (np.vstack([found[0].points, found[2].points[1:]]), 35.0)):
            ways = np.diff(points, axis=0)
            ways /= np.linalg.norm(ways, axis=1)[:, None]
            turn = np.degrees(np.arccos(np.clip((ways[1:] * ways[:-1]).sum(axis=1), -1, 1)))
            self.assertLess(turn.max(), most)
        self.assertLess(np.abs(found[2].points[-1] - leaving[-1, :3]).max(), 1e-12)

    def test_labels_do_not_overlap(self):
        random = np.random.default_rng(3)
        anchors = (random.normal(0, 15, (10, 2)) + (300, 200)).tolist()
        boxes = labels.places(anchors, [(60, 14)] * 10, (600, 400))
        for k, (x, y, w, h) in enumerate(boxes):
            self.assertTrue(0 <= x and x + w <= 600 and 0 <= y and y + h <= 400)
            for u, v, a, b in boxes[:k]:
                self.assertTrue(x + w <= u or u + a <= x or y + h <= v or v + b <= y)
        self.assertIsNone(labels.places([(5, 5)], [(60, 14)], (50, 50))[0])

    def test_edits_keep_a_surface_whole(self):
        tube = pipe(32, 60, 2.0, 16.0)
        for size in (0.2, 0.9):
            points, triangles, sizes = tube.points, tube.triangles, np.full(len(tube.points), size)
            points, triangles, sizes = edits.split(points, triangles, sizes, 4.0 / 3.0)
            points, triangles, sizes = edits.contract(points, triangles, sizes, 0.8, np.random.default_rng(1))
            triangles = edits.turn(points, triangles)
            edges = base.Edges(triangles)
            self.assertEqual(int(edges.count.max()), 2)
            self.assertEqual(len(base.loops(triangles)), 2)
            self.assertEqual(len(points) - len(edges.count) + len(triangles), 0)
            self.assertGreater(base.gammas(points, triangles).min(), 0.02)

    def test_volume_is_kept_with_the_rims_in_their_planes(self):
        tube = pipe(24, 24, 1.0, 6.0)
        wider = smooth.with_volume(tube, 19.5, rims=openings(tube))
        self.assertAlmostEqual(base.volume(*base.closed(wider)), 19.5, delta=0.01)
        self.assertEqual(sorted(set(np.round(wider.points[:24, 2], 12))), [0.0])


class Layers(unittest.TestCase):
    def test_layers_conform_and_lie_in_the_planes_of_openings(self):
        tube = pipe(24, 24, 1.0, 6.0)
        found = [dataclasses.replace(rim, normal=np.array([0, 0, np.sign(rim.normal[2])])) for rim in openings(tube)]
        layering = volume.Layering(layers=3, growth=1.3)
        grown = layers.grow(tube, found, np.full(len(tube.points), 0.052), np.full(len(tube.points), 1.0), layering, silent)
        self.assertGreater(quality.six_volumes(grown.points, grown.tets).min(), 0.0)
        from importer.faces import Faces
        faces = Faces("layers", grown.points, grown.tets)
        strips = np.concatenate([layers.strips(rim.loop, len(tube.points), 3) for rim in found])
        self.assertTrue(faces.is_outer[faces.find(strips)].all() and (faces.find(strips) >= 0).all())
        self.assertEqual(int(faces.is_outer.sum()), 2 * len(tube.triangles) + len(strips))
        self.assertLess(np.ptp(grown.points[strips[:len(strips) // 2].reshape(-1), 2]), 1e-9)


if __name__ == "__main__":
    cases.run()
