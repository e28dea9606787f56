#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/record.h"
#include "stats/normality/normality.h"
#include "stats/randomness.h"

// Tests of held-out residuals: their distribution, their order, and remaining
// biases at the levels of a column.

namespace errmap::models {

/// A test, or the reason why it does not apply. The statistics are named as
/// their keys.
#define ERRMAP_TEST_RECORD(Struct, statistic) \
  struct Struct {                             \
    double statistic = kNotKnown;             \
    double p = kNotKnown;                     \
    LeftOut<std::string> why;                 \
  };

ERRMAP_TEST_RECORD(DTestRecord, d)
ERRMAP_TEST_RECORD(WTestRecord, w)
ERRMAP_TEST_RECORD(A2TestRecord, a2)
ERRMAP_TEST_RECORD(JbTestRecord, jb)
ERRMAP_TEST_RECORD(K2TestRecord, k2)
ERRMAP_TEST_RECORD(DipTestRecord, dip)
ERRMAP_TEST_RECORD(ZTestRecord, z)
ERRMAP_TEST_RECORD(RTestRecord, r)
ERRMAP_TEST_RECORD(QTestRecord, q)
ERRMAP_TEST_RECORD(FTestRecord, f)
ERRMAP_TEST_RECORD(LmTestRecord, lm)

struct KsRecord {
  double d = kNotKnown;
  double p_given = kNotKnown;  // Eq. 140: mean and sd taken as given
  LeftOut<std::string> why;
  double p_given_exact = kNotKnown;
};

struct PpccRecord {
  double lambda = kNotKnown;
  double r_max = kNotKnown;
  LeftOut<double> p_max;
  LeftOut<double> r_014;
  double r_normal = kNotKnown;
  LeftOut<double> p_normal;
  LeftOut<std::string> why;
};

/// p-values are limited to 0.001 and 0.999 if they come from simulated tables.
/// With a `step` they are shares of normal samples with the same rounding.
struct NormalityRecord {
  KsRecord ks;
  DTestRecord lilliefors;
  WTestRecord shapiro_wilk;
  A2TestRecord anderson_darling;
  JbTestRecord jarque_bera;
  K2TestRecord dagostino_pearson;
  PpccRecord ppcc;
  DipTestRecord dip;
  double skewness = kNotKnown;
  double kurtosis = kNotKnown;
  LeftOut<double> step;  // of rounded readings, if it matters
  LeftOut<stats::MonteCarloP> monte_carlo;
};

struct RunsRecord {
  Inline<ZTestRecord> test;
  LeftOut<std::int64_t> runs;
  LeftOut<double> expected;
};

struct Lag1Record {
  Inline<RTestRecord> test;
  LeftOut<double> expected;
};

struct LjungBoxRecord {
  Inline<QTestRecord> test;
  LeftOut<std::int64_t> lags;
};

struct SerialRecord {
  RunsRecord runs;
  Lag1Record lag1;
  DTestRecord durbin_watson;
  LjungBoxRecord ljung_box;
  LeftOut<stats::SerialShuffles> shuffled;
};

struct LevelRecord {
  std::string level;
  std::int64_t n = 0;
  double mean = kNotKnown;
  double standard_error = kNotKnown;
};

/// Biases at the levels of one column.
struct BiasRecord {
  Inline<FTestRecord> test;
  std::string column;
  double explained = kNotKnown;  // share of the sum of squares
  std::vector<LevelRecord> levels;
};

struct SpreadRecord {
  Inline<LmTestRecord> test;
  std::string column;
};

struct RandomnessRecord {
  std::string order;
  SerialRecord in_order;
  std::optional<SerialRecord> within_groups;
  DTestRecord halves;
  std::optional<BiasRecord> by_group;
  std::optional<BiasRecord> by_position;
  std::optional<SpreadRecord> breusch_pagan;
};

}  // namespace errmap::models
