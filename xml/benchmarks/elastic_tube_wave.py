"""The wave in a viscous fluid within an elastic tube, exact where everything is linear (J. R. Womersley, Phil. Mag. 46
(1955) 199-221; here with a wall of any thickness).

Each quantity is the real part of its amplitude times exp(i(omega t - k z)); units are mm, ms, mg, kPa.

  fluid   p = I0(k r),   u_z = k I0(k r)/(rho omega) + B I0(s r),   u_r = ik I1(k r)/(rho omega) + ik B I1(s r)/s
          s^2 = k^2 + i omega rho/mu
  wall    d = grad phi + curl(psi e_theta),   phi = a1 I0(p r) + a2 K0(p r),   psi = a3 I1(q r) + a4 K1(q r)
          p^2 = k^2 - omega^2/c_L^2,   q^2 = k^2 - omega^2/c_T^2

Velocities and tractions are continuous at r = R, the wall is free outside. That the determinant of these six equations
vanishes gives k, which is found by the secant method.
"""
import numpy as np

R, H, LENGTH = 1000.0, 100.0, 15000.0
RHO, MU = 1.0, 5.0
RHO_WALL, E, NU = 1.0, 20.0, 0.3
PERIOD = 5e4
OMEGA = 2.0 * np.pi / PERIOD
PRESSURE = 1e-3                     # on the axis at z = 0


def bessel_i(n, z):
    """I_n by its series; for |z| up to 20."""
    term = (z / 2) ** n / (1 if n < 2 else 2)
    total = term
    for m in range(1, 80):
        term = term * (z / 2) ** 2 / (m * (m + n))
        total = total + term
    return total


def bessel_k(n, z):
    """K_n for Re z > 0, by its integral over exp(-z cosh t) cosh(n t)."""
    t = np.linspace(0.0, 12.0, 4801)
    f = np.exp(-z * np.cosh(t)) * np.cosh(n * t)
    return (t[1] - t[0]) * (f.sum() - 0.5 * (f[0] + f[-1]))


