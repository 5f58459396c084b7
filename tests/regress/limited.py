"""Runs a program with at most so many bytes of address space, or, for 0, without a limit and writes
the largest it had to the file. Memory has one arena: each other one that glibc may open for a thread
reserves 64 MB of addresses whether or not anything is stored there.

Usage: limited.py BYTES FILE PROGRAM [WORD ...]
"""
import os
import pathlib
import resource
import subprocess
import sys
import time


def peak_of(process):
    """VmPeak in bytes; 0 when the process has ended."""
    try:
        lines = pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines()
    except FileNotFoundError:
        return 0
    return max((1024 * int(line.split()[1]) for line in lines if line.startswith("VmPeak")), default=0)


def measured(words, file):
    process = subprocess.Popen(words)
    peak = 0
    while process.poll() is None:
        peak = max(peak, peak_of(process))
        time.sleep(0.002)
    file.write_text(str(peak))
    return process.returncode


if __name__ == "__main__":
    limit, file, words = int(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3:]
    os.environ["MALLOC_ARENA_MAX"] = "1"
    if limit == 0:
        sys.exit(measured(words, file))
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    os.execv(words[0], words)
