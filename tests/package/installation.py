"""What the scripts of this folder share."""
import pathlib
import sys

from runs import Run, Verdict

SOURCE, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
CMAKE = sys.argv[3]


def must(words, folder):
    """The output of a command without which there is nothing to test."""
    run = Run([str(word) for word in words], folder)
    if run.status != 0:
        sys.exit(f"{' '.join(map(str, words))}: exit status {run.status}\n{run.out}\n{run.err}")
    return run.out


def install_and_move(component, scratch):
    """The prefix, not where it was installed to."""
    staged, moved = scratch / "staged", scratch / "elsewhere" / "tunica"
    must([CMAKE, "--install", BUILD, "--prefix", staged, "--component", component], scratch)
    moved.parent.mkdir()
    staged.rename(moved)
    return moved


def build_against(prefix, source, build, scratch, *options):
    """A program of its own, which finds Tunica in the prefix."""
    must([CMAKE, "-S", source, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={prefix}", *options], scratch)
    must([CMAKE, "--build", build], scratch)


def mentions(folder, text):
    """Files of a folder that name what they must not."""
    return [str(path.relative_to(folder)) for path in sorted(folder.rglob("*"))
            if path.is_file() and not path.is_symlink() and text.encode() in path.read_bytes()]


__all__ = ["BUILD", "CMAKE", "Run", "SOURCE", "Verdict", "build_against", "install_and_move", "mentions", "must"]
