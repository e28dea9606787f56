#pragma once

#include <string>
#include <vector>

#include "cli/report/gnuplot.h"
#include "cli/report/report_view.h"

namespace errmap::cli {

/// Where in a component's part of the report a figure stands.
enum class FigurePlace { kAnswer, kResiduals, kEveryModel, kFits, kData };

/// A figure of the report.
struct Figure {
  FigurePlace place = FigurePlace::kResiduals;
  std::string subject;      // the model it is of, "" where it is of all
  std::string title;        // what is shown
  std::string note;         // how to read it, a sentence or two
  std::string description;  // what it shows, for those who do not see it
  /// Why there is nothing to draw; "" = there is.
  std::string missing;
  bool small = false;  // one of many of a kind
  Plot plot;           // plot.name: "c1-gap", unique in the report
  Drawing drawing;     // filled by DrawFigures
};

/// How much is drawn of one component.
enum class FigureDetail { kEverything, kFull, kBrief };

/// The figures of one component.
struct ComponentFigures {
  FigureDetail detail = FigureDetail::kFull;
  std::vector<Figure> figures;
};

/// All figures of a report, by component.
struct FigureSet {
  std::vector<ComponentFigures> components;
  std::string failure;  // why none could be drawn, "" otherwise
};

/// Figures of results.json, not drawn yet: everything of each component, or
/// (`everything` false) what keeps a report of many components usable.
FigureSet MakeFigures(const Json& results, bool everything = false);

/// Draws those that are not missing, as SVG for a page.
void DrawFigures(FigureSet* figures);

/// Writes every figure as DIR/NAME.FORMAT with DIR/NAME.gp, the gnuplot script
/// that draws it, data included. Returns what could not be drawn, one line
/// each. Throws std::system_error where the folder cannot be written.
std::vector<std::string> WriteFigures(const FigureSet& figures,
                                      ImageFormat format,
                                      const std::string& folder);

}  // namespace errmap::cli
