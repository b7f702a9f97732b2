# SPDX-License-Identifier: BSD-3-Clause
# What limen analyse correlate and scale say of small tables.
# Run: Rscript relations.R
options(digits = 15)
show <- function(label, x) cat(label, format(x, digits = 15), "\n")

# Three predictors of rates, with ties.
x <- list(a = c(1.2, 0.8, 2.5, 2.5, 3.1, 0.4, 1.9, 4.0, 2.5, 3.3, 0.4, 1.2),
          b = c(3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8), c = c(0.1, 0.3, 0.2, 0.5, 0.9, 0.2, 0.6, 0.7, 0.8, 0.4, 0.3, 0.1))
y <- c(0.25, 0.25, 0.5, 0.75, 1, 0, 0.5, 1, 0.75, 0.5, 0.25, 0)
for (m in c("kendall", "spearman", "pearson")) {
  t <- lapply(x, function(v) suppressWarnings(cor.test(v, y, method = m, exact = FALSE)))
  show(paste(m, "estimates"), sapply(t, function(r) r$estimate))
  p <- sapply(t, function(r) r$p.value)
  show("  p", p); show("  p Holm", p.adjust(p, "holm"))
}
show("pearson a, 90 %", cor.test(x$a, y, conf.level = 0.9)$conf.int)
# R_c is 3.1, so 4.0 and 3.3 are lowered.
t <- cor.test(pmin(x$a, 3.1), y); show("clamped", c(t$estimate, t$p.value, t$conf.int))

# Areas after DeLong, DeLong and Clarke-Pearson (1988), from the placements themselves.
o <- c(0, 0, 1, 1, 1, 0, 0, 1, 1, 0, 1, 0)
psi <- function(v) outer(v[o == 1], v[o == 0], function(s, t) (s > t) + 0.5 * (s == t))
V <- lapply(x, psi); A <- sapply(V, mean); show("areas", A)
S <- cov(sapply(V, rowMeans)) / sum(o == 1) + cov(sapply(V, colMeans)) / sum(o == 0)
show("variances", diag(S))
pairs <- combn(3, 2); d <- apply(pairs, 2, function(k) A[k[1]] - A[k[2]])
e <- apply(pairs, 2, function(k) sqrt(S[k[1], k[1]] + S[k[2], k[2]] - 2 * S[k[1], k[2]]))
p <- 2 * pnorm(-abs(d / e)); show("differences", d); show("  errors", e); show("  p", p); show("  p Holm", p.adjust(p, "holm"))
show("Brier c", mean((x$c - o)^2))

# wins[i, j]: how often i was chosen over j. Items are named p, q, r, s.
wins <- matrix(c(0, 14, 18, 25, 16, 0, 17, 21, 12, 13, 0, 19, 5, 9, 11, 0), nrow = 4, byrow = TRUE)
pairs <- t(combn(4, 2)); k <- wins[pairs]; l <- wins[pairs[, 2:1]]
X <- t(apply(pairs, 1, function(p) { v <- rep(0, 4); v[p[1]] <- 1; v[p[2]] <- -1; v }))
for (link in c("logit", "probit")) {
  # s is the reference: its value is 0.
  g <- glm(cbind(k, l) ~ X[, 1:3] - 1, family = binomial(link), control = list(epsilon = 1e-14, maxit = 100))
  f <- if (link == "logit") plogis else pnorm
  ll <- function(s) { e <- as.vector(X[, 1:3] %*% s); -sum(k * log(f(e)) + l * log(f(-e))) }
  W <- solve(optimHess(coef(g), ll, control = list(ndeps = rep(1e-4, 3))))
  show(paste(link, "values against s"), coef(g)); show("  errors", sqrt(diag(W))); show("  preferred", f(coef(g)))
  v <- c(coef(g), 0); C <- rbind(cbind(W, 0), 0); order <- order(-v); show("  order", order)
  d <- -diff(v[order]); e <- sapply(1:3, function(i) { a <- order[i]; b <- order[i + 1]; sqrt(C[a, a] + C[b, b] - 2 * C[a, b]) })
  p <- 2 * pnorm(-abs(d / e)); show("  steps", d); show("  errors", e); show("  p", p); show("  p Holm", p.adjust(p, "holm"))
  show("  deviance, X2", c(deviance(g), sum(residuals(g, "pearson")^2)))
}
# Thurstone's case V by least squares (Mosteller 1951): row means of z.
P <- wins / (wins + t(wins)); diag(P) <- 0.5; z <- qnorm(P); m <- rowMeans(z); show("least squares against s", m - m[4])
