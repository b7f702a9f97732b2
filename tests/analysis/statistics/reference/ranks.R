# SPDX-License-Identifier: BSD-3-Clause
# Correlations of ranks and values, and tests on ranks.
# Run: Rscript ranks.R
options(digits = 15)
show <- function(label, x) cat(label, format(x, digits = 15), "\n")

# With ties; x as a predictor, y as detection rates.
x <- c(1.2, 0.8, 2.5, 2.5, 3.1, 0.4, 1.9, 4.0, 2.5, 3.3, 0.4, 1.2)
y <- c(0.25, 0.25, 0.5, 0.75, 1, 0, 0.5, 1, 0.75, 0.5, 0.25, 0)
t <- suppressWarnings(cor.test(x, y, method = "kendall", exact = FALSE))
show("tau_b z p", c(t$estimate, t$statistic, t$p.value))
# Goodman and Kruskal's counts and asymptotic errors (Brown and Benedetti 1977), from the contingency table.
n <- table(x, y); N <- sum(n); r <- nrow(n); c <- ncol(n)
A <- D <- n * 0
for (i in 1:r) for (j in 1:c) for (k in 1:r) for (l in 1:c) {
  s <- sign(k - i) * sign(l - j)
  if (s > 0) A[i, j] <- A[i, j] + n[k, l]
  if (s < 0) D[i, j] <- D[i, j] + n[k, l]
}
P <- sum(n * A); Q <- sum(n * D); show("P Q", c(P / 2, Q / 2))
wr <- N^2 - sum(rowSums(n)^2); wc <- N^2 - sum(colSums(n)^2); w <- sqrt(wr * wc); tb <- (P - Q) / w
v <- outer(rowSums(n) * wc, colSums(n) * wr, "+")
show("tau_b error", sqrt(sum(n * (2 * w * (A - D) + tb * v)^2) - N^3 * tb^2 * (wr + wc)^2) / w^2)
q <- min(r, c)
show("tau_c error", c(q * (P - Q) / (N^2 * (q - 1)), 2 * q / ((q - 1) * N^2) * sqrt(sum(n * (A - D)^2) - (P - Q)^2 / N)))
C <- sapply(seq_along(x), function(i) sum(sign(x - x[i]) * sign(y - y[i])))
ta <- sum(C) / (N * (N - 1))
show("tau_a error", c(ta, sqrt(2 / (N * (N - 1)) * (2 * (N - 2) / (N * (N - 1)^2) * sum((C - mean(C))^2) + 1 - ta^2))))

# Without ties.
a <- c(3.1, 0.2, 5.9, 4.4, 1.3, 2.8, 7.7, 6.1)
b <- c(2.2, 0.9, 4.1, 6.3, 0.5, 3.7, 5.2, 8.8)
t <- cor.test(a, b, method = "kendall", exact = TRUE); show("kendall exact", c(t$estimate, t$p.value))
t <- cor.test(a, b, method = "spearman", exact = TRUE); show("spearman exact", c(t$estimate, t$p.value))
t <- suppressWarnings(cor.test(x, y, method = "spearman", exact = FALSE)); show("spearman ties", c(t$estimate, t$p.value))
t <- cor.test(x, y); show("pearson", c(t$estimate, t$p.value, t$conf.int))

# 7 subjects x 4 treatments, with ties.
f <- matrix(c(5, 3, 4, 1, 6, 2, 4, 4, 7, 5, 5, 2, 3, 3, 3, 1, 8, 4, 6, 5, 6, 6, 2, 3, 5, 1, 3, 3), nrow = 7, byrow = TRUE)
t <- friedman.test(f); show("friedman", c(t$statistic, t$p.value, t$statistic / (7 * 3)))
i <- 6 * t$statistic / (21 - t$statistic); show("iman-davenport", c(i, pf(i, 3, 18, lower = FALSE)))

# 3.1 - 2.2 and 3.7 - 2.8 are a tie, which R sees only if told to round.
t <- suppressWarnings(wilcox.test(round(a - b, 9))); show("wilcoxon rounded", c(t$statistic, t$p.value))
t <- wilcox.test(c(3.1, 0.2, 5.9, 4.4, 1.3, 2.8, 7.7, 6.1), c(2.2, 0.9, 4.1, 6.3, 0.5, 1.7, 5.2, 3.0), paired = TRUE)
show("wilcoxon exact", c(t$statistic, t$p.value))
g <- c(4, 6, 7, 3, 9, 5, 8, 6, 7, 2, 5); h <- c(3, 6, 5, 4, 6, 5, 4, 7, 4, 1, 2)
t <- suppressWarnings(wilcox.test(g, h, paired = TRUE)); show("wilcoxon ties", c(t$statistic, t$p.value))
