#include "cli/report/figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "cli/report/comparison_figures.h"
#include "cli/report/html.h"
#include "cli/report/residual_figures.h"
#include "cli/report/svg.h"
#include "data/atomic_file.h"

namespace errmap::cli {
namespace {

constexpr double kPatienceSeconds = 120.0;
constexpr std::size_t kFewComponents = 6;
constexpr std::size_t kManyComponents = 30;

bool HasPoints(const Plot& plot) {
  for (const Series& series : plot.series) {
    if (series.columns.empty()) continue;
    for (std::size_t i = 0; i < series.columns.front().size(); ++i) {
      if (std::all_of(
              series.columns.begin(), series.columns.end(), [&](auto& column) {
                return i < column.size() && std::isfinite(column[i]);
              })) {
        return true;
      }
    }
  }
  return false;
}

void Append(std::vector<Figure> more, std::vector<Figure>* figures) {
  for (Figure& figure : more) figures->push_back(std::move(figure));
}

std::vector<Figure> FiguresOf(const ReportView& view,
                              const std::string& prefix,
                              FigureDetail detail) {
  const bool brief = detail == FigureDetail::kBrief;
  const bool everything = detail == FigureDetail::kEverything;
  constexpr std::size_t kMostInputs = 12;
  constexpr std::size_t kEveryInput = 1000;
  std::vector<Figure> figures{GapFigure(view, prefix)};
  if (!view.recommended.empty() && !view.decisive.empty()) {
    Append(ResidualFigures(view,
                           view.recommended,
                           view.decisive,
                           prefix + "best-",
                           brief,
                           everything ? kEveryInput : kMostInputs),
           &figures);
  }
  if (!brief && !view.rival.empty()) {
    Append(ResidualFigures(view,
                           view.rival,
                           view.decisive,
                           prefix + "rival-",
                           false,
                           everything ? kEveryInput : 0),
           &figures);
  }
  if (!brief) {
    constexpr std::size_t kMostModels = 24;
    for (std::size_t i = 0;
         i < std::min(view.models.size(), everything ? 1000 : kMostModels);
         ++i) {
      const std::string& name = view.models[i].name;
      if (!std::isfinite(TestRmse(view, name, view.decisive))) continue;
      figures.push_back(SmallResidualFigure(
          view, name, view.decisive, fmt::format("{}model-{}", prefix, i + 1)));
    }
    Append(TrainingFigures(view, prefix), &figures);
    Append(StartFigures(view, prefix), &figures);
    Append(LearningFigures(view, prefix), &figures);
    figures.push_back(CorrelationFigure(view, prefix));
  }
  for (Figure& figure : figures) {
    if (figure.missing.empty() && !HasPoints(figure.plot)) {
      figure.missing = "There is no finite value to draw.";
    }
  }
  return figures;
}

// Figures that there are, with their plots.
std::vector<Figure*> Drawable(FigureSet* set, std::vector<Plot>* plots) {
  std::vector<Figure*> drawable;
  for (ComponentFigures& component : set->components) {
    for (Figure& figure : component.figures) {
      if (!figure.missing.empty()) continue;
      drawable.push_back(&figure);
      plots->push_back(figure.plot);
    }
  }
  return drawable;
}

}  // namespace

FigureSet MakeFigures(const Json& results, bool everything) {
  FigureSet set;
  const Json& components = At(results, "components");
  FigureDetail detail = components.size() > kFewComponents
                            ? FigureDetail::kBrief
                            : FigureDetail::kFull;
  if (everything) detail = FigureDetail::kEverything;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const ReportView view = ViewOf(At(components, i));
    ComponentFigures figures{.detail = detail, .figures = {}};
    figures.figures = FiguresOf(view, fmt::format("c{}-", i + 1), detail);
    // A page of very many components has one picture for each.
    if (!everything && components.size() > kManyComponents) {
      figures.figures.resize(std::min<std::size_t>(1, figures.figures.size()));
    }
    set.components.push_back(std::move(figures));
  }
  return set;
}

void DrawFigures(FigureSet* figures) {
  std::vector<Plot> plots;
  const std::vector<Figure*> drawable = Drawable(figures, &plots);
  Drawings drawn = DrawPlots(plots, ImageFormat::kSvg, kPatienceSeconds);
  figures->failure = drawn.failure;
  for (std::size_t i = 0; i < drawable.size(); ++i) {
    Figure& figure = *drawable[i];
    figure.drawing.failure = drawn.drawings[i].failure;
    if (!figure.drawing.failure.empty()) continue;
    const std::string& id = figure.plot.name;
    figure.drawing.image = CompactSvg(
        drawn.drawings[i].image,
        fmt::format("role=\"img\" aria-labelledby=\"{0}-t {0}-d\"", id),
        fmt::format("<title id=\"{0}-t\">{1}</title>"
                    "<desc id=\"{0}-d\">{2}</desc>",
                    id,
                    HtmlText(figure.subject.empty()
                                 ? figure.title
                                 : figure.subject + ": " + figure.title),
                    HtmlText(figure.description)));
    if (figure.drawing.image.empty()) {
      figure.drawing.failure = "gnuplot wrote no SVG that can be read";
    }
  }
}

std::vector<std::string> WriteFigures(const FigureSet& figures,
                                      ImageFormat format,
                                      const std::string& folder) {
  FigureSet set = figures;
  std::vector<Plot> plots;
  const std::vector<Figure*> drawable = Drawable(&set, &plots);
  const Drawings drawn = DrawPlots(plots, format, kPatienceSeconds);
  const std::filesystem::path root(folder);
  std::vector<std::string> failures;
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const std::string image =
        fmt::format("{}.{}", plots[i].name, ToString(format));
    data::WriteFileAtomically((root / (plots[i].name + ".gp")).string(),
                              PlotScript(plots[i], format, image));
    if (drawn.drawings[i].failure.empty()) {
      data::WriteFileAtomically((root / image).string(),
                                drawn.drawings[i].image);
    } else if (drawn.failure.empty()) {
      failures.push_back(image + ": " + drawn.drawings[i].failure);
    }
  }
  if (!drawn.failure.empty()) {
    failures.push_back("the scripts are written, but nothing is drawn: " +
                       drawn.failure);
  }
  return failures;
}

}  // namespace errmap::cli
