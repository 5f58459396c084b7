"""What Langer and Yang print: the numbers of their section 6. Their figures have no numbers.

Adaptive control: one row per Newton step, (ε₂: mass norm of the increment, ε₁: reduction of the
linear residual, cycles)."""

ADAPTIVE = {
    ("fluid", "coarse"): [(9.2e+01, 4.1e-02, 1), (6.2e-03, 1.8e-03, 1), (6.6e-06, 1.6e-05, 2), (3.1e-10, 1.6e-11, 5)],
    ("fluid", "fine"): [(9.4e+01, 7.1e-02, 1), (8.6e-03, 1.2e-02, 1), (4.4e-05, 4.6e-06, 3), (7.9e-10, 1.5e-10, 6)],
    ("mooney-rivlin", "coarse"): [(2.4e+01, 9.2e-07, 1), (1.5e-02, 4.0e-06, 1), (1.9e-06, 1.1e-05, 2),
                                  (2.6e-11, 3.3e-13, 5)],
    ("mooney-rivlin", "fine"): [(2.5e+01, 6.4e-03, 1), (1.8e-01, 1.9e-02, 1), (2.8e-03, 2.8e-02, 1),
                                (1.1e-04, 1.4e-06, 4), (1.5e-09, 1.8e-09, 7)],
    ("artery", "coarse"): [(3.2e+01, 5.0e-06, 1), (2.3e-02, 1.3e-04, 1), (5.7e-04, 2.8e-04, 2), (3.0e-06, 2.0e-07, 6),
                           (1.3e-11, 2.1e-12, 9)],
    ("artery", "fine"): [(3.2e+01, 3.2e-05, 1), (3.6e-02, 3.6e-04, 1), (3.1e-03, 6.0e-04, 2), (6.8e-05, 8.3e-06, 6),
                         (1.5e-09, 4.0e-09, 9)],
}

# The text has 9034 on the fine mesh's second level and for the coarse mesh, whose unknowns are 9036.
LEVELS = {
    ("fluid", "coarse"): [9034, 1684, 252], ("wall", "coarse"): [26096, 4012, 648, 88],
    ("fluid", "fine"): [56996, 9034, 1684, 252], ("wall", "fine"): [185424, 26096, 4012, 648, 88],
}
