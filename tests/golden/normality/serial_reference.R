# What R gives for randomness, bias, two samples and the dip:
#   Rscript serial_reference.R ROOT > serial_reference.csv
# R 4.2.2 with Debian's lmtest 0.9-40, tseries 0.10-53 and diptest 0.76.
suppressMessages({library(lmtest); library(tseries); library(diptest)})
root <- commandArgs(TRUE)[1]
out <- function(sample, what, value)
  cat(sprintf("%s,%s,%.17g\n", sample, what, value))
cat("sample,statistic,value\n")
b <- read.csv(file.path(root, "data/sets/nistir5367_appendix_b.csv"))
samples <- list(appendix_b_residual = b$residual_mm)
for (name in c("normal_20", "t3_20", "uniform_20", "normal_397", "t3_397",
               "uniform_397", "normal_5000", "t3_5000"))
  samples[[paste0("sample_", name)]] <- read.csv(file.path(root,
    "tests/golden/samples", paste0("sample_", name, ".csv")))$value
for (name in names(samples)) {
  x <- samples[[name]]
  n <- length(x)
  out(name, "acf1", acf(x, plot = FALSE)$acf[2])
  out(name, "durbin_watson", unname(dwtest(x ~ 1)$statistic))
  lags <- min(10, n %/% 5)
  box <- Box.test(x, lags, "Ljung-Box")
  out(name, "ljung_box", unname(box$statistic))
  out(name, "ljung_box_p", box$p.value)
  side <- x[x != median(x)] > median(x)
  runs <- runs.test(factor(side))
  out(name, "runs_z", unname(runs$statistic))
  out(name, "runs_p", runs$p.value)
  half <- n %/% 2
  ks <- ks.test(x[seq_len(half)], x[(half + 1):n], exact = n < 1000)
  out(name, "halves_d", unname(ks$statistic))
  out(name, if (n < 1000) "halves_p" else "halves_asymptotic_p", ks$p.value)
  out(name, "dip", dip(x))
  for (q in c(0.1, 0.25, 0.5, 0.75, 0.99))
    out(name, sprintf("q%g", 100 * q), unname(quantile(x, q)))
}
e <- b$residual_mm
lm_e2 <- summary(lm(e^2 ~ b$predicted_mm))$r.squared * length(e)
out("appendix_b_residual", "breusch_pagan_given_residuals", lm_e2)
out("appendix_b_residual", "breusch_pagan_given_residuals_p",
    pchisq(lm_e2, 1, lower.tail = FALSE))
for (by in c("cycle", "position_mm")) {
  a <- anova(lm(e ~ factor(b[[by]])))
  out("appendix_b_residual", paste0("anova_f_", by), a[["F value"]][1])
  out("appendix_b_residual", paste0("anova_p_", by), a[["Pr(>F)"]][1])
}
cycle7 <- e[b$cycle == 7]
out("appendix_b_residual", "cycle7_mean", mean(cycle7))
out("appendix_b_residual", "cycle7_se", sd(cycle7) / sqrt(length(cycle7)))
# Small samples by hand: ties, unequal sizes.
tied <- ks.test(c(1, 2, 2, 3, 3), c(1, 2, 3, 4, 4, 5, 5), exact = TRUE)
out("tied", "d", unname(tied$statistic))
out("tied", "p", tied$p.value)
plain <- ks.test(c(0.61, 0.29, 0.06, 0.59, -1.73), c(-0.74, 0.51, -0.56, 0.39,
  1.64, 0.05, -0.06, 0.64, -0.82), exact = TRUE)
out("plain", "d", unname(plain$statistic))
out("plain", "p", plain$p.value)
out("ties_1_to_20", "dip", dip(rep(c(1, 2, 3, 3, 3, 9, 9, 9, 10), 4)))
out("two_modes", "dip", dip(c(1:20, 101:120)))
for (n in c(3, 5, 7, 11, 12, 50)) {
  x <- seq_len(n)^2
  s <- shapiro.test(x)
  out(paste0("squares_", n), "shapiro_w", unname(s$statistic))
  out(paste0("squares_", n), "shapiro_p", s$p.value)
}
