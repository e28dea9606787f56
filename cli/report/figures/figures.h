#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/report/plot.h"
#include "cli/report/table.h"
#include "models/learning/learning_record.h"
#include "models/record.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

/// The section of a component's report in which a figure appears.
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
  std::string subject;      // the model shown; "" for all
  std::string title;        // what is shown
  std::string note;         // how to read it, a sentence or two
  std::string description;  // what it shows, for blind readers
  /// Reason why there is no plot; "" if there is one.
  std::string missing;
  Plot plot;  // plot.name: "c1-gap", unique in the report
};

/// Selects how many figures each component gets.
enum class FigureDetail { kFull, kSome, kBrief };

/// The figures of one component.
struct ComponentFigures {
  FigureDetail detail = FigureDetail::kFull;
  std::vector<Figure> figures;
};

/// A part of the report that shows a slice's addition to the record, for all
/// components together.
struct RecordPart {
  std::string id;               // of its section of the page
  std::string title;            // of the same
  std::string link;             // to it, in the page's index
  std::string answer;           // above its tables: what it comes to
  std::vector<Table> screen;    // what a terminal shows
  std::vector<Table> tables;    // of the page and report.md
  std::vector<Figure> figures;  // below the first of these
};

/// Shows a slice's data under a key of models::StudyRecord::others.
struct RecordPartMaker {
  std::string_view key;
  /// Throws data::InputError if the text has other content.
  RecordPart (*make)(const std::string& json);
};
/// The parts of the slices that are built; written by CMake.
const std::vector<RecordPartMaker>& RecordPartMakers();
/// Returns the parts of a record that slices show, without empty tables.
std::vector<RecordPart> PartsOf(const models::StudyRecord& record);

/// All figures of a report, by component.
struct FigureSet {
  std::vector<ComponentFigures> components;
  std::vector<RecordPart> parts;

  /// True if most figures are left out, since there are many components.
  bool IsBrief() const {
    return !components.empty() &&
           components.front().detail == FigureDetail::kBrief;
  }
};

/// Makes the figures of a study: at most twenty for each component, fewer if
/// there are many components.
FigureSet MakeFigures(const models::StudyRecord& record);

/// Returns the figure as SVG.
std::string FigureSvg(const Figure& figure);

/// A file of a report: its name in the report's folder, and its content.
struct ReportFile {
  std::string name;
  std::string text;
};

/// Returns every figure with data as NAME.svg.
std::vector<ReportFile> FigureFiles(const FigureSet& figures);

/// Error on unseen units against the number of training units or of sensors, as
/// requested from `errmap learn`; none if the record has neither.
std::vector<Figure> LearningFigures(const models::LearningRecord& learnt,
                                    const std::string& prefix);

/// Adds the figures to the only component with the same data file and target.
void AddLearning(const models::StudyRecord& record,
                 const std::vector<models::LearningRecord>& learnt,
                 FigureSet* figures);

// Pictures in table rows, as SVG.

/// A dot between 0 and `without_map`, with the 95 % interval as a bar; "" if
/// `without_map` is unknown or less than `rmse`.
std::string IntervalPicture(double rmse,
                            const models::IntervalRecord& ci95,
                            double without_map);

/// A map's errors over successive units, as a line from 0 to the largest error,
/// which has a dot. If there are more units than points, each point is the
/// largest of its neighbours. `words` describes it for blind readers. "" for
/// fewer than two units.
std::string Sparkline(const std::vector<double>& errors,
                      const std::string& words);

}  // namespace errmap::report
