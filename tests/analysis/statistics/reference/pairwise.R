# SPDX-License-Identifier: BSD-3-Clause
# Scales from paired comparisons as generalised linear models of glm.
# Run: Rscript pairwise.R
options(digits = 15)
show <- function(label, x) cat(label, format(x, digits = 15), "\n")
# wins[i, j]: how often i was chosen over j.
wins <- matrix(c(0, 14, 18, 25, 16, 0, 17, 21, 12, 13, 0, 19, 5, 9, 11, 0), nrow = 4, byrow = TRUE)
pairs <- t(combn(4, 2)); k <- wins[pairs]; l <- wins[pairs[, 2:1]]
X <- t(apply(pairs, 1, function(p) { v <- rep(0, 4); v[p[1]] <- 1; v[p[2]] <- -1; v }))
B <- rbind(diag(3), -1)  # values that sum to 0
for (link in c("logit", "probit")) {
  g <- glm(cbind(k, l) ~ X %*% B - 1, family = binomial(link), control = list(epsilon = 1e-14, maxit = 100))
  show(paste(link, "values"), B %*% coef(g))
  # Observed information, which differs from glm's expected one for the probit.
  ll <- function(s) { e <- as.vector(X %*% B %*% s); f <- if (link == "logit") plogis else pnorm
    -sum(k * log(f(e)) + l * log(f(-e))) }
  H <- optimHess(coef(g), ll, control = list(ndeps = rep(1e-4, 3)))
  show("  errors", sqrt(diag(B %*% solve(H) %*% t(B))))
  show("  deviance, X2, df", c(deviance(g), sum(residuals(g, "pearson")^2), df.residual(g)))
  show("  p", pchisq(c(deviance(g), sum(residuals(g, "pearson")^2)), df.residual(g), lower = FALSE))
}
# Least squares of a complete design: row means of z (Mosteller 1951).
p <- wins / (wins + t(wins)); diag(p) <- 0.5; z <- qnorm(p)
show("least squares", rowMeans(z))
v <- p * (1 - p) / ((wins + t(wins)) * dnorm(z)^2); diag(v) <- 0
show("  errors", sapply(1:4, function(i) sqrt(sum(v[i, ]) / 16)))
# Unanimous: item 1 always wins. Penalised by a normal prior of standard deviation 2.
k2 <- c(30, 30, 17); l2 <- c(0, 0, 13); p2 <- t(combn(3, 2))
X2 <- t(apply(p2, 1, function(p) { v <- rep(0, 3); v[p[1]] <- 1; v[p[2]] <- -1; v }))
o <- optim(rep(0, 3), function(s) { e <- as.vector(X2 %*% s); -sum(k2 * plogis(e, log.p = TRUE) + l2 * plogis(-e, log.p = TRUE)) + sum(s^2) / 8 },
  method = "BFGS", control = list(reltol = 1e-16))
show("penalised", o$par)
