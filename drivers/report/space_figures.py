"""Pictures of the vessel in space, from two sides. Functions are as those of section_figures.py."""
import numpy as np
from matplotlib import cm
from matplotlib import pyplot as plt

from report import case_tables, render
from report.canvas import Figure, colour_scale
from report.section import norm_of
from report.space import Scene, Stage

GREY = np.array([0.82, 0.80, 0.78])
# Array -> words and unit; one that is not here is shown under its own name.
WORDS = {"wall_shear_stress": "wall shear stress [kPa]", "time_averaged_wss": "time-averaged wall shear stress [kPa]",
         "oscillatory_shear_index": "oscillatory shear index [1]",
         "relative_residence_time": "relative residence time [1/kPa]"}
AVERAGES = ("time_averaged_wss", "oscillatory_shear_index", "relative_residence_time")
# Arrays of the wall: name, title, label.
STRESSES = (("von_mises", "Von Mises stress", "von Mises stress [kPa]"),
            ("largest_principal_stress", "Largest principal stress", "largest principal stress [kPa]"),
            ("fibre_stress", "Stress along the fibres", "stress along fibres [kPa]"),
            ("stress_error", "Estimated error of the elements' stress", "estimated error [kPa]"))
CUT_OPEN = [name for name, _, _ in STRESSES]
MOST_FURTHER = 6


def words(name):
    return WORDS.get(name, name.replace("_", " "))


def magnitude(values):
    return norm_of(values) if values.ndim == 2 and values.shape[1] > 1 else values.reshape(len(values))


class SpacePictures:
    """Scenes of the output in which the displacement is greatest; averages over time are those of the last one."""

    def __init__(self, run, surfaces, outputs, factor, plane):
        size = lambda group: max(norm_of(run.displacement(group, g)).max() for g in run.grids())  # noqa: E731
        self.run, self.surfaces, self.factor = run, surfaces, factor
        (self.time, group), (self.end, last) = max(outputs, key=lambda o: size(o[1])), outputs[-1]
        self.plane = plane
        self.stage = Stage(run, group, factor, plane)
        self.at_end = self.stage if last == group else Stage(run, last, factor, plane)
        self.scenes, self.bars, self.titles = {}, {}, {}
        self._wall()
        self._lumen()

    def _add(self, name, title, scene, scale):
        self.scenes[name], self.titles[name], self.bars[name] = scene, title, scale

    def _colours(self, values, label, cmap):
        """At all points, and what a colour bar needs."""
        norm = colour_scale(values)
        return plt.get_cmap(cmap)(norm(values))[:, :3], (norm, cmap, label)

    def _wall(self):
        if self.surfaces.wall is None:
            return
        group = self.stage.group
        size = norm_of(self.run.displacement(group, "wall"))
        colours, bar = self._colours(size, "displacement [mm]", "viridis")
        self._add("displacement", "Displacement of the wall",
                  Scene([self.stage.surface("wall", self.surfaces.wall, colours)]), bar)
        for name, title, label in STRESSES:
            stress = self.run.nodal(group, "wall", name)
            if stress is not None:
                colours, bar = self._colours(stress, label, "YlOrRd")
                self._add(name, title + " in the wall, cut open",
                          Scene([self.stage.half("wall", self.surfaces.wall, colours), self.stage.cut("wall", colours)]),
                          bar)

    def _lumen(self):
        lumen, group = self.surfaces.lumen, self.stage.group
        if lumen is None:
            return
        at_wall = "on the interface" if self.surfaces.wall is not None else "on the boundary"
        pressure = self.run.nodal(group, "fluid", "pressure")
        if pressure is not None:
            colours, bar = self._colours(pressure.reshape(-1), "pressure [kPa]", "cividis")
            self._add("pressure", f"Pressure {at_wall}", Scene([self.stage.surface("fluid", lumen, colours)]), bar)
        if self.run.nodal(group, "fluid", "velocity") is not None:
            self._velocity(group)
        for name in self.run.further_arrays("fluid")[:MOST_FURTHER]:
            stage = self.at_end if name in AVERAGES else self.stage
            values = self.run.nodal(stage.group, "fluid", name)
            if values is None or not np.isfinite(values).any():
                continue
            on_lumen = np.full(len(values), np.nan)
            on_lumen[lumen.nodes] = magnitude(values)[lumen.nodes]
            colours, bar = self._colours(on_lumen, words(name), "inferno")
            title = words(name).split(" [")[0]
            self._add(name, f"{title[0].upper()}{title[1:]} {at_wall}",
                      Scene([stage.surface("fluid", lumen, colours)]), bar)

    def _velocity(self, group):
        speed = norm_of(self.run.nodal(group, "fluid", "velocity"))
        colours, bar = self._colours(speed, "velocity [mm/ms]", "viridis")
        pieces = [self.stage.cut("fluid", colours)]
        if self.surfaces.wall is not None:
            grey = np.tile(GREY, (len(self.run.mesh("wall")[0]), 1))
            pieces += [self.stage.half("wall", self.surfaces.wall, grey), self.stage.cut("wall", 0.85 * grey)]
        self._add("velocity", "Velocity in the cut", Scene(pieces, self.stage.arrows()), bar)

    def jobs(self):
        if not self.scenes:
            return []
        boxes = [view.box(self.scenes.values()) for view in self.stage.views]
        sights = {(name, k): (view, boxes[k]) for name in self.scenes for k, view in enumerate(self.stage.views)}
        pictures, reason = render.by_vtk(self.scenes, sights)
        if pictures is None:
            self.run.remarks.append(f"Pictures in space are drawn by Matplotlib, as {reason}; with the packages "
                                    "python3-vtk9 and xvfb they are finer.")
        return [lambda n=n: self._figure(n, boxes, pictures) for n in self.scenes]

    def _figure(self, name, boxes, pictures):
        canvas, panels = _panels(boxes)
        for k, (axes, box) in enumerate(zip(panels, boxes)):
            if pictures is None:
                render.by_matplotlib(axes, self.scenes[name], self.stage.views[k])
            else:
                axes.imshow(pictures[name, k], extent=box, interpolation="antialiased")
            axes.set(xlim=box[:2], ylim=box[2:], aspect="equal")
            axes.axis("off")
        _scale_bar(panels[0], boxes[0])
        norm, cmap, label = self.bars[name]
        canvas.colorbar(cm.ScalarMappable(norm, cmap), ax=panels, location="right", pad=0.02, aspect=24, fraction=0.04,
                        shrink=0.85, extend="max" if norm.vmin == 0 else "both", label=label)
        magnified = f"displacement magnified {self.factor:g} times"
        drawn = "true to scale" if self.factor == 1 else magnified
        if name in AVERAGES:
            when, more = self._averaged()
            text = f"Deformed, {drawn}, at the last output shown; from two sides.{more}"
        else:
            when = f"t = {self.time:g} ms"
            text = f"Deformed, {drawn}, at the output of greatest displacement; from two sides."
        canvas.suptitle(f"{self.titles[name]}, {when}" + (f" ({magnified})" if self.factor != 1 else ""), fontsize=13)
        if name == "velocity" or name in CUT_OPEN:
            text += f" The cut is that of {self.plane.option()}."
        if name == "fibre_stress":
            text += " Of two families the greater."
        if name == "velocity":
            text += " Arrows begin where they are drawn; the longest one is the greatest velocity in the cut."
        return canvas, Figure(f"space_{name}.png", self.titles[name], text)

    def _averaged(self):
        """Over what, for the title and for the text."""
        case = case_tables.read_case(self.run.folder)
        begin, period = case_tables.averages_from(case), case_tables.period(case)
        over = f"averaged from {begin:g} to {self.end:g} ms"
        if period and self.end - begin < period * (1 - 1e-9):
            return over, f" It is {over}, less than one period of {period:g} ms."
        return over, f" It is {over}."


