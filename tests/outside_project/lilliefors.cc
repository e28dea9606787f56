// A test of normality, from the statistics alone.
#include <iostream>

#include <errmap/stats/normality/lilliefors.h>

int main() {
  const Eigen::VectorXd sample{
      {4.1, 5.2, 3.9, 4.8, 5.5, 4.4, 4.9, 5.1, 4.6, 5.0, 4.2, 4.7}};
  const auto test =
      errmap::stats::Lilliefors(errmap::stats::OrderedSample(sample));
  std::cout << "D = " << test.statistic << ", p = " << test.p << "\n";
}
