#include "stats/f_test.h"

#include <cmath>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "stats/not_a_number.h"
#include "stats/require.h"

namespace errmap::stats {
double FTestPValue(double f, double df1, double df2) {
  if (std::isnan(f) || !(df1 > 0.0) || !(df2 > 0.0)) return kNaN;
  if (f <= 0.0) return 1.0;
  if (std::isinf(f)) return 0.0;
  return boost::math::cdf(
      boost::math::complement(boost::math::fisher_f(df1, df2), f));
}

double StudentTwoSidedP(double t, double df) {
  if (std::isnan(t) || !(df > 0.0)) return kNaN;
  if (std::isinf(t)) return 0.0;
  return 2.0 * boost::math::cdf(boost::math::complement(
                   boost::math::students_t(df), std::abs(t)));
}

double StudentTwoSidedQuantile(double confidence, double df) {
  Require(confidence > 0.0 && confidence < 1.0,
          "StudentTwoSidedQuantile: confidence must be above 0 and below 1",
          confidence);
  if (!(df > 0.0)) return kNaN;
  return boost::math::quantile(boost::math::complement(
      boost::math::students_t(df), 0.5 * (1.0 - confidence)));
}

}  // namespace errmap::stats
