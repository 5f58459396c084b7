"""A surface that tests of lumens share."""
import numpy as np

from lumen.surface import Surface


def pipe(around=24, along=20, radius=1.0, length=6.0):
    """An open tube along z, normals outward."""
    angle = 2.0 * np.pi * np.arange(around) / around
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle), 0 * angle], axis=1)
    points = np.concatenate([ring + [0, 0, length * k / along] for k in range(along + 1)])
    i = np.arange(around * along)
    j = i // around * around + (i + 1) % around
    return Surface(points, np.concatenate([np.stack([i, j, i + around], axis=1), np.stack([j, j + around, i + around], axis=1)]))
