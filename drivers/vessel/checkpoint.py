"""The pressures that the Windkessels of a checkpoint store, and their replacement.

A restart takes them from the checkpoint. To begin a beat with others, a copy with new numbers takes the place of the file;
its checksum (FNV-1a of all but the arrays, as src/tunica/output/checkpoint_sum.hpp makes it) is made anew.
"""
import glob
import os
import shutil

import h5py
import numpy as np

TEXTS = ("text_names", "texts", "number_names", "array_names", "array_checksums", "parameters")
INTEGERS = ("number_counts", "array_columns")
PREFIX = "fluid/windkessel at "


def newest(folder):
    """Path of the newest checkpoint in the folder of a run, or None."""
    found = sorted(glob.glob(os.path.join(glob.escape(folder), "checkpoint-*.h5")))
    return found[-1] if found else None


def fnv(data, value=14695981039346656037):
    for byte in data:
        value = (value ^ byte) * 1099511628211 & 0xFFFFFFFFFFFFFFFF
    return value


def checksum(file):
    value = 14695981039346656037
    for name in TEXTS:
        for text in file[name][:] if name in file else ():
            value = fnv(bytes(text) + b"\0", value)
    for name in INTEGERS:
        value = fnv(file[name][:].astype("<i4").tobytes(), value)
    return f"{fnv(file['numbers'][:].astype('<f8').tobytes(), value):016x}".encode()


def places(file):
    """Name -> slice of its numbers."""
    names = [name.decode() for name in file["number_names"][:]]
    ends = np.cumsum(file["number_counts"][:])
    return {name: slice(int(end - count), int(end)) for name, end, count in zip(names, ends, file["number_counts"][:])}


def time_of(path):
    with h5py.File(path) as file:
        return float(file["numbers"][places(file)["run/time"]][0])


def write_strings(dataset, values):
    """As the file has them; h5py itself converts no strings of a fixed length in UTF-8."""
    kind = dataset.id.get_type()
    dataset.id.write(h5py.h5s.ALL, h5py.h5s.ALL, np.array(values, dtype=f"S{kind.get_size()}"), mtype=kind)


def set_circuits(path, pressures):
    """Moves the stored pressure of each outlet to this value [kPa], and what the time scheme remembers of it by as much. Doing it
    twice changes nothing. Returns False, without a change, where the file is not as this module knows it."""
    draft = path + ".draft"
    shutil.copyfile(path, draft)
    with h5py.File(draft, "r+") as file:
        place = places(file)
        is_known = checksum(file) == bytes(file["head_checksum"][0]) and all(PREFIX + name in place for name in pressures)
        if is_known:
            numbers = file["numbers"][:]
            for name, pressure in pressures.items():
                mine = numbers[place[PREFIX + name]]
                numbers[place[PREFIX + name]] = mine + (pressure - mine[0])
            file["numbers"][:] = numbers
            write_strings(file["head_checksum"], [checksum(file)])
    if is_known:
        os.replace(draft, path)
    else:
        os.remove(draft)
    return is_known
