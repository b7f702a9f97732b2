# SPDX-License-Identifier: BSD-3-Clause
# Intervals of rates and means, and signal detection.
# Run: Rscript rates.R
options(digits = 15)
show <- function(label, x) cat(label, format(x, digits = 15), "\n")

for (k in list(c(455, 672), c(10, 224), c(0, 20), c(20, 20), c(1, 1000000), c(987654, 1000000))) {
  show(paste("wilson", k[1], k[2]), prop.test(k[1], k[2], correct = FALSE)$conf.int)
  show(paste("clopper-pearson", k[1], k[2]), binom.test(k[1], k[2])$conf.int)
}
show("wilson 0.9 7 9", prop.test(7, 9, correct = FALSE, conf.level = 0.9)$conf.int)
show("t interval", t.test(c(0.55, 0.71, 0.82, 0.64, 0.60, 0.77, 0.49, 0.84))$conf.int)

# 38 hits of 50 signals, 9 false alarms of 40 noise trials; log-linear correction.
H <- 38.5 / 51; F <- 9.5 / 41; zH <- qnorm(H); zF <- qnorm(F)
show("d' c lnbeta beta", c(zH - zF, -(zH + zF) / 2, (zF^2 - zH^2) / 2, dnorm(zH) / dnorm(zF)))
vH <- H * (1 - H) / 50 / dnorm(zH)^2; vF <- F * (1 - F) / 40 / dnorm(zF)^2
show("errors", c(sqrt(vH + vF), sqrt((vH + vF) / 4), sqrt(zH^2 * vH + zF^2 * vF)))
a <- function(H, F) 0.5 + (H - F) * (1 + H - F) / (4 * H * (1 - F)); e <- 1e-5
show("A' error", c(a(H, F), sqrt(((a(H + e, F) - a(H - e, F)) / (2 * e))^2 * H * (1 - H) / 50 +
                                 ((a(H, F + e) - a(H, F - e)) / (2 * e))^2 * F * (1 - F) / 40)))
show("uncorrected d'", qnorm(38 / 50) - qnorm(9 / 40))

# m alternatives, by adaptive quadrature.
pc <- function(d, m) integrate(function(x) dnorm(x - d) * pnorm(x)^(m - 1), -Inf, Inf, rel.tol = 1e-12, subdivisions = 1000)$value
for (m in c(2, 3, 4, 8, 1000)) for (d in c(-1, 0, 0.5, 1, 2.5)) show(paste("pc", d, m), pc(d, m))
dp <- function(p, m) uniroot(function(d) pc(d, m) - p, c(-5, 8), tol = 1e-13)$root
show("d' of 0.75, m 3, 4", c(dp(0.75, 3), dp(0.75, 4)))
# 60 of 80 in 4 alternatives, uncorrected: d', error, bounds.
p <- 60 / 80; d <- dp(p, 4); h <- 1e-4
w <- prop.test(60, 80, correct = FALSE)$conf.int
show("m-AFC", c(d, sqrt(p * (1 - p) / 80) / ((pc(d + h, 4) - pc(d - h, 4)) / (2 * h)), dp(w[1], 4), dp(w[2], 4)))
