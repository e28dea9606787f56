#include <array>

#include <fmt/format.h>

#include "cli/report/documents/report_html.h"

namespace errmap::report {
namespace {

// For first-time readers; the page must explain itself.
struct Explained {
  const char* id;
  const char* word;
  const char* meaning;
};

constexpr std::array kExplained = {
    Explained{"error",
              "error",
              "Where the tool is minus where it should be. The control applies "
              "minus the predicted error."},
    Explained{
        "rmse",
        "RMSE",
        "The typical size of the remaining errors: the root mean square of "
        "measured minus predicted."},
    Explained{
        "unseen",
        "unseen",
        "Held out as a whole: a day, a cycle or rows that the fit and all "
        "its choices never saw."},
    Explained{"session",
              "session, cycle",
              "A session is an uninterrupted run, such as a day. A cycle is "
              "one run through all positions."},
    Explained{"holdout",
              "hold-out",
              "Rows kept back to judge a map. every:3 keeps back every third "
              "row, whose neighbours are known, so its error looks too small; "
              "groups:5 keeps back whole cycles, sessions:5 whole days."},
    Explained{"blend",
              "blend",
              "An average of several maps, weighted by how well each does on "
              "rows held out of the training data."},
    Explained{"baseline",
              "baseline",
              "No map at all, a constant, a curve in position or a line in one "
              "temperature."}};

}  // namespace

std::string GlossaryLinks() {
  std::string html;
  for (const Explained& entry : kExplained) {
    html += fmt::format("{}<a href=\"#w-{}\">{}</a>",
                        html.empty() ? "" : " · ",
                        entry.id,
                        entry.word);
  }
  return "<p class=\"soft small\">What the words mean: " + html + "</p>\n";
}

std::string Glossary() {
  std::string html = "<h2 id=\"words\">The words</h2>\n<dl class=\"next\">";
  for (const Explained& entry : kExplained) {
    html += fmt::format("<dt id=\"w-{}\">{}</dt><dd>{}</dd>",
                        entry.id,
                        entry.word,
                        entry.meaning);
  }
  return html + "</dl>\n";
}

}  // namespace errmap::report
