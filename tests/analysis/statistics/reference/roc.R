# SPDX-License-Identifier: BSD-3-Clause
# Receiver operating characteristics with pROC (Debian's r-cran-proc).
# Run: Rscript roc.R
suppressMessages(library(pROC))
options(digits = 15)
show <- function(label, x) cat(label, format(x, digits = 15), "\n")
outcome <- c(1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1)
first <- c(2.1, 0.4, 1.8, 0.9, 0.9, 0.2, 3.0, 1.1, 1.1, 0.7, 2.6, 1.9, 0.8, 0.1, 1.2, 2.2)
second <- c(0.6, 0.5, 0.9, 0.3, 0.4, 0.6, 0.8, 0.2, 0.7, 0.6, 0.9, 0.5, 0.1, 0.3, 0.7, 0.4)
a <- roc(outcome, first, direction = "<", quiet = TRUE); b <- roc(outcome, second, direction = "<", quiet = TRUE)
show("area", c(auc(a), var(a, method = "delong"))); show("interval", ci.auc(a, method = "delong"))
show("area", c(auc(b), var(b, method = "delong"))); show("covariance", cov(a, b, method = "delong"))
t <- roc.test(a, b, method = "delong", paired = TRUE); show("test", c(t$statistic, t$p.value))
