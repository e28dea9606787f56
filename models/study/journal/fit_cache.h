#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "models/study/journal/fit_journal_file.h"
#include "models/study/journal/fit_label.h"

namespace errmap::models {

/// Where the last fits are kept: errmap in $XDG_CACHE_HOME or else in
/// $HOME/.cache; "" where neither is an absolute path.
std::string DefaultCacheFolder();

/// The journal of all studies of the data of `labels` by this program, which is
/// kept in `folder` by their content: FOLDER/HASH/journal.jsonl. Journals that
/// were used longest ago go, until those left have at most `most_bytes`; one
/// above a quarter of that begins anew. Null where `folder` is "", cannot be
/// written or another process has the journal open: then fits are made again,
/// and nobody need know.
std::unique_ptr<JournalFile> OpenKeptFits(
    const std::string& folder,
    const FitLabels& labels,
    std::int64_t most_bytes = std::int64_t{512} << 20U);

}  // namespace errmap::models
