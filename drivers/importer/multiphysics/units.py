"""Units of a case of svMultiPhysics, which has none of its own: any that fit each other."""
import dataclasses


@dataclasses.dataclass
class Units:
    """One of theirs in mm, ms and mg; what follows from these in Tunica's units, kPa = mg/(mm ms²)."""
    words: str
    length: float
    time: float
    mass: float

    @property
    def density(self):
        return self.mass / self.length ** 3

    @property
    def velocity(self):
        return self.length / self.time

    @property
    def flow(self):
        return self.length ** 3 / self.time

    @property
    def pressure(self):
        return self.mass / (self.length * self.time ** 2)

    @property
    def viscosity(self):
        return self.pressure * self.time

    @property
    def resistance(self):
        return self.pressure / self.flow

    @property
    def capacitance(self):
        return self.length ** 3 / self.pressure

    @property
    def stiffness(self):
        return self.pressure / self.length

    @property
    def damping(self):
        return self.stiffness * self.time

    def lines(self):
        """What was assumed, and the factors."""
        yield f"units    {self.words}"
        yield (f"         times {self.length:g} in mm, {self.time:g} in ms, {self.pressure:g} in kPa, {self.density:g} in mg/mm^3, "
               f"{self.viscosity:g} in kPa ms,")
        yield (f"         {self.flow:g} in mm^3/ms, {self.resistance:g} in kPa ms/mm^3, {self.capacitance:g} in mm^3/kPa")


OF = {"cgs": Units("cgs: cm, g, s, hence dyn/cm^2 and Poise", 10.0, 1e3, 1e3),
      "si": Units("si: m, kg, s, hence Pa", 1e3, 1e3, 1e6),
      "mm-g-s": Units("mm-g-s: mm, g, s, hence Pa", 1.0, 1e3, 1e3),
      "tunica": Units("tunica: mm, mg, ms, hence kPa, as they are", 1.0, 1.0, 1.0)}
