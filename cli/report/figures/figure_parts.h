#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/figures/held_out_rows.h"
#include "cli/report/report_view.h"

namespace errmap::report {

// Okabe and Ito's colours (2008), distinct in every kind of colour vision.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermillion = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kBlack = "#000000";
inline constexpr const char* kGrey = "#666666";
/// For lines on white, in this order.
inline constexpr std::array kLineColours = {
    kBlue, kVermillion, kGreen, kPurple, kOrange, kBlack};

/// True if error bars and lines from low to high need a logarithmic axis.
bool SpansDecades(double low, double high);

/// The data shared by the figures of one model's residuals.
struct ResidualContext {
  const ReportView& view;
  const HeldOutRows& rows;
  std::string model;
  std::string prefix;  // of their files' names
};

/// A figure without its plot; `missing` says if there are no rows.
Figure BeginFigure(const ResidualContext& context,
                   const std::string& kind,
                   const std::string& title);

/// Returns "residuals of 30 held-out rows from -1 to 1.2, mean 0.1 µm".
std::string SpreadWords(const ResidualContext& context);

/// Formats with three digits.
std::string Plain(double value);
/// Formats an error in the shown unit, "0.123 µm", with the digits of all
/// others.
std::string Amount(double error, const ReportView& view);

double MeanOf(const std::vector<double>& values);
double RmsOf(const std::vector<double>& values);

/// Index of the position among the inputs of the figures' rows; npos if none.
std::size_t PositionIndex(const ReportView& view);

/// The axis of an input: its name without the unit, in at most `most`
/// characters.
Axis InputAxis(const ReportView& view, std::size_t index, std::size_t most);

Axis ResidualAxis(const ReportView& view);

// A picture with a row for each name, the first on top, and marks along x:

/// The axis of errors from `low` to `high`, in the unit shown: from 0, or
/// logarithmic where they are apart by decades.
Axis HeldOutErrorAxis(const ReportView& view, double low, double high);

/// Names the rows; `what` they are.
void NameRows(const std::vector<std::string>& names,
              const std::string& what,
              Plot* plot);

/// A dashed line across so many rows.
Series AcrossRows(const std::string& label, double at, std::size_t rows);

Series Points(std::vector<double> x, std::vector<double> y);

/// Draws y = 0 from the lowest to the highest x.
Series ZeroLine(const std::vector<double>& x);

}  // namespace errmap::report
