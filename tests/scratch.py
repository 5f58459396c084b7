"""Folders that tests empty, and no others."""
import pathlib
import shutil


def fresh(folder):
    """An empty folder of that name. One that holds anything is emptied only where an earlier test has made it, as a file
    beside it tells: a wrong word on a command line must not cost anybody's files."""
    folder = pathlib.Path(folder).resolve()
    mark = folder.with_name(f".{folder.name}.scratch")
    if folder.is_dir() and any(folder.iterdir()) and not mark.is_file():
        raise SystemExit(f"{folder} holds files that no test has made. Name another folder, or remove it yourself.")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    mark.touch()
    return folder


def remove_results(folder):
    """Removes what runs have left in a folder of fresh(), and keeps what stands beside it: their lines."""
    for results in [path for path in folder.iterdir() if path.is_dir()]:
        shutil.rmtree(results)
