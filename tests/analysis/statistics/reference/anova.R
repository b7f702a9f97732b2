# SPDX-License-Identifier: BSD-3-Clause
# Repeated-measures analysis of variance with R's own aov, mauchly.test and anova.mlm.
# Run: Rscript anova.R
options(digits = 15)

# 6 subjects x lod (2) x distance (4): rows are subjects, the distance varies fastest.
y <- matrix(c(
  0.31, 0.42, 0.55, 0.71, 0.12, 0.28, 0.33, 0.62,
  0.22, 0.47, 0.61, 0.66, 0.18, 0.19, 0.41, 0.49,
  0.45, 0.51, 0.49, 0.83, 0.25, 0.36, 0.52, 0.58,
  0.18, 0.33, 0.58, 0.79, 0.05, 0.31, 0.29, 0.71,
  0.39, 0.36, 0.72, 0.91, 0.22, 0.24, 0.47, 0.55,
  0.27, 0.49, 0.44, 0.64, 0.31, 0.22, 0.35, 0.67), nrow = 6, byrow = TRUE)
d <- data.frame(
  value = as.vector(t(y)), subject = factor(rep(1:6, each = 8)),
  lod = factor(rep(rep(1:2, each = 4), 6)), distance = factor(rep(1:4, 12)))
print(summary(aov(value ~ lod * distance + Error(subject / (lod * distance)), d)), digits = 15)
fits <- summary(aov(value ~ lod * distance + Error(subject / (lod * distance)), d))
for (name in names(fits)) { cat(name, "\n"); print(sapply(fits[[name]][[1]], function(c) format(c, digits = 15))) }

idata <- data.frame(lod = factor(rep(1:2, each = 4)), distance = factor(rep(1:4, 2)))
fit <- lm(y ~ 1)
null <- update(fit, ~ 0)
report <- function(label, M, X) {
  cat(label, "\n")
  m <- mauchly.test(fit, M = M, X = X, idata = idata)
  cat("  W", format(m$statistic, digits = 15), "p", format(m$p.value, digits = 15), "\n")
  a <- anova(fit, null, M = M, X = X, idata = idata, test = "Spherical")
  cat("  "); cat(attr(a, "heading"), "\n")
  print(sapply(a, function(c) format(c, digits = 15)))
}
report("distance", ~ lod + distance, ~ lod)
report("lod x distance", ~ lod * distance, ~ lod + distance)

# Epsilons with all digits, from the covariance of orthonormal contrasts.
epsilons <- function(z) {
  S <- cov(z); k <- ncol(z); n <- nrow(z)
  gg <- sum(diag(S))^2 / (k * sum(S^2)); hf <- (n * k * gg - 2) / (k * (n - 1 - k * gg))
  cat("  GG", format(gg, digits = 15), "HF", format(hf, digits = 15), "\n")
}
C <- contr.poly(4)
epsilons(((y[, 1:4] + y[, 5:8]) / sqrt(2)) %*% C)
epsilons(((y[, 1:4] - y[, 5:8]) / sqrt(2)) %*% C)

# Partial eta squared of the distance by noncentral F.
etaInterval <- function(f, df1, df2, level) {
  bound <- function(p) {
    if (pf(f, df1, df2) < p) return(0)
    uniroot(function(l) pf(f, df1, df2, ncp = l) - p, c(0, 1000 + 20 * f * df1), tol = 1e-12)$root
  }
  l <- c(bound(1 - (1 - level) / 2), bound((1 - level) / 2))
  l / (l + df1 + df2 + 1)
}
cat("eta interval F(1,11)=5.337, 0.95:", format(etaInterval(5.337, 1, 11, 0.95), digits = 15), "\n")
cat("eta interval F(6,42)=30.226, 0.90:", format(etaInterval(30.226, 6, 42, 0.90), digits = 15), "\n")
cat("eta interval F(3,15)=0.8, 0.95:", format(etaInterval(0.8, 3, 15, 0.95), digits = 15), "\n")

# Paired comparisons of the distances.
means <- (y[, 1:4] + y[, 5:8]) / 2
p <- c()
for (i in 1:3) for (j in (i + 1):4) {
  t <- t.test(means[, i], means[, j], paired = TRUE)
  cat(i, j, format(c(t$estimate, t$statistic, t$p.value, t$conf.int), digits = 15), "\n"); p <- c(p, t$p.value)
}
cat("holm", format(p.adjust(p, "holm"), digits = 15), "\n")

# The F values that are printed in the thesis.
cat("p", format(c(pf(5.337, 1, 11, lower = FALSE), pf(30.226, 6, 42, lower = FALSE), pf(3.139, 6, 42, lower = FALSE),
  pf(98.926, 1, 7, lower = FALSE), pf(29.377, 1, 7, lower = FALSE)), digits = 15), "\n")

# One factor of 4 levels, 8 subjects, far from spherical: both epsilons are below 1.
u <- matrix(c(
  4.1, 5.0, 9.7, 3.2,  3.6, 4.9, 5.1, 8.8,  4.4, 5.2, 12.3, 6.1,  3.9, 4.4, 2.6, 7.7,
  4.0, 5.3, 8.1, 10.9,  4.6, 5.1, 3.3, 4.8,  3.7, 4.6, 10.2, 9.4,  4.2, 5.5, 6.6, 2.9), nrow = 8, byrow = TRUE)
fit <- lm(u ~ 1); null <- update(fit, ~ 0); idata <- data.frame(level = factor(1:4))
report("spread", ~ level, ~ 1)
epsilons(u %*% contr.poly(4))

# mauchly.test of R 4.2 puts the number of columns before the contrasts into its second-order term. Given the contrasts
# themselves that number is right.
own <- function(z) { m <- mauchly.test(lm(z ~ 1)); cat("Mauchly", format(c(m$statistic, m$p.value), digits = 15), "\n") }
own(((y[, 1:4] + y[, 5:8]) / sqrt(2)) %*% contr.poly(4))
own(((y[, 1:4] - y[, 5:8]) / sqrt(2)) %*% contr.poly(4))
own(u %*% contr.poly(4))
