#pragma once

#include <string>
#include <vector>

#include "cli/report/plot.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

/// Where in a component's part of the report a figure stands.
enum class FigurePlace {
  kAnswer,
  kMeasured,
  kCompensation,
  kSensors,
  kResiduals,
  kFits
};

/// A figure of the report.
struct Figure {
  FigurePlace place = FigurePlace::kResiduals;
  std::string subject;      // the model it is of, "" where it is of all
  std::string title;        // what is shown
  std::string note;         // how to read it, a sentence or two
  std::string description;  // what it shows, for those who do not see it
  /// Why there is nothing to draw; "" = there is.
  std::string missing;
  Plot plot;  // plot.name: "c1-gap", unique in the report
};

/// How much is drawn of one component.
enum class FigureDetail { kFull, kSome, kBrief };

/// The figures of one component.
struct ComponentFigures {
  FigureDetail detail = FigureDetail::kFull;
  std::vector<Figure> figures;
};

/// All figures of a report, by component.
struct FigureSet {
  std::vector<ComponentFigures> components;
  std::vector<Figure> machine;  // of all of them together

  /// Whether there are so many components that most is left out.
  bool IsBrief() const {
    return !components.empty() &&
           components.front().detail == FigureDetail::kBrief;
  }
};

/// Figures of a study: at most twenty of a component, fewer where components
/// are many.
FigureSet MakeFigures(const models::StudyRecord& record);

/// The figure as SVG.
std::string FigureSvg(const Figure& figure);

/// A file of a report: its name in the report's folder, and what it holds.
struct ReportFile {
  std::string name;
  std::string text;
};

/// Every figure as NAME.svg.
std::vector<ReportFile> FigureFiles(const FigureSet& figures);

}  // namespace errmap::report
