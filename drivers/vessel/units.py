"""Units of a case (mm, ms, mg, hence kPa and mm^3/ms) and those of the clinic."""

MMHG = 0.133322  # kPa
ML_PER_S = 1.0  # mm^3/ms
L_PER_MIN = 1000.0 / 60.0  # mm^3/ms
ML_PER_MMHG = 1000.0 / MMHG  # mm^3/kPa
MMHG_S_PER_ML = MMHG  # kPa ms/mm^3: 0.133322 kPa / (1000 mm^3 / 1000 ms)

BLOOD_DENSITY = 1.06  # mg/mm^3
BLOOD_VISCOSITY = 3.5e-3  # kPa ms


def mmhg(kpa):
    return kpa / MMHG
