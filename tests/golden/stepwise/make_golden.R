# Golden figures of stepwise regression, by R alone:
#
#   Rscript make_golden.R          (in tests/golden/stepwise; R 4.2.2, MASS 7.3)
#
# writes quadratic.json (902 quadratic terms of 41 inputs, 595 rows) and
# shipped.json (14 terms of degree 4 in 2 inputs, 397 rows). Every number has
# 17 significant digits.
library(MASS)  # for its version only: step() and extractAIC() are in stats

number <- function(x) {
  ifelse(is.finite(x), sprintf("%.17g", x), "null")
}
array <- function(x) paste0("[", paste(x, collapse = ", "), "]")
numbers <- function(x) array(number(x))

# All terms of order 1 .. degree, by order, earlier inputs first.
all_terms <- function(p, degree) {
  terms <- list()
  grow <- function(order, input, powers) {
    if (input == p) {
      powers[p] <- order
      terms[[length(terms) + 1]] <<- powers
      return(invisible())
    }
    for (power in order:0) {
      powers[input] <- power
      grow(order - power, input + 1, powers)
    }
  }
  for (order in 1:degree) grow(order, 1, rep(0, p))
  terms
}

# Inputs as they are, or with their range mapped to -1 .. 1.
scale_inputs <- function(inputs, centred) {
  if (!centred) return(inputs)
  apply(inputs, 2, function(x) {
    half <- 0.5 * (max(x) - min(x))
    if (half == 0) x - x else (x - (min(x) + half)) / half
  })
}

term_columns <- function(inputs, terms) {
  columns <- sapply(terms, function(powers) {
    value <- rep(1, nrow(inputs))
    for (i in which(powers > 0)) value <- value * inputs[, i]^powers[i]
    value
  })
  colnames(columns) <- paste0("c", seq_along(terms) - 1)
  columns
}

# The steps of step(), and what summary(lm), PRESS and VIF say of its result.
run <- function(name, frame, direction, k, weights = NULL) {
  candidates <- setdiff(names(frame), c("y", "w"))
  everything <- as.formula(paste("~", paste(candidates, collapse = " + ")))
  start <- if (direction == "backward") {
    as.formula(paste("y ~", paste(candidates, collapse = " + ")))
  } else {
    y ~ 1
  }
  environment(start) <- environment()
  w <- if (is.null(weights)) rep(1, nrow(frame)) else weights
  first <- lm(start, data = frame, weights = w)
  fit <- step(first, scope = list(lower = ~1, upper = everything),
              direction = direction, k = k, trace = 0, steps = 10000)
  path <- fit$anova
  chosen <- attr(terms(fit), "term.labels")
  s <- summary(fit)
  x <- as.matrix(frame[, chosen, drop = FALSE])
  vif <- sapply(seq_along(chosen), function(j) {
    own <- x[, j]
    mean <- sum(w * own) / sum(w)
    others <- x[, -j, drop = FALSE]
    rest <- if (ncol(others) == 0) lm(own ~ 1, weights = w) else
      lm(own ~ others, weights = w)
    sum(w * (own - mean)^2) / sum(w * resid(rest)^2)
  })
  press <- sum(w * (resid(fit) / (1 - hatvalues(fit)))^2)
  moves <- as.character(path$Step)
  paste0(
    '{"name": "', name, '",\n "direction": "', direction, '", "k": ', number(k),
    ',\n "steps": ', array(paste0('"', gsub(" ", "", moves), '"')),
    ',\n "rss": ', numbers(path$`Resid. Dev`),
    ',\n "aic": ', numbers(path$AIC),
    ',\n "terms": ', array(paste0('"', chosen, '"')),
    ',\n "estimate": ', numbers(s$coefficients[, 1]),
    ',\n "standard_error": ', numbers(s$coefficients[, 2]),
    ',\n "t": ', numbers(s$coefficients[, 3]),
    ',\n "p": ', numbers(s$coefficients[, 4]),
    ',\n "lower": ', numbers(confint(fit)[, 1]),
    ',\n "upper": ', numbers(confint(fit)[, 2]),
    ',\n "vif": ', numbers(vif),
    ',\n "s": ', number(s$sigma), ', "r2": ', number(s$r.squared),
    ', "adjusted_r2": ', number(s$adj.r.squared),
    ', "press": ', number(press),
    ',\n "f": ', number(s$fstatistic[1]), ', "aic_R": ', number(AIC(fit)),
    ', "bic_R": ', number(BIC(fit)), "}")
}

write_cases <- function(file, cases) {
  cat('{"R": "', R.version.string, '", "MASS": "',
      as.character(packageVersion("MASS")), '", "cases": [\n',
      paste(cases, collapse = ",\n"), "\n]}\n", sep = "", file = file)
}

train <- read.csv("../netcg/train.csv")
held_out <- read.csv("held_out.csv")
all_rows <- rbind(train, held_out)
inputs <- as.matrix(all_rows[, setdiff(names(all_rows), "error_mm")])
inputs <- cbind(inputs, dead1 = 0, dead2 = 0, dead3 = 0, dead4 = 0)
quadratic <- all_terms(ncol(inputs), 2)
stopifnot(length(quadratic) == 902)
n <- nrow(inputs)
cases <- c()
for (centred in c(TRUE, FALSE)) {
  x <- term_columns(scale_inputs(inputs, centred), quadratic)
  frame <- data.frame(x, y = all_rows$error_mm)
  label <- if (centred) "centred" else "raw"
  cases <- c(cases,
             run(paste0(label, ", BIC"), frame, "forward", log(n)),
             run(paste0(label, ", AIC"), frame, "forward", 2))
}
write_cases("quadratic.json", cases)

shipped <- read.csv("../../../data/sets/nistir5367_xdisp_down.csv")
two <- as.matrix(shipped[, c("position_mm", "elapsed_cycles")])
quartic <- all_terms(2, 4)
x <- term_columns(scale_inputs(two, TRUE), quartic)
frame <- data.frame(x, y = shipped$error_mm)
w <- 1 + (seq_len(nrow(frame)) - 1) %% 3
cases <- c()
for (direction in c("forward", "backward", "both")) {
  for (k in c(2, log(nrow(frame)))) {
    cases <- c(cases,
               run(paste(direction, if (k == 2) "AIC" else "BIC"), frame,
                   direction, k),
               run(paste(direction, if (k == 2) "AIC" else "BIC", "weighted"),
                   cbind(frame, w = w), direction, k, w))
  }
}
write_cases("shipped.json", cases)
