"""From the case to its page: the plan, the runs, the errors."""
import os

from vessel.errors import BadInput
from vessel.folder import hold, write_atomically
from vessel.programs import Programs

from . import fields, meshes, page, plan, runs, table
from .case import Case
from .plan import MESH, Plan
from .quantities import Curves
from .result import Results
from .runs import Runs


class Certificate:
    """One case in one folder."""

    def __init__(self, options):
        self.options, self.folder = options, options.output
        self.programs = Programs(options.programs)
        runs.check_folder(self.folder, options.overwrite)
        self.case = Case(options.case, options.settings, self.programs)
        self.remarks = []

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def tell_plan(self):
        """Makes nothing, so that a mesh in another format cannot be counted."""
        mesh = self.case.mesh()
        if not mesh.endswith(".h5"):
            raise BadInput(f"{mesh}: --dry-run counts the elements of a mesh in HDF5 only. Convert it: tunica-mesh convert {mesh} MESH.h5")
        planned = self._plan(mesh)
        print("\n".join(planned.lines(planned.choose()) + planned.remarks))

    def make(self):
        lock = hold(self.folder, runs.LOCK, "tunica-certify")
        try:
            self._make()
        finally:
            lock.close()

    def _make(self):
        runs.open_folder(self.folder, self.case, runs.identity_of(self.case, self.case.mesh()), self.options.overwrite)
        mesh = meshes.as_hdf5(self.case.mesh(), self.path(runs.MESHES), self.programs, self.path(runs.MESHES, "meshes.log"))
        planned, made = self._plan(mesh), Runs(self.folder, self.case, self.options, self.programs)
        jobs = self._make_runs(planned, made)
        done = [job for job in jobs if job.name not in made.failed]
        self.remarks += planned.remarks + [f"{name}: not used. {reason}" for name, reason in made.failed.items()]
        self._tell(Results(self.case, done, made.results, self.options.period or self.case.period()), made)

    def _plan(self, mesh):
        self.smooth = meshes.smooth_names(self.options.smooth, mesh)
        for path in filter(None, (self.options.coarser, self.options.finer)):
            meshes.check_same_names(path, mesh)
        return Plan(self.case, self.options, mesh, self.path(runs.MESHES))

    def _make_runs(self, planned, made):
        """With a budget the case comes first: it shows what a run takes."""
        prepare = lambda job: self._refine(planned, job)  # noqa: E731
        print("\n".join(planned.lines(planned.choose())), flush=True)
        spent = 0.0
        if self.options.budget is not None:
            made.make([planned.base], prepare)
            spent = planned.case_seconds = Curves(made.results(planned.base)).seconds
        jobs = planned.choose(spent)
        made.make(jobs, prepare)
        if plan.SOLVER in made.failed:
            print("  a tenth of the tolerances is beyond reach; ten times as much shows the error of the solvers, too", flush=True)
            jobs = [*jobs, planned.looser()]
            made.make(jobs[-1:], prepare)
        return jobs

    def _refine(self, planned, job):
        """The mesh of a job; of that with h/4 that with h/2 before it."""
        if job.cause != MESH or not job.mesh.startswith(planned.folder):
            return
        log = self.path(runs.MESHES, "meshes.log")
        path, times = planned.mesh, 1
        while path != job.mesh:
            target = planned.refined(times)
            self.remarks += [remark for remark in meshes.refined(path, target, self.smooth, self.programs, log) if remark not in self.remarks]
            path, times = target, times + 1

    def _tell(self, results, made):
        self.remarks += [f"{job.name}: not used. It ends before the case does." for job in results.too_short]
        print("  fields and page", flush=True)
        field_rows = fields.rows_of(results, made.results, self.options.fields)
        shown = [row for row in results.rows if not table.is_zero(row)] + field_rows
        print("\n".join(table.lines(shown, results.causes())))
        for remark in self.remarks:
            print(f"note: {remark}")
        write_atomically(self.path(table.FILE), table.as_csv(results.rows + field_rows, results.causes()))
        write_atomically(self.path("curves.csv"), table.curves_as_csv(results.curves))
        where = page.write(results, results.rows, field_rows, self.remarks, self.path("report"))
        print(f"{where}: {len(results.rows)} numbers and {len(field_rows)} fields with their errors")
