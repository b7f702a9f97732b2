# SPDX-License-Identifier: BSD-3-Clause
# Mixed-effects logistic regressions with lme4's glmer, Laplace approximation.
# Run: Rscript mixed.R
suppressMessages(library(lme4))
options(digits = 12)
# Detections of 12 trials: 8 subjects (rows) at 5 intensities.
x <- c(-1, -0.4, 0.2, 0.8, 1.4)
k <- matrix(c(
  1, 3, 6, 9, 11,  0, 1, 2, 5, 7,  3, 5, 9, 11, 12,  1, 2, 7, 10, 12,
  2, 6, 6, 8, 9,  0, 2, 5, 9, 12,  1, 1, 3, 4, 6,  4, 7, 10, 10, 12), nrow = 8, byrow = TRUE)
d <- data.frame(k = as.vector(t(k)), x = rep(x, 8), subject = factor(rep(1:8, each = 5)))
control <- glmerControl(optimizer = "bobyqa", tolPwrss = 1e-13, optCtrl = list(maxfun = 1e6, rhoend = 1e-9))
report <- function(m) {
  print(coef(summary(m)), digits = 10)
  print(as.data.frame(VarCorr(m)), digits = 10)
  cat("logLik", format(as.numeric(logLik(m)), digits = 12), "AIC", format(AIC(m), digits = 12), "\n")
}
m1 <- glmer(cbind(k, 12 - k) ~ x + (1 | subject), d, binomial, control = control); report(m1)
print(ranef(m1)$subject, digits = 8)
m2 <- glmer(cbind(k, 12 - k) ~ x + (x | subject), d, binomial, control = control); report(m2)
print(ranef(m2)$subject, digits = 8)

# Yes or no, one trial a row, two columns, groups of unequal size.
b <- data.frame(
  y = c(1,0,1,1,0,1,1,0,0,1,0,1,1,1,0,0,0,1,0,0,1,1,1,0,1,1,1,0,1,0,0,1,0,0,0,1),
  v = c(0.3,-1.2,0.8,1.5,-0.6,0.1,2.2,-0.4,0.9,1.1,-0.7,0.2,0.5,1.9,-1.5,0.6,-0.2,1.3,-0.9,0.4,0.7,-0.3,1.6,-1.1,
        0.2,1.8,0.5,-0.8,0.9,-1.4,0.1,1.2,0.0,-0.5,0.3,0.6),
  w = c(0,1,0,1,1,0,1,0,1,0,1,0,0,1,1,0,1,0,1,0,1,0,1,0,1,1,0,1,0,1,0,0,1,1,0,1),
  group = factor(c(rep(1, 5), rep(2, 8), rep(3, 7), rep(4, 9), rep(5, 7))))
m3 <- glmer(y ~ v + w + (1 | group), b, binomial, control = control); report(m3)

# A random slope whose correlation with the level is -1: 6 subjects (rows) at 6 intensities, 4 trials.
e <- data.frame(k = c(1, 1, 0, 0, 1, 3, 3, 3, 4, 3, 4, 4, 1, 2, 3, 2, 3, 4, 1, 1, 1, 0, 4, 3, 0, 0, 0, 1, 1, 1, 3, 4, 3, 3, 4, 4),
  x = rep(c(-1, -0.6, -0.2, 0.2, 0.6, 1), 6), subject = factor(rep(1:6, each = 6)))
m4 <- glmer(cbind(k, 4 - k) ~ x + (x | subject), e, binomial, control = control); report(m4)
