"""tunica-certify on Poiseuille's flow, whose numbers are known: the bands hold them, a killed command continues, and no file of a user
is overwritten: test_certificate.py ROOT FOLDER_OF_PROGRAMS SCRATCH
"""
import csv
import pathlib
import signal
import subprocess
import sys
import time

from scratch import fresh

ROOT = pathlib.Path(sys.argv[1])
sys.path.append(str(ROOT / "xml" / "certify"))
import closed_forms  # noqa: E402

RADIUS, LENGTH = 1.0, 1.0


def run(programs, words, folder):
    done = subprocess.run([str(programs / "tunica-certify"), *words, "--programs", str(programs)], cwd=folder, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return done.returncode, done.stdout


def claim(holds, text, shown=""):
    print(("ok    " if holds else "FAIL  ") + text, flush=True)
    if not holds:
        print(shown)
        sys.exit(1)


def case_words(folder, output, *more):
    return [str(ROOT / "xml" / "certify" / "poiseuille.xml"), "--set", f"Mesh/file={folder / 'tube.h5'}", "--output", output, "--cores", "2",
            *more]


def kill_and_continue(programs, folder, words):
    """SIGKILL as soon as the first run is done: its steps remain, the other runs follow."""
    child = subprocess.Popen([str(programs / "tunica-certify"), *words, "--programs", str(programs)], cwd=folder,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    first = folder / "one" / "runs" / "case" / "run.json"
    while child.poll() is None and not (first.exists() and '"done"' in first.read_text(encoding="utf-8")):
        time.sleep(0.02)
    child.send_signal(signal.SIGKILL)
    child.wait()
    before = (folder / "one" / "runs" / "case" / "steps.csv").stat().st_mtime_ns
    status, text = run(programs, words, folder)
    claim(status == 0 and before == (folder / "one" / "runs" / "case" / "steps.csv").stat().st_mtime_ns,
          "a killed command continues, and what was done remains", text)
    return text


def holds_exact_values(folder, text):
    exact = closed_forms.poiseuille(RADIUS, LENGTH)
    with open(folder / "one" / "errors.csv", newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["column"] in exact and row["quantity"] == "last"]
    claim(len(rows) == 18, f"{len(rows)} numbers are known", text)
    misses, wide = [], []
    for row in rows:
        error = abs(float(row["value"]) - float(exact[row["column"]](0.0)))
        misses += [row["column"]] if error > float(row["band"]) else []
        wide += [row["column"]] if float(row["band"]) > 5 * error else []
    claim(len(misses) <= 1, f"{len(rows) - len(misses)} of them are within their bands {misses}", text)
    claim(len(wide) <= 2, f"{len(rows) - len(wide)} bands are at most five times the true error {wide}", text)
    energy = next(row for row in rows if row["column"] == "fluid_kinetic_energy_kPa_mm3")
    claim(abs(float(energy["mesh_order"]) - 2) < 0.3, f"the order of the kinetic energy is {energy['mesh_order']}", text)
    off = {what: abs(float(energy[what]) - float(exact[energy["column"]](0.0))) for what in ("value", "extrapolated")}
    claim(off["extrapolated"] < 0.2 * off["value"], f"extrapolated it is nearer to the exact one {off}", text)
    page = (folder / "one" / "report" / "index.html").read_text(encoding="utf-8")
    claim("data:image/png;base64" in page and "src=\"curves" not in page and "inflow inlet" in page, "the page is one file")


def keeps_files(programs, folder):
    words = case_words(folder, "one", "--levels", "3")
    status, text = run(programs, [*words, "--set", "Fluid/viscosity=4e-3"], folder)
    claim(status == 1 and "--overwrite" in text and (folder / "one" / "errors.csv").exists(), "another case is refused in its folder", text)
    (folder / "mine").mkdir()
    (folder / "mine" / "notes.txt").write_text("mine", encoding="utf-8")
    for more in ((), ("--overwrite",)):
        status, text = run(programs, case_words(folder, "mine", *more), folder)
        claim(status == 1 and [path.name for path in (folder / "mine").iterdir()] == ["notes.txt"],
              f"a folder with other files is refused {more}", text)
    status, text = run(programs, case_words(folder, "planned", "--dry-run", "--budget", "2e-5"), folder)
    claim(status == 0 and not (folder / "planned").exists() and "at a time" in text and "--coarser" in text,
          "--dry-run makes nothing and tells what does not fit", text)
    status, text = run(programs, case_words(folder, "planned", "--set", "Fluid/viscosiy=1"), folder)
    claim(status == 1 and 'Did you mean "viscosity"' in text, "a wrong key is one error with the nearest name", text)


def main(programs, scratch):
    folder = fresh(scratch)
    subprocess.run([str(programs / "tunica-mesh"), "tube", str(folder / "tube.h5"), "--radius", str(RADIUS), "--length", str(LENGTH),
                    "--around", "12", "--axial", "2", "--wall", "off"], check=True, stdout=subprocess.DEVNULL)
    text = kill_and_continue(programs, folder, case_words(folder, "one", "--levels", "3"))
    holds_exact_values(folder, text)
    keeps_files(programs, folder)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[2]).resolve(), sys.argv[3])
