#include "cli/report/figures/figures.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "cli/report/figures/svg.h"

namespace errmap::report {
namespace {

constexpr std::size_t kFewComponents = 6;

void Append(std::vector<Figure> more, std::vector<Figure>* figures) {
  for (Figure& figure : more) figures->push_back(std::move(figure));
}

void MarkEmpty(std::vector<Figure>* figures) {
  for (Figure& figure : *figures) {
    if (figure.missing.empty() && !HasPoints(figure.plot)) {
      figure.missing = "There is no finite value to draw.";
    }
  }
}

std::vector<Figure> FiguresOf(const ReportView& view,
                              const std::string& prefix,
                              FigureDetail detail) {
  const bool brief = detail == FigureDetail::kBrief;
  const bool whole = detail == FigureDetail::kFull;
  std::vector<Figure> figures{GapFigure(view, prefix)};
  Append(MeasuredFigures(view, prefix), &figures);
  Append(CompensationFigures(view, prefix), &figures);
  if (brief) {
    // The error before and after, and by unit.
    std::erase_if(figures, [&](const Figure& figure) {
      return figure.place == FigurePlace::kMeasured ||
             figure.plot.name == prefix + "clock";
    });
  } else {
    Append(ImportanceFigures(view, prefix), &figures);
  }
  if (!brief && !view.recommended.empty() && !view.decisive.empty()) {
    Append(ResidualFigures(
               view, view.recommended, view.decisive, prefix + "best-", !whole),
           &figures);
  }
  if (whole) Append(TrainingFigures(view, prefix), &figures);
  MarkEmpty(&figures);
  return figures;
}

}  // namespace

FigureSet MakeFigures(const models::StudyRecord& record) {
  FigureSet set;
  const auto& components = record.components;
  const FigureDetail detail = components.size() > kFewComponents
                                  ? FigureDetail::kBrief
                              : components.size() > 1 ? FigureDetail::kSome
                                                      : FigureDetail::kFull;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const ReportView view = ViewOf(components[i]);
    ComponentFigures figures{.detail = detail, .figures = {}};
    figures.figures = FiguresOf(view, fmt::format("c{}-", i + 1), detail);
    set.components.push_back(std::move(figures));
  }
  set.parts = PartsOf(record);
  for (RecordPart& part : set.parts) MarkEmpty(&part.figures);
  return set;
}

std::vector<RecordPart> PartsOf(const models::StudyRecord& record) {
  std::vector<RecordPart> parts;
  for (const auto& [key, json] : record.others) {
    for (const RecordPartMaker& maker : RecordPartMakers()) {
      if (maker.key != key) continue;
      RecordPart& part = parts.emplace_back(maker.make(json));
      for (std::vector<Table>* tables : {&part.screen, &part.tables}) {
        std::erase_if(*tables, [](const Table& t) { return t.rows.empty(); });
      }
    }
  }
  return parts;
}

std::string FigureSvg(const Figure& figure) {
  return Svg(figure.plot,
             figure.subject.empty() ? figure.title
                                    : figure.subject + ": " + figure.title,
             figure.description);
}

std::vector<ReportFile> FigureFiles(const FigureSet& figures) {
  std::vector<ReportFile> files;
  const auto add = [&](const std::vector<Figure>& more) {
    for (const Figure& figure : more) {
      if (!figure.missing.empty()) continue;
      files.push_back({figure.plot.name + ".svg", SvgFile(FigureSvg(figure))});
    }
  };
  for (const ComponentFigures& component : figures.components) {
    add(component.figures);
  }
  for (const RecordPart& part : figures.parts) add(part.figures);
  return files;
}

}  // namespace errmap::report
