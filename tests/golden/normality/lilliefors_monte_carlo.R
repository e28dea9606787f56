# Lilliefors' D of a million normal samples each: upper quantiles.
#   Rscript lilliefors_monte_carlo.R > lilliefors_monte_carlo.csv
set.seed(1995)
draws <- 1e6
levels <- c(0.9, 0.7, 0.5, 0.4, 0.3, 0.2, 0.15, 0.1, 0.05, 0.02, 0.01)
cat("n,p,d\n")
for (n in c(20, 100, 397, 1000)) {
  below <- (seq_len(n) - 1) / n
  d <- numeric(draws)
  for (i in seq_len(draws)) {
    x <- rnorm(n)
    f <- sort.int(pnorm((x - mean(x)) / sd(x)), method = "quick")
    d[i] <- max(f - below, below + 1 / n - f)
  }
  q <- sort(d)[ceiling((1 - levels) * draws)]
  cat(sprintf("%d,%g,%.7f\n", n, levels, q), sep = "")
}
