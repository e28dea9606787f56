#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/report/plot.h"

namespace errmap::report {

/// A tic mark of an axis and its text.
struct Tic {
  double at = 0.0;
  std::string text;
};

/// Pixels along the axis that a tic's text needs.
using TicRoom = double (*)(const Tic&);

/// Lowest and highest value along an axis, including the extent of marks.
std::pair<double, double> Ends(const Plot& plot, bool along_x);

/// Maps the values of an axis to pixels from `from` to `to`.
class Scale {
 public:
  /// `ends` are the lowest and highest value that must be visible.
  Scale(const Axis& axis, std::pair<double, double> ends);

  void Span(double from, double to) {
    from_ = from;
    to_ = to;
  }
  double from() const { return from_; }
  double to() const { return to_; }

  double operator()(double value) const {
    return from_ + (Place(value) - low_) / (high_ - low_) * (to_ - from_);
  }

  /// Returns as many round numbers as fit.
  std::vector<Tic> Tics(TicRoom room) const;

  bool StandApart(const std::vector<Tic>& tics, TicRoom room) const;

 private:
  bool logarithmic_;
  double low_ = 0.0;
  double high_ = 1.0;
  double from_ = 0.0;
  double to_ = 1.0;

  double Place(double value) const;
  double Value(double place) const;
};

}  // namespace errmap::report