class Wave:
    def __init__(self):
        self.c_L2 = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU)) / RHO_WALL
        self.c_T2 = E / (2 * (1 + NU)) / RHO_WALL
        k0, k1 = (0.144 - 0.0207j) * 1e-3, (0.1441 - 0.0206j) * 1e-3
        f0, f1 = self._defect(k0), self._defect(k1)
        while abs(k1 - k0) > 1e-14 * abs(k1):
            k0, k1, f0 = k1, k1 - f1 * (k1 - k0) / (f1 - f0), f1
            f1 = self._defect(k1)
        self.k = k1
        matrix, right = self._equations(k1)
        self.s = np.sqrt(k1 ** 2 + 1j * OMEGA * RHO / MU)
        self.B, *self.a = np.linalg.solve(matrix[:5], right[:5])

    def _wall_rows(self, k, r):
        """d_r, d_z, sigma_rr, sigma_rz of each of the four parts of the wall's solution."""
        p, q = np.sqrt(k ** 2 - OMEGA ** 2 / self.c_L2 + 0j), np.sqrt(k ** 2 - OMEGA ** 2 / self.c_T2 + 0j)
        mu, lame = self.c_T2 * RHO_WALL, (self.c_L2 - 2 * self.c_T2) * RHO_WALL
        rows = []
        for kind in range(4):
            modulus = p if kind < 2 else q
            z, sign = modulus * r, 1 if kind % 2 == 0 else -1
            f0, f1 = (bessel_i(0, z), bessel_i(1, z)) if sign > 0 else (bessel_k(0, z), bessel_k(1, z))
            if kind < 2:      # phi = f0: phi' = sign p f1, phi'' = p^2 f0 - phi'/r
                slope = sign * p * f1
                second = p ** 2 * f0 - slope / r
                rows.append([slope, -1j * k * f0, lame * (p ** 2 - k ** 2) * f0 + 2 * mu * second,
                             -2j * mu * k * slope])
            else:             # psi = f1: (r psi)'/r = sign q f0, psi' = sign q f0 - f1/r
                rows.append([1j * k * f1, sign * q * f0, 2j * mu * k * (sign * q * f0 - f1 / r),
                             mu * (k ** 2 + q ** 2) * f1])
        return np.array(rows).T

    def _equations(self, k):
        """Six equations for B and a1 ... a4: the wall is free, velocities and tractions are continuous."""
        s = np.sqrt(k ** 2 + 1j * OMEGA * RHO / MU)
        inside, outside = self._wall_rows(k, R), self._wall_rows(k, R + H)
        i0k, i1k, i0s, i1s = (bessel_i(n, z * R) for z in (k, s) for n in (0, 1))
        ro = RHO * OMEGA
        of_B = {"r": 1j * k * i1s / s, "z": i0s}
        given = {"r": 1j * k * i1k / ro, "z": k * i0k / ro}
        # sigma_rr = -p + 2 mu du_r/dr, sigma_rz = mu (-ik u_r + du_z/dr)
        normal_B = 2 * MU * 1j * k * (i0s - i1s / (s * R))
        normal = -i0k + 2 * MU * 1j * k / ro * (k * i0k - i1k / R)
        shear_B = MU * (-1j * k * of_B["r"] + s * i1s)
        shear = MU * (-1j * k * given["r"] + k ** 2 * i1k / ro)
        rows, right = [], []
        for row in (outside[2], outside[3]):
            rows.append(np.append(0, row))
            right.append(0)
        for name, row in (("r", inside[0]), ("z", inside[1])):
            rows.append(np.append(-of_B[name], 1j * OMEGA * row))
            right.append(given[name])
        rows += [np.append(-shear_B, inside[3]), np.append(-normal_B, inside[2])]
        right += [shear, normal]
        return np.array(rows), np.array(right)

    def _defect(self, k):
        """How far the sixth equation is off where the other five hold."""
        matrix, right = self._equations(k)
        return matrix[5] @ np.linalg.solve(matrix[:5], right[:5]) - right[5]

    def fluid(self, r):
        """Amplitudes of u_r, u_z [mm/ms] and p [kPa] at z = 0."""
        k, s, ro = self.k, self.s, RHO * OMEGA
        u_r = 1j * k * bessel_i(1, k * r) / ro + 1j * k * self.B * bessel_i(1, s * r) / s
        u_z = k * bessel_i(0, k * r) / ro + self.B * bessel_i(0, s * r)
        return PRESSURE * np.array([u_r, u_z, bessel_i(0, k * r)])

    def wall(self, r):
        """Amplitudes of d_r and d_z at z = 0 [mm]."""
        return PRESSURE * (self._wall_rows(self.k, r)[:2] @ np.array(self.a))

    def flow_rate(self):
        """Amplitude of the flow rate at z = 0 [mm^3/ms]."""
        k, s = self.k, self.s
        return PRESSURE * 2 * np.pi * R * (bessel_i(1, k * R) / (RHO * OMEGA) + self.B * bessel_i(1, s * R) / s)


    def write_tables(self, folder, plane):
        """What is imposed at both ends, at the vertices of the section in the plane: velocities of the fluid
        (inlet, outlet) and displacements of the wall, at 32 times of a period."""
        r = np.hypot(*plane.T)
        in_fluid, in_wall = r < R * (1 + 1e-9), r > R * (1 - 1e-9)
        for end, z in (("inlet", 0.0), ("outlet", LENGTH)):
            self._write(f"{folder}/elastic-tube-{end}.csv", plane[in_fluid], z, lambda a: self.fluid(a)[:2])
            self._write(f"{folder}/elastic-tube-wall-{end}.csv", plane[in_wall], z, self.wall)

    def _write(self, path, vertices, z, amplitudes):
        radii = np.hypot(*vertices.T)
        along = np.array([amplitudes(r) for r in radii]) * np.exp(-1j * self.k * z)
        with open(path, "w", encoding="utf-8") as out:
            out.write("time,x,y,z,v_x,v_y,v_z\n")
            for n in range(32):
                values = (along * np.exp(2j * np.pi * n / 32)).real
                for (x, y), r, (v_r, v_z) in zip(vertices, radii, values):
                    v_x, v_y = (v_r * x / r, v_r * y / r) if r > 0 else (0.0, 0.0)
                    out.write(f"{n * PERIOD / 32:.9g},{x:.15g},{y:.15g},{z:.9g},{v_x:.8g},{v_y:.8g},{v_z:.8g}\n")


if __name__ == "__main__":
    wave = Wave()
    print(f"k = {wave.k * 1e3:.10f} 1/m, c = {OMEGA / wave.k.real:.7f} m/s")
    print(f"wall at R: d_r = {wave.wall(R)[0]:.8e}, d_z = {wave.wall(R)[1]:.8e} mm; Q = {wave.flow_rate():.8e} mm^3/ms")
