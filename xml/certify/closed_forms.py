"""What columns of steps.csv are exactly: functions of time, by column. Units: mm, ms, mg, kPa.

  inflation    a tube of Mooney-Rivlin's material under inner pressure, plane strain, incompressible:
               W = mu/2 (l^2 + l^-2 - 2), l = r/R;  p = int W'(l)/(l^2 - 1) dl from outside to inside, with the pressure of a support
  poiseuille   u = G (R^2 - r^2)/(4 mu)
  womersley    u = Re[G/(i w rho) (1 - J0(L r/R)/J0(L)) e^(iwt)],  L^2 = -i w rho R^2/mu
  windkessel   C dp_c/dt = Q - (p_c - p_d)/R_d,  p = p_c + R_p Q,  of an inflow of ramps
  elastic tube xml/benchmarks/elastic_tube_wave.py
"""
import math

import numpy as np

C10, C01, BULK = 3.0, 0.3, 1e5
INNER, OUTER = 1.43, 1.82


def constant(value):
    return lambda t: np.full(np.shape(t), float(value))


class Inflated:
    """A tube under one inner pressure; share of its circumference, 1/4 or 1; stiffness of a support per undeformed area."""

    def __init__(self, pressure, length, share, stiffness=0.0):
        self.pressure, self.length, self.share, self.stiffness = pressure, length, share, stiffness
        low, high = INNER, 1.6 * INNER
        while high - low > 1e-14:
            self.inner = 0.5 * (low + high)
            low, high = (self.inner, high) if self.balance() < pressure else (low, self.inner)
        self.outer = self.radius(OUTER)

    def radius(self, R):
        return np.sqrt(self.inner ** 2 + R ** 2 - INNER ** 2)

    def points(self, inside=INNER):
        """Gauss points of the wall from a radius on: undeformed radii and weights."""
        x, w = np.polynomial.legendre.leggauss(40)
        return 0.5 * (OUTER + inside) + 0.5 * (OUTER - inside) * x, 0.5 * (OUTER - inside) * w

    @staticmethod
    def hoop_over_radial(stretch):
        """sigma_tt - sigma_rr = l W'(l)."""
        return (C10 + C01) * (stretch ** 2 - stretch ** -2)

    def outside(self):
        """Radial stress at the outer radius, of the support."""
        return -self.stiffness * (self.radius(OUTER) - OUTER) * OUTER / self.radius(OUTER)

    def radial(self, R):
        """sigma_rr: its derivative is (sigma_tt - sigma_rr)/r."""
        S, w = self.points(R)
        s = self.radius(S)
        return self.outside() - (w * self.hoop_over_radial(s / S) / s * S / s).sum()

    def balance(self):
        return -self.radial(INNER)

    def mean_pressure(self, R):
        """Minus a third of the trace of the stress."""
        l2 = (self.radius(R) / R) ** 2
        axial = C10 * (1 - 1 / l2) + C01 * (l2 - 1)
        return -(3 * self.radial(R) + self.hoop_over_radial(math.sqrt(l2)) + axial) / 3

    def axial_stress(self, R):
        l2 = (self.radius(R) / R) ** 2
        return self.radial(R) + C10 * (1 - 1 / l2) + C01 * (l2 - 1)

    def over_wall(self, f):
        """Integral over the undeformed wall, of which the deformed one has the volume."""
        R, w = self.points()
        return self.share * 2 * math.pi * self.length * sum(weight * r * f(r) for r, weight in zip(R, w))

    def of_the_wall(self):
        stretch = lambda R: self.radius(R) / R  # noqa: E731
        round_part = self.share * 2 * math.pi
        area = self.share * math.pi * (OUTER ** 2 - INNER ** 2)
        force = self.over_wall(self.axial_stress) / self.length
        pressures = [self.mean_pressure(INNER), self.mean_pressure(OUTER)]
        return {"radial_displacement_inner_mm": self.inner - INNER, "max_displacement_wall_mm": self.inner - INNER,
                "min_det_F": 1.0, "max_det_F": 1.0, "wall_pressure_min_kPa": min(pressures),
                "wall_pressure_max_kPa": max(pressures),
                "elastic_energy_kPa_mm3": self.over_wall(lambda R: 0.5 * (C10 + C01) * (stretch(R) ** 2 + stretch(R) ** -2 - 2)),
                "volumetric_energy_kPa_mm3": self.over_wall(lambda R: 0.5 * self.mean_pressure(R) ** 2 / BULK),
                "wall_area_interface_mm2": round_part * self.inner * self.length,
                "wall_area_outer_mm2": round_part * self.outer * self.length,
                "wall_area_struct_in_mm2": area, "wall_area_struct_out_mm2": area,
                "wall_force_struct_in_z_mN": force, "wall_force_struct_out_z_mN": -force}

    def of_a_quarter(self):
        """Means over a quarter of a circle: of the cosine 2/pi. Planes of symmetry bear the pressure on the inner radius."""
        to_x = 2 / math.pi
        found = {f"mean_displacement_{surface}_{axis}_mm": to_x * moved for axis in "xy"
                 for surface, moved in (("interface", self.inner - INNER), ("outer", self.outer - OUTER))}
        side = (self.outer - self.inner) * self.length
        for one, other in ("xy", "yx"):
            found[f"wall_area_symmetry_{one}_mm2"] = side
            found[f"wall_force_symmetry_{one}_{one}_mN"] = self.pressure * self.inner * self.length
        return found

    def of_the_fluid(self):
        area, end = math.pi * self.inner ** 2, self.pressure * math.pi * self.inner ** 2
        return {"fluid_volume_mm3": area * self.length, "area_inlet_mm2": area, "area_outlet_mm2": area,
                "area_interface_mm2": 2 * math.pi * self.inner * self.length, "pressure_force_inlet_z_mN": -end,
                "pressure_force_outlet_z_mN": end, "max_displacement_interface_mm": self.inner - INNER,
                "mean_pressure_inlet_kPa": self.pressure, "mean_pressure_outlet_kPa": self.pressure,
                "mean_pressure_interface_kPa": self.pressure, "fluid_pressure_min_kPa": self.pressure,
                "fluid_pressure_max_kPa": self.pressure}


