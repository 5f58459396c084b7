"""rcrt.dat, in which SimVascular's other solvers have their Windkessels: the most rows of a pressure; then for each surface
the rows of its pressure, its name (in files for networks), R_p, C, R_d, and rows of time and pressure behind it."""
import dataclasses
import os

from ..raw import BadMesh

NAME = "rcrt.dat"


@dataclasses.dataclass
class Windkessel:
    proximal: float
    capacitance: float
    distal: float
    pressure: float     # mean
    is_steady: bool


class RcrFile:
    """Windkessels by name, or in the order of the conditions where the file has no names."""

    def __init__(self, folder):
        self.path = os.path.join(folder, NAME)
        self.named, self.in_order = {}, []
        if os.path.isfile(self.path):
            self.read()

    def read(self):
        try:
            with open(self.path, encoding="utf-8-sig") as file:
                lines = iter([line.strip() for line in file if line.strip()][1:])
            for line in lines:
                self.read_one(int(line), lines)
        except (OSError, ValueError, IndexError, StopIteration) as error:
            why = str(error) or "it ends too early"
            raise BadMesh(f"{self.path}: cannot be read as Windkessels: {why}. Expected for each the number of pressures, perhaps a "
                          "name, R_p, C, R_d, and so many lines with a time and a pressure") from None

    def read_one(self, count, lines):
        first = next(lines)
        name = None if is_number(first) else first
        values = [float(next(lines) if name or k else first) for k in range(3)]
        pressures = [float(next(lines).split()[1]) for _ in range(count)]
        found = Windkessel(*values, sum(pressures) / max(count, 1), len(set(pressures)) < 2)
        if name:
            self.named[name] = found
        else:
            self.in_order.append(found)

    def of(self, name, position):
        """Of a surface, which is the position-th with a Windkessel; None where the file has none for it."""
        if name in self.named:
            return self.named[name]
        return self.in_order[position] if position < len(self.in_order) else None


def is_number(word):
    try:
        float(word)
    except ValueError:
        return False
    return True
