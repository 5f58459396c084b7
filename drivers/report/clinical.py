"""What a clinician asks of a vessel with a beat: tables in mmHg, ml/s and l/min beside the units of the case. Definitions
are in docs/results.md."""
import importlib.util
import json
import os
import shutil

from report import assumptions, beat_figures, flow_tables, quality_tables, wall_stress, wall_tables
from report import beat as beats
from report.canvas import Figure
from report.case_tables import averages_from, read_case
from report.parts import Parts
from report.tables import Table

TOLD, LUMEN = "vessel.json", "lumen.png"  # what tunica-vessel puts beside the run: what it knows, and the lumen's mesh


class Clinic:
    """Tables and figures of the last beat; parts is None where there are no fields of a fluid."""

    def __init__(self, run, case, beat, told):
        self.run, self.case, self.beat, self.told = run, case, beat, told
        has_fields = run.fields is not None and "fluid" in run.grids()
        self.parts = Parts(run, beat) if has_fields else None
        self.tables = [table for table in self._tables() if table is not None]

    def _tables(self):
        run, beat, told = self.run, self.beat, self.told
        if "verdict" in told:
            yield Table("Goal", "", [], [told["verdict"]])
        yield flow_tables.pressures(beat, told)
        yield flow_tables.flows(beat, told)
        yield flow_tables.windkessels(beat, self.case, told)
        yield flow_tables.pulse_waves(beat, self.parts.ways if self.parts else {})
        change = kinetic = None
        if self.parts:
            fields = wall_tables.BeatFields(run, beat, self.parts, self._density())
            change = wall_tables.wss_change(fields)
            kinetic = self._kinetic(fields)
            yield from self._of_fields(fields)
        yield flow_tables.periodicity(beat, change)
        if "beats" in told:
            yield Table("Beats", told["beats"]["note"], told["beats"]["heading"], told["beats"]["rows"])
        yield flow_tables.mass(beat)
        yield flow_tables.energy(beat, kinetic)
        through = quality_tables.through_wall(run, self.parts) if self.parts else None
        if self.parts:
            yield quality_tables.openings(self.parts)
            yield quality_tables.quality(run, beat, through)
        yield Table("Assumed", "", [], [*told.get("assumed", []), *assumptions.sentences(self.case, beat, run.record)])
        yield Table("Doubtful", "", [], [*told.get("doubtful", []), *quality_tables.doubts(beat, self.parts, through)] or ["Nothing."])

    def _density(self):
        return float(assumptions.value(self.case, ["Fluid"], "density", 1.0))

    def _kinetic(self, fields):
        """Energy that flows in where the case prescribes velocities: from the outputs, as no column has it."""
        condition = flow_tables.numbers_of(self.case, self.beat.inlet).get("condition")
        return wall_tables.kinetic_inflow(fields) if condition in flow_tables.PRESCRIBED else None

    def _of_fields(self, fields):
        yield wall_tables.averages(fields, averages_from(self.case))
        if not fields.outputs:
            return
        yield wall_tables.peaks(fields)
        rest, volumes = wall_tables.diastole(fields)
        if len(self.run.grids()) > 1:
            yield wall_tables.motion(fields, volumes, rest)
            yield wall_tables.distensibility(fields, volumes)
            yield wall_stress.of_beat(self.run, fields.outputs, self.beat.start, self.parts.branch_at)

    def figures(self):
        """Jobs of canvas.save()."""
        return beat_figures.jobs(self.beat, self.told)

    def pictures(self, folder):
        """Figures that lie beside the run; copies of them go to that folder."""
        path = os.path.join(self.run.folder, LUMEN)
        if not os.path.exists(path):
            return []
        shutil.copyfile(path, os.path.join(folder, LUMEN))
        return [Figure(LUMEN, "The mesh of the lumen", "With the names of its openings, its centreline and sections.")]


def read_told(folder):
    try:
        with open(os.path.join(folder, TOLD), encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError):
        return {}


def of_run(run):
    """None where the run is no vessel with a beat."""
    case, told = read_case(run.folder), read_told(run.folder)
    beat = beats.of_run(run, case, told) if case is not None else None
    if beat and importlib.util.find_spec("scipy") is None:
        run.remarks.append("The tables of the beat need SciPy: install python3-scipy.")
        return None
    return Clinic(run, case, beat, told) if beat else None
