#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/figures/figures.h"
#include "cli/report/report_view.h"

namespace errmap::report {

/// Held-out rows of one model under one hold-out, if they have a prediction;
/// errors are in the shown unit.
struct HeldOutRows {
  std::vector<double> row;
  std::vector<double> target;
  std::vector<double> predicted;
  std::vector<double> residual;
  std::vector<double> group;                // index into labels; empty if none
  std::vector<std::vector<double>> inputs;  // (inputs x rows)
  std::vector<std::string> labels;
  std::vector<double> session;  // index into session_labels
  std::vector<std::string> session_labels;
  std::vector<double> time;   // s; empty if unknown
  std::vector<bool> outside;  // the recommended map's range
  bool thinned = false;
  std::string missing;  // the reason if there are none
};

/// Returns the rows that the results keep for figures; `missing` says why if
/// there are none.
HeldOutRows HeldOutRowsOf(const ReportView& view,
                          const std::string& model,
                          const std::string& holdout);

// Okabe and Ito's colours (2008), distinct in every kind of colour vision.
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermillion = "#D55E00";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kBlack = "#000000";
inline constexpr const char* kGrey = "#666666";
/// Colours of lines on white, in this order.
inline constexpr std::array kLineColours = {
    kBlue, kVermillion, kGreen, kPurple, kOrange, kBlack};

/// True if error bars and lines from low to high need a logarithmic axis.
bool SpansDecades(double low, double high);

/// Data shared by the figures of one model's residuals.
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
/// Formats an error in the shown unit, "0.123 µm", with the same number of
/// decimals for all.
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

/// The axis of errors from `low` to `high`, in the unit shown. It starts at 0,
/// or is logarithmic if they differ by decades.
Axis HeldOutErrorAxis(const ReportView& view, double low, double high);

/// Labels the rows; `what` is their kind.
void NameRows(const std::vector<std::string>& names,
              const std::string& what,
              Plot* plot);

/// A dashed line across this many rows.
Series AcrossRows(const std::string& label, double at, std::size_t rows);

Series Points(std::vector<double> x, std::vector<double> y);

/// Draws y = 0 from the lowest to the highest x.
Series ZeroLine(const std::vector<double>& x);

// The figures of a component, for figures.cc; first those of the residuals that
// the report of 1995 has.

/// Histogram with the normal curve of the same mean and sd (Figure 11).
Figure HistogramFigure(const ResidualContext& context);

/// Normal probability plot (Figure 7).
Figure NormalPlotFigure(const ResidualContext& context);

/// Error of every model under each hold-out: the main figure.
Figure GapFigure(const ReportView& view, const std::string& prefix);

/// sqrt(2 E) against iteration for every net (the report's Figures 10-24), a
/// few nets in each figure; empty if no model iterates.
std::vector<Figure> TrainingFigures(const ReportView& view,
                                    const std::string& prefix);

/// The recommended map's effect on the machine's error, on held-out rows. Shows
/// the error over position before and after, the remaining error over the time
/// of day, and the error by day or cycle. This one says how the worst day
/// differs. Omits figures that the data do not allow.
std::vector<Figure> CompensationFigures(const ReportView& view,
                                        const std::string& prefix);

/// The measurements in their order: temperatures and the error, session after
/// session. Omits figures that the data do not allow.
std::vector<Figure> MeasuredFigures(const ReportView& view,
                                    const std::string& prefix);

/// The figures of a model's held-out residuals: predicted against measured;
/// residuals against position, group and the most correlated inputs; map; the
/// report's Figures 7 and 11. `prefix` begins the names of their files.
std::vector<Figure> ResidualFigures(const ReportView& view,
                                    const std::string& model,
                                    const std::string& holdout,
                                    const std::string& prefix,
                                    bool brief);

/// Held-out error of the recommended map without each of its sensors, and
/// without groups of similar sensors; none if the record lacks it.
std::vector<Figure> ImportanceFigures(const ReportView& view,
                                      const std::string& prefix);

}  // namespace errmap::report
