"""Which runs are made, what they take, and which of them can be had."""
import math
import os
from dataclasses import dataclass, field

from vessel.errors import BadInput
from vessel.folder import hash_of, hash_of_file
from vessel.plan import MB_A_TETRAHEDRON, MB_OF_PROGRAM, SECONDS_A_TETRAHEDRON, duration_text

from . import meshes

BASE, MESH, STEP, SOLVER, BEAT = "case", "mesh", "step", "solver", "beat"
LOOSE = "solver-loose"  # where a tenth of the tolerances is beyond reach
# Costs against the case: eight times as many elements take somewhat more than eight times as long.
LEAST_FACTOR = 1.2  # between the sizes of two meshes
OF_REFINEMENT, OF_SHORTER_STEPS, OF_TENTH = 9.0, 0.95, 1.4


@dataclass(eq=False)
class Job:
    """One run; size is that of its mesh, its steps or its tolerances against those of the case."""
    name: str
    cause: str
    size: float = 1.0
    cost: float = 1.0  # against the case
    mesh: str = ""     # file, of the case where empty
    settings: list = field(default_factory=list)
    steps: int = 0     # nearly; 0 where nobody knows
    tetrahedra: int = 0

    def seconds(self, of_case):
        return self.cost * of_case


class Plan:
    """The jobs, most telling ones first, and why others are not among them."""

    def __init__(self, case, options, mesh, folder):
        self.case, self.options, self.mesh, self.folder = case, options, mesh, folder
        self.remarks = []
        self.tetrahedra = meshes.count(mesh)
        steps = case.steps() if case.control == "fixed" else 0
        self.case_seconds = SECONDS_A_TETRAHEDRON * self.tetrahedra / options.ranks * (steps or 100)
        self.base = Job(BASE, BASE, steps=steps, tetrahedra=self.tetrahedra)
        self.jobs = self._within_memory([self.base, *self._solver(steps), *self._shorter_steps(steps, 2), *self._other_meshes(steps),
                                         *self._shorter_steps(steps, 4), *self._finest_mesh(steps)])

    def _side(self, *arguments, settings=(), **more):
        return Job(*arguments, settings=[*settings, *self.case.output_at_end()], **more)

    def _solver(self, steps):
        return [self._side(SOLVER, SOLVER, 0.1, OF_TENTH, settings=self.case.with_tolerances(0.1), steps=steps,
                           tetrahedra=self.tetrahedra)]

    def looser(self):
        job = self._solver(self.base.steps)[0]
        return self._side(LOOSE, SOLVER, 10.0, 1.0, settings=self.case.with_tolerances(10.0), steps=job.steps,
                          tetrahedra=self.tetrahedra)

    def _shorter_steps(self, steps, factor):
        most = {1: 1, 2: 2, 3: 4}[self.options.steps or 3]
        if not self.case.varies_in_time() or factor > most:
            return []
        return [self._side(f"step-{factor}", STEP, 1 / factor, OF_SHORTER_STEPS * factor, settings=self.case.finer_step(factor),
                           steps=steps * factor, tetrahedra=self.tetrahedra)]

    def _shape(self):
        """Meshes of other shapes have other names."""
        return f"-smooth-{hash_of(sorted(self.options.smooth.split(',')))[:4]}" if self.options.smooth else ""

    def refined(self, times):
        return os.path.join(self.folder, f"refined-{2 ** times}{self._shape()}.h5")

    def _refined_job(self, steps, times):
        path = self.refined(times)
        return self._side(f"mesh-{2 ** times}{self._shape()}", MESH, 0.5 ** times, OF_REFINEMENT ** times, path,
                          settings=[f"Mesh/file={os.path.abspath(path)}"], steps=steps, tetrahedra=8 ** times * self.tetrahedra)

    def _given(self, name, path, steps):
        """A mesh of the user."""
        size = meshes.relative_size(path, self.mesh)
        is_finer, factor = name == "finer", 1 / size if name == "finer" else size
        if factor < LEAST_FACTOR:
            raise BadInput(f"--{name} {path}: its elements are {size:.2f} times as large as those of the case, expected at "
                           + (f"most 1/{LEAST_FACTOR:g}" if is_finer else f"least {LEAST_FACTOR:g}"))
        return self._side(f"mesh-{name}-{hash_of_file(path)[:6]}", MESH, size, OF_REFINEMENT ** -math.log2(size), path,
                          settings=[f"Mesh/file={path}"], steps=steps, tetrahedra=meshes.count(path))

    def _other_meshes(self, steps):
        given = [self._given(name, path, steps) for name, path in (("coarser", self.options.coarser), ("finer", self.options.finer)) if path]
        is_refined = (self.options.levels or 2) > 1 and not self.options.finer
        return given + ([self._refined_job(steps, 1)] if is_refined else [])

    def _finest_mesh(self, steps):
        is_wanted = self.options.levels == 3 or (self.options.levels is None and self.options.budget is not None)
        return [self._refined_job(steps, 2)] if is_wanted and not self.options.finer else []

    def _memory(self, job):
        return MB_OF_PROGRAM * self.options.ranks + MB_A_TETRAHEDRON * job.tetrahedra

    def _within_memory(self, jobs):
        """Leaves out what this machine cannot hold."""
        there = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e6
        for job in [job for job in jobs if self._memory(job) > there]:
            self.remarks.append(f"{job.name}: needs about {self._memory(job) / 1000:.1f} GB, this machine has {there / 1000:.1f} GB.")
        return [job for job in jobs if self._memory(job) <= there]

    def slots(self):
        return max(1, self.options.cores // self.options.ranks)

    def duration(self, jobs):
        """Of jobs side by side [s], roughly: all of their work, and no less than the longest."""
        all_of_them = [job.seconds(self.case_seconds) for job in jobs]
        return max([sum(all_of_them) / self.slots(), *all_of_them], default=0.0)

    def choose(self, done_seconds=0.0):
        """The jobs that fit into the budget, of which so much is spent."""
        if self.options.budget is None:
            return self.jobs
        chosen, left = [], 3600 * self.options.budget - done_seconds
        for job in self.jobs:
            if self.duration(chosen + [job]) <= left or job is self.base:
                chosen.append(job)
            else:
                self._remark(f"{job.name}: about {duration_text(job.seconds(self.case_seconds))} on {self.options.ranks} core(s), which "
                             f"the budget of {self.options.budget:g} h does not permit.")
        if not any(job.cause == MESH for job in chosen):
            self._remark("No second mesh: the errors have no part of the mesh. Nothing here can remesh a surface coarser; give a coarser "
                         "mesh of the same vessel with --coarser (of a vessel of tunica-vessel or tunica-mesh lumen: half of its "
                         "--across), or a larger budget.")
        return chosen

    def _remark(self, text):
        if text not in self.remarks:
            self.remarks.append(text)

    def lines(self, jobs):
        """What will be done, how long, and how large."""
        steps = lambda job: f"{job.steps} steps" if job.steps else "steps as needed"  # noqa: E731
        found = [f"{job.name:13} {job.tetrahedra:>10} tetrahedra, {steps(job)}, about {self._memory(job) / 1000:.1f} GB, "
                 f"{duration_text(job.seconds(self.case_seconds))}" for job in jobs]
        return found + [f"all: about {duration_text(self.duration(jobs))}, {self.slots()} at a time on {self.options.cores} core(s)"]