def inflation():
    tube = Inflated(0.5, 0.065, 0.25)
    return {name: constant(value) for name, value in {**tube.of_the_wall(), **tube.of_a_quarter()}.items()}


def filled(length):
    tube = Inflated(0.4, length, 1.0, 1e-2)
    return {name: constant(value) for name, value in {**tube.of_the_wall(), **tube.of_the_fluid()}.items()}


def poiseuille(radius, length, pressure=1e-4, viscosity=3.5e-3, density=1.0):
    gradient, area = pressure / length, math.pi * radius ** 2
    flow = math.pi * radius ** 4 * gradient / (8 * viscosity)
    fastest = gradient * radius ** 2 / (4 * viscosity)
    exact = {"inflow_inlet_mm3_per_ms": flow, "inflow_outlet_mm3_per_ms": -flow, "max_speed_mm_per_ms": fastest,
             "fluid_volume_mm3": area * length, "fluid_kinetic_energy_kPa_mm3": density * fastest ** 2 / 6 * area * length,
             "viscous_power_kPa_mm3_per_ms": pressure * flow, "traction_power_kPa_mm3_per_ms": pressure * flow,
             "max_wall_shear_stress_kPa": gradient * radius / 2, "fluid_pressure_min_kPa": 0.0, "fluid_pressure_max_kPa": pressure,
             "area_inlet_mm2": area, "area_outlet_mm2": area, "area_interface_mm2": 2 * math.pi * radius * length,
             "mean_pressure_inlet_kPa": pressure, "mean_pressure_outlet_kPa": 0.0, "mean_pressure_interface_kPa": pressure / 2,
             "pressure_force_inlet_z_mN": -pressure * area, "viscous_force_interface_z_mN": pressure * area}
    return {name: constant(value) for name, value in exact.items()}


def bessel(n, z):
    """J_n, n = 0 or 1, by its power series."""
    term = np.ones_like(z) if n == 0 else 0.5 * z
    total = term
    for k in range(1, 60):
        term = -term * 0.25 * z * z / (k * (k + n))
        total = total + term
    return total