def _panels(boxes):
    """Long vessels one below the other, others side by side; widths in proportion."""
    sizes = [(b[1] - b[0], b[3] - b[2]) for b in boxes]
    is_long = sizes[0][1] < 0.4 * sizes[0][0]
    if is_long:
        scale = 9.0 / max(w for w, _ in sizes)
        canvas, panels = plt.subplots(2, 1, layout="constrained", height_ratios=[h for _, h in sizes],
                                      figsize=(10.5, max(3.6, scale * sum(h for _, h in sizes) + 0.9)))
    else:
        scale = 9.6 / sum(w for w, _ in sizes)
        canvas, panels = plt.subplots(1, 2, layout="constrained", width_ratios=[w for w, _ in sizes],
                                      figsize=(11.0, max(3.6, scale * max(h for _, h in sizes) + 0.9)))
    return canvas, list(panels)


def _scale_bar(axes, box):
    """A round length near a fifth of the width."""
    wanted = 0.2 * (box[1] - box[0])
    power = 10 ** np.floor(np.log10(wanted))
    length = power * max(d for d in (1, 2, 5) if d * power <= wanted)
    left, bottom = box[0] + 0.02 * (box[1] - box[0]), box[2] + 0.01 * (box[1] - box[0])
    axes.plot([left, left + length], [bottom, bottom], color="#333333", linewidth=2, solid_capstyle="butt")
    axes.annotate(f"{length:g} mm", (left + length / 2, bottom), xytext=(0, 3), textcoords="offset points", ha="center",
                  fontsize=9.5, color="#333333")
