#include "cli/report/text/answers/data_words.h"

#include <string_view>

#include <fmt/format.h>

#include "cli/report/number_text.h"

namespace errmap::report {
namespace {

// `group` and `session`: the columns that tell, "" if there is none.
std::string Units(long long groups,
                  std::string_view group,
                  long long sessions,
                  std::string_view session) {
  std::string text =
      group.empty() ? ", no groups"
                    : fmt::format(", {} ({})", Count(groups, "group"), group);
  if (sessions < 2) return text + ", one run";
  text += ", " + Count(sessions, "session");
  return session.empty() ? text : fmt::format("{} ({})", text, session);
}

std::string Target(const std::string& name, data::Alignment align) {
  return name + (align == data::Alignment::kFirst
                     ? " minus each session's first value"
                     : "");
}

}  // namespace

std::string UnitsWords(const models::DataRecord& data) {
  return Units(data.groups,
               data.group.value_or(""),
               data.sessions,
               data.session.value_or(""));
}

std::string UnitsWords(const data::Dataset& dataset) {
  const data::SessionLog* const log = dataset.log().get();
  return Units(static_cast<long long>(dataset.groups().labels.size()),
               dataset.groups().column,
               dataset.num_sessions(),
               log == nullptr ? "" : log->sessions.column);
}

std::string TargetWords(const models::DataRecord& data) {
  return Target(data.target, data.align);
}

std::string TargetWords(const data::Dataset& dataset) {
  return Target(dataset.target().name, dataset.align());
}

std::string DoubtText(const models::StudyRecord& record) {
  if (!record.doubt) return "";
  return *record.doubt == models::Doubt::kChanged
             ? "results.json was changed after errmap wrote it: its content "
               "does not match its hash, so these figures may be wrong. Run "
               "errmap compare again."
             : "results.json has no hash of its content, since an older errmap "
               "wrote it: it may have been changed.";
}

}  // namespace errmap::report