def womersley(radius, length, pressure=0.2, viscosity=0.0490874, density=1.0, period=8.0):
    """The pressure is the cosine; kinetic energy and friction by quadrature over the section."""
    omega, area = 2 * math.pi / period, math.pi * radius ** 2
    parameter = np.sqrt(complex(0, -omega * density * radius ** 2 / viscosity))
    amplitude = pressure / length / (1j * omega * density)
    x, w = np.polynomial.legendre.leggauss(60)
    r, weight = 0.5 * radius * (x + 1), 0.5 * radius * w * 2 * math.pi * 0.5 * radius * (x + 1)
    profile = amplitude * (1 - bessel(0, parameter * r / radius) / bessel(0, parameter))
    slope = amplitude * parameter / radius * bessel(1, parameter * r / radius) / bessel(0, parameter)
    at_wall = amplitude * parameter / radius * bessel(1, parameter) / bessel(0, parameter)
    in_time = lambda a: lambda t: np.real(a * np.exp(1j * omega * np.asarray(t)))  # noqa: E731
    squared = lambda a, factor: lambda t: factor * np.sum(  # noqa: E731
        weight * np.square(np.real(np.multiply.outer(np.exp(1j * omega * np.asarray(t)), a))), axis=-1)
    flow, axis = (weight * profile).sum(), amplitude * (1 - 1 / bessel(0, parameter))
    friction = -viscosity * at_wall * 2 * math.pi * radius * length
    return {"inflow_inlet_mm3_per_ms": in_time(flow), "inflow_outlet_mm3_per_ms": in_time(-flow),
            "fluid_velocity_z_axis_mm_per_ms": in_time(axis), "fluid_pressure_middle_kPa": in_time(pressure / 2),
            "mean_pressure_inlet_kPa": in_time(pressure), "mean_pressure_outlet_kPa": constant(0.0),
            "mean_pressure_interface_kPa": in_time(pressure / 2), "fluid_volume_mm3": constant(area * length),
            "area_inlet_mm2": constant(area), "area_interface_mm2": constant(2 * math.pi * radius * length),
            "fluid_kinetic_energy_kPa_mm3": squared(profile, 0.5 * density * length),
            "viscous_power_kPa_mm3_per_ms": squared(slope, viscosity * length),
            "traction_power_kPa_mm3_per_ms": lambda t: in_time(pressure)(t) * in_time(flow)(t),
            "viscous_force_interface_z_mN": in_time(friction), "max_wall_shear_stress_kPa":
                lambda t: np.abs(in_time(viscosity * at_wall)(t)),
            "max_speed_mm_per_ms": lambda t: np.abs(np.real(np.multiply.outer(np.exp(1j * omega * np.asarray(t)),
                                                                             np.append(profile, axis)))).max(axis=-1)}


RAMPS = ((1 / 50, 0), (-1 / 50, 50), (-1 / 100, 100), (1 / 100, 200))  # of the inflow: slopes and beginnings


def windkessel(radius, length, speed=0.3, proximal=1.0, capacitance=10.0, distal=16.0, behind=1.0, initial=10.0):
    peak, decay, area = speed * math.pi * radius ** 2 / 2, distal * capacitance, math.pi * radius ** 2
    since = lambda t, start: np.maximum(np.asarray(t, dtype=float) - start, 0.0)  # noqa: E731
    flow = lambda t: peak * sum(slope * since(t, start) for slope, start in RAMPS)  # noqa: E731

    def stored(t):
        begun = behind + (initial - behind) * np.exp(-np.asarray(t, dtype=float) / decay)
        return begun + sum(peak * slope * distal * (since(t, start) - decay * (1 - np.exp(-since(t, start) / decay)))
                           for slope, start in RAMPS)

    pressure = lambda t: stored(t) + proximal * flow(t)  # noqa: E731
    return {"inflow_inlet_mm3_per_ms": flow, "inflow_outlet_mm3_per_ms": lambda t: -flow(t), "pressure_outlet_kPa": pressure,
            "stored_pressure_outlet_kPa": stored, "area_inlet_mm2": constant(area), "area_outlet_mm2": constant(area),
            "area_interface_mm2": constant(2 * math.pi * radius * length), "fluid_volume_mm3": constant(area * length)}
