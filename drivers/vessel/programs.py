"""Starts the other programs of the suite, which stand beside this one."""
import ctypes
import os
import shutil
import signal
import subprocess
import sys
import time

from .errors import BadInput, NotConverged, nearest

# As cmake/setup.sh sets them: ranks that share cores, as root in a container too.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
       "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
       "OMPI_MCA_mpi_yield_when_idle": "1", "OMP_NUM_THREADS": "1"}
PROGRESS_SECONDS = 10


def end_with_parent():
    """Of a child: it is asked to end when this program is killed, so that the folder is free for the next one."""
    try:
        ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG, on Linux
    except (OSError, AttributeError):
        pass


class Programs:
    """Finds the programs in one folder."""

    def __init__(self, folder):
        self.folder = folder or os.path.dirname(os.path.abspath(sys.argv[0]))

    def path(self, name):
        path = os.path.join(self.folder, name)
        if not os.access(path, os.X_OK):
            entries = os.listdir(self.folder) if os.path.isdir(self.folder) else []
            there = [entry for entry in entries if entry.startswith("tunica-")]
            hint = nearest(name, there) if there else "--programs names their folder."
            raise BadInput(f"{path}: there is no such program. {hint}")
        return path

    def command(self, words, ranks=1):
        command = [self.path(words[0])] + [str(word) for word in words[1:]]
        if ranks > 1:
            if shutil.which("mpirun") is None:
                raise BadInput(f"--ranks is {ranks}, but there is no mpirun in the path")
            command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
        return command

    def start(self, words, log, ranks=1):
        """Starts it and returns the child; its lines go to the file `log`."""
        command = self.command(words, ranks)
        with open(log, "a", encoding="utf-8") as file:
            file.write("$ " + " ".join(command) + "\n")
            file.flush()
            return self._open(command, file)

    @staticmethod
    def _open(command, output):
        return subprocess.Popen(command, env={**os.environ, **MPI}, text=True, errors="replace", stdin=subprocess.DEVNULL,
                                stdout=output, stderr=subprocess.STDOUT, preexec_fn=end_with_parent)

    def run(self, words, log, ranks=1, shown=False):
        """Runs until it ends; its lines go to the file `log`, and to the screen if shown. Returns the exit status."""
        command = self.command(words, ranks)
        with open(log, "a", encoding="utf-8") as file:
            file.write("$ " + " ".join(command) + "\n")
            file.flush()
            child = self._open(command, subprocess.PIPE if shown else file)
            try:
                self._follow(child, file, shown, words)
            except KeyboardInterrupt:
                child.wait()  # Ctrl-C has reached it too, and it writes a checkpoint
                raise
            finally:
                if child.poll() is None:
                    child.terminate()
            return child.wait()

    def output_of(self, words):
        """Exit status and all that a short command prints."""
        done = subprocess.run(self.command(words), env={**os.environ, **MPI}, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        return done.returncode, done.stdout

    def _follow(self, child, file, shown, words):
        if shown:
            for line in child.stdout:
                file.write(line)
                file.flush()
                print("  " + line, end="", flush=True)
            return
        start = last = time.time()
        while child.poll() is None:
            time.sleep(0.05)
            if time.time() - last > PROGRESS_SECONDS:
                last = time.time()
                print(f"  {' '.join(words[:2])}: {last - start:.0f} s", flush=True)

    def must(self, words, log):
        """As run(); a failure is an error that quotes the last line of the program."""
        status = self.run(words, log)
        if status == 0:
            return
        reason = f"{' '.join(words[:2])} ended with status {status}: {last_line(log)} (all in {log})"
        raise NotConverged(reason) if status == 2 else BadInput(reason) if status == 1 else RuntimeError(reason)


def last_line(log):
    with open(log, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip() and not line.startswith("$ ")]
    told = [line for line in lines if line.startswith("tunica-")]
    return (told or lines or ["nothing was printed"])[-1]
