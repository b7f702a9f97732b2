# SPDX-License-Identifier: BSD-3-Clause
# What R and lme4 say of the tables beside this script.
# Run here: Rscript groups.R
suppressMessages(library(lme4))
options(digits = 12)
show <- function(label, x) cat(label, format(x, digits = 12), "\n")

# Repeated measures: rates of 7 subjects in presentation (2) x distance (3); levels as Limen orders them.
d <- read.csv("rates.csv")
d$subject <- factor(d$subject); d$presentation <- factor(d$presentation, c("still", "moving")); d$distance <- factor(d$distance)
report <- function(y) {
  d$y <- y
  fits <- summary(aov(y ~ presentation * distance + Error(subject / (presentation * distance)), d))
  for (name in names(fits)[-1]) { cat(name, "\n"); print(sapply(fits[[name]][[1]], function(c) format(c, digits = 12))) }
}
cat("rates\n"); report(d$seen / d$shown)
cat("arcsine\n"); report(asin(sqrt(d$seen / d$shown)))
d$y <- d$seen / d$shown
cells <- with(d, tapply(y, list(subject, interaction(presentation, distance, lex.order = TRUE)), mean))
idata <- data.frame(presentation = factor(rep(1:2, each = 3)), distance = factor(rep(1:3, 2)))
epsilons <- function(label, z) {
  S <- cov(z); k <- ncol(z); n <- nrow(z)
  gg <- sum(diag(S))^2 / (k * sum(S^2)); hf <- (n * k * gg - 2) / (k * (n - 1 - k * gg))
  m <- mauchly.test(lm(z ~ 1))
  F <- n * sum(colMeans(z)^2) / k / (sum(diag(S)) / k)
  show(label, c(m$statistic, m$p.value, gg, min(hf, 1), pf(F, k * gg, k * gg * (n - 1), lower = FALSE),
                pf(F, k * min(hf, 1), k * min(hf, 1) * (n - 1), lower = FALSE), F))
}
sums <- (cells[, 1:3] + cells[, 4:6]) / sqrt(2); differences <- (cells[, 1:3] - cells[, 4:6]) / sqrt(2)
epsilons("distance W p GG HF pGG pHF F", sums %*% contr.poly(3))
epsilons("presentation x distance", differences %*% contr.poly(3))
means <- (cells[, 1:3] + cells[, 4:6]) / 2
p <- w <- c()
for (i in 1:2) for (j in (i + 1):3) {
  t <- t.test(means[, i], means[, j], paired = TRUE)
  show(paste("pair", colnames(means)[i], colnames(means)[j]),
       c(t$estimate, t$conf.int, t$statistic, t$p.value, mean(means[, i] - means[, j]) / sd(means[, i] - means[, j])))
  # To 9 digits, so that equal differences are ties.
  v <- suppressWarnings(wilcox.test(round(means[, i] - means[, j], 9)))
  show("  wilcoxon", c(v$statistic, v$p.value))
  p <- c(p, t$p.value); w <- c(w, v$p.value)
}
show("holm t", p.adjust(p, "holm")); show("holm wilcoxon", p.adjust(w, "holm"))
f <- friedman.test(round(means, 9)); show("friedman", c(f$statistic, f$p.value))
show("ranks", colMeans(t(apply(round(means, 9), 1, rank))))
show("mean sd low high of 10", c(mean(means[, 2]), sd(means[, 2]), t.test(means[, 2])$conf.int))

# Signal detection by observer, rates as (k + 1/2) / (n + 1).
y <- read.csv("yes_no.csv")
sdt <- function(h, n, f, m) {
  H <- (h + 0.5) / (n + 1); F <- (f + 0.5) / (m + 1); zH <- qnorm(H); zF <- qnorm(F)
  a <- function(H, F) if (H >= F) 0.5 + (H - F) * (1 + H - F) / (4 * H * (1 - F)) else 0.5 - (F - H) * (1 + F - H) / (4 * F * (1 - H))
  e <- 1e-5; aH <- (a(H + e, F) - a(H - e, F)) / (2 * e); aF <- (a(H, F + e) - a(H, F - e)) / (2 * e)
  vH <- H * (1 - H) / n; vF <- F * (1 - F) / m
  error <- sqrt(vH / dnorm(zH)^2 + vF / dnorm(zF)^2)
  c(d = zH - zF, dLow = zH - zF - qnorm(0.975) * error, c = -(zH + zF) / 2, cHigh = -(zH + zF) / 2 + qnorm(0.975) * error / 2,
    lnBeta = (zF^2 - zH^2) / 2, beta = dnorm(zH) / dnorm(zF), A = a(H, F), Ase = sqrt(aH^2 * vH + aF^2 * vF))
}
rows <- sapply(unique(y$observer), function(o) with(y[y$observer == o, ],
  sdt(sum(answer[change == 1]), sum(change == 1), sum(answer[change == 0]), sum(change == 0))))
print(rows, digits = 12)
for (name in c("d", "c", "lnBeta", "A")) show(paste("mean", name), c(mean(rows[name, ]), sd(rows[name, ]), t.test(rows[name, ])$conf.int))
b <- y[y$light == "bright", ]
bright <- sapply(unique(b$observer), function(o) with(b[b$observer == o, ],
  sdt(sum(answer[change == 1]), sum(change == 1), sum(answer[change == 0]), sum(change == 0))))
show("mean d bright", c(mean(bright["d", ]), t.test(bright["d", ])$conf.int))

# Mixed-effects logistic regression: a factor against its first level, times a centred logarithm.
x <- read.csv("textures.csv")
x$texture <- factor(x$texture, c("wood", "brick", "noise")); x$size <- log(x$size) - mean(log(x$size)); x$observer <- factor(x$observer)
control <- glmerControl(optimizer = "bobyqa", tolPwrss = 1e-13, optCtrl = list(maxfun = 1e6, rhoend = 1e-9))
fixed <- function(m) {
  print(coef(summary(m)), digits = 10)
  print(as.data.frame(VarCorr(m)), digits = 10)
  cat("logLik", format(as.numeric(logLik(m)), digits = 12), "AIC", format(AIC(m), digits = 12), "\n")
}
fixed(glmer(cbind(seen, shown - seen) ~ texture * size + (1 | observer), x, binomial, control = control))
fixed(glmer(cbind(seen, shown - seen) ~ texture + size + (size | observer), x, binomial, control = control))
# Single trials.
fixed(glmer(answer ~ relevel(factor(light), "dim") + change + (1 | observer), y, binomial, control = control))
