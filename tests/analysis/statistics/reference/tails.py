# SPDX-License-Identifier: BSD-3-Clause
# Tails of distributions to 60 digits with mpmath, and some statistics with SciPy as a second opinion.
# Run: python3 tails.py
from mpmath import mp, mpf, betainc, erfc, gammainc, linspace, loggamma, quad, sqrt, exp, pi, inf, nstr
mp.dps = 60
show = lambda label, x: print(label, nstr(mpf(x), 17))

for z in (1, 5, 10, 20, 37):
    show(f"normal upper {z}", erfc(mpf(z) / sqrt(mpf(2))) / 2)
for z in (50, 300, 100000):
    show(f"ln normal lower {-z}", mp.log(erfc(mpf(z) / sqrt(mpf(2))) / 2))
def t2(t, v):
    return betainc(mpf(v) / 2, mpf(1) / 2, 0, v / (v + mpf(t) ** 2), regularized=True)
for t, v in ((0.001, 5), (10, 3), (50, 7), (1e5, 2), (10, 1000), (12.5, 1000000)):
    show(f"t two-sided {t} {v}", t2(t, v) if v < 1e5 else
         2 * quad(lambda x: exp(loggamma((mpf(v) + 1) / 2) - loggamma(mpf(v) / 2)) / sqrt(v * pi)
                  * exp(-(mpf(v) + 1) / 2 * mp.log1p(x * x / v)), linspace(mpf(t), mpf(t) + 9, 60)))
def f(x, a, b):
    return betainc(mpf(b) / 2, mpf(a) / 2, 0, b / (b + a * mpf(x)), regularized=True)
for x, a, b in ((0.001, 2, 9), (30.226, 6, 42), (1e4, 3, 20), (1e8, 1, 7), (5, 40, 400), (98.926, 1, 7)):
    show(f"F upper {x} {a} {b}", f(x, a, b))
for x, k in ((100, 1), (1000, 10), (3, 8), (1400, 30), (1200, 700)):
    show(f"chi-squared upper {x} {k}", gammainc(mpf(k) / 2, mpf(x) / 2, inf, regularized=True))
# m-AFC, proportion wrong far out and proportion correct far below chance.
phi = lambda x: exp(-x * x / 2) / sqrt(2 * pi)
Phi = lambda x: erfc(-x / sqrt(mpf(2))) / 2
def wrong(d, m):
    return quad(lambda x: phi(x - d) * (1 - Phi(x) ** (m - 1)), [d + i for i in range(-25, 26)])
def correct(d, m):
    return quad(lambda x: phi(x - d) * Phi(x) ** (m - 1), [i for i in range(-25, 26)])
show("wrong 3 8", wrong(8, 3)); show("wrong 4 12", wrong(12, 4)); show("correct 3 -6", correct(-6, 3))

from scipy import stats
x = [1.2, 0.8, 2.5, 2.5, 3.1, 0.4, 1.9, 4.0, 2.5, 3.3, 0.4, 1.2]
y = [0.25, 0.25, 0.5, 0.75, 1, 0, 0.5, 1, 0.75, 0.5, 0.25, 0]
print("tau_b", stats.kendalltau(x, y)); print("tau_c", stats.kendalltau(x, y, variant="c"))
print("noncentral F", stats.ncf.cdf(30.226, 6, 42, 100))
