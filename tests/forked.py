"""Programs in Python, each run in a fork of this process, which has read their modules before: that takes longer than most of
what tests ask of them. The first run of each is a process of its own, as users start it."""
import os
import runpy
import subprocess
import sys
import tempfile
import traceback


class Program:
    """A script. Its modules are read where it is made; further ones, that it reads when it needs them, are named."""

    def __init__(self, path, *further):
        self.path, self.has_run = path, False
        sys.path.insert(0, os.path.dirname(os.path.realpath(path)))  # as Python does for the script
        runpy.run_path(path, run_name="read")
        for module in further:
            __import__(module)

    def run(self, words, cwd=None, env=None, prepare=None):
        """As subprocess.run() leaves it; prepare() is called in the fork before."""
        words = [self.path, *map(str, words)]
        if prepare is None and not self.has_run:
            self.has_run = True
            return subprocess.run(words, cwd=cwd, env=env, capture_output=True, text=True, check=False)
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            sys.stdout.flush()
            sys.stderr.flush()
            child = os.fork()
            if child == 0:
                self._become(words, (out.fileno(), err.fileno()), cwd, env, prepare)
            _, state = os.waitpid(child, 0)
            for file in (out, err):
                file.seek(0)
            return subprocess.CompletedProcess(words, os.waitstatus_to_exitcode(state), out.read().decode(), err.read().decode())

    def _become(self, words, outputs, cwd, env, prepare):
        """Never returns."""
        status = 1
        try:
            for target, output in zip((1, 2), outputs):
                os.dup2(output, target)
            if cwd is not None:
                os.chdir(cwd)
            if env is not None:
                os.environ.clear()
                os.environ.update(env)
            if prepare is not None:
                prepare()
            sys.argv = words
            runpy.run_path(self.path, run_name="__main__")
            status = 0
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
