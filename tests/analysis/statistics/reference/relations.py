# SPDX-License-Identifier: BSD-3-Clause
"""Variants of Kendall's tau, and percentile intervals of a bootstrap over clusters. Run: python3 relations.py"""
import numpy as np
from scipy import stats

a = np.array([1.2, 0.8, 2.5, 2.5, 3.1, 0.4, 1.9, 4.0, 2.5, 3.3, 0.4, 1.2])
y = np.array([0.25, 0.25, 0.5, 0.75, 1, 0, 0.5, 1, 0.75, 0.5, 0.25, 0])
for variant in "bc":
    print("tau", variant, repr(stats.kendalltau(a, y, variant=variant, method="asymptotic")))

# Eight participants of three rows each: a value of the participant's own, and little that is of the rows.
x = np.array([2.1, 2.3, 1.9, 3.6, 3.3, 3.9, 0.8, 1.1, 0.7, 4.4, 4.7, 4.1, 2.9, 2.6, 3.0, 1.5, 1.2, 1.8, 3.8, 3.5, 4.0, 2.2, 2.4, 2.0])
z = np.array([1.0, 1.3, 0.9, 2.1, 2.4, 2.2, 1.6, 1.5, 1.8, 2.9, 2.6, 3.1, 0.7, 1.1, 0.8, 1.4, 1.2, 1.3, 2.0, 1.8, 2.3, 1.9, 1.7, 2.1])
o = (z > 1.65).astype(int)
rows = np.arange(24).reshape(8, 3)


def area(s, outcome):
    d = np.subtract.outer(s[outcome == 1], s[outcome == 0])
    return ((d > 0) + 0.5 * (d == 0)).mean()


rng = np.random.default_rng(7)
r, tau, areas, single = [], [], [], []
for _ in range(40000):
    own = rows[rng.integers(0, 8, 8)].ravel()
    if np.unique(x[own]).size > 1:
        r.append(np.corrcoef(x[own], z[own])[0, 1])
        tau.append(stats.kendalltau(x[own], z[own])[0])
    if 0 < o[own].sum() < 24:
        areas.append(area(x[own], o[own]))
    drawn = rng.integers(0, 24, 24)
    single.append(np.corrcoef(x[drawn], z[drawn])[0, 1])
for name, values in [("pearson", r), ("tau_b", tau), ("area", areas), ("pearson, rows by themselves", single)]:
    print(name, np.percentile(values, [2.5, 97.5]), len(values))

