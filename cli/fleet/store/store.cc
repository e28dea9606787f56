#include "cli/fleet/store/store.h"

#include <cerrno>
#include <chrono>
#include <cmath>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <sys/file.h>

#include "data/files/link.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::fleet {
namespace {

namespace fs = std::filesystem;

// "errm": tells a store from any other SQLite file.
constexpr std::int64_t kApplication = 0x6572726d;

// What the store says of itself; throws where it is not ours to touch.
std::int64_t VersionOf(Database* database, const std::string& path) {
  const std::string shown = data::PrintablePath(path);
  if (database->WholeOf("PRAGMA application_id") != kApplication) {
    throw data::InputError(shown + " is not a store of errmap");
  }
  const std::int64_t version = database->WholeOf("PRAGMA user_version");
  if (version > kStoreVersion) {
    throw data::InputError(
        fmt::format("{} has schema {}, but this errmap reads schemas up to {}; "
                    "use the newer errmap that wrote it",
                    shown,
                    version,
                    kStoreVersion));
  }
  return version;
}

void Migrate(Database* database, std::int64_t from) {
  for (std::int64_t version = from; version < kStoreVersion; ++version) {
    database->Execute(kStoreMigrations[version]);
  }
  database->Execute(fmt::format(
      "PRAGMA application_id = {}; PRAGMA user_version = {}; PRAGMA "
      "foreign_keys = ON",
      kApplication,
      kStoreVersion));
}

void Flush(const std::string& path, int flags) {
  data::FileDescriptor file(open(path.c_str(), flags | O_CLOEXEC));
  if (file.is_open() && fsync(file.get()) == 0 && file.Close() == 0) return;
  throw std::system_error(errno, std::generic_category(), "flush");
}

// The copy that is being changed; nothing is left of one that was given up.
class Copy {
 public:
  explicit Copy(std::string path) : path_(std::move(path)) { Remove(); }
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
  ~Copy() { Remove(); }

  const std::string& path() const { return path_; }

  void TakePlaceOf(const std::string& store) const {
    Flush(path_, O_RDWR);
    fs::rename(path_, store);
    const fs::path folder = fs::path(store).parent_path();
    try {
      Flush(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
    } catch (const std::system_error&) {
      // It is in its place; some file systems cannot flush a folder.
    }
  }

 private:
  void Remove() const {
    std::error_code ignored;
    fs::remove(path_, ignored);
    fs::remove(path_ + "-journal", ignored);
  }

  std::string path_;
};

double WithinOf(const SummaryRecommendationRecord& found, double coverage) {
  for (const models::PromiseLevelRecord& level : found.promise) {
    if (std::abs(level.coverage - coverage) < 1e-9) return level.half_width;
  }
  return models::kNotKnown;
}

class SummaryWriter {
 public:
  SummaryWriter(Database* store, const StorePaths& paths)
      : store_(*store),
        paths_(paths),
        component_(store->Prepare(
            "INSERT INTO components VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?) "
            "ON CONFLICT (name) DO UPDATE SET study = excluded.study, "
            "status = excluded.status, why = excluded.why, "
            "folder = excluded.folder, data = excluded.data, "
            "sha256 = excluded.sha256, rows = excluded.rows, "
            "sessions = excluded.sessions, target = excluded.target, "
            "unit = excluded.unit, shown_unit = excluded.shown_unit, "
            "shown_scale = excluded.shown_scale, goal = excluded.goal, "
            "fits_seconds = excluded.fits_seconds")) {}

  void Write(const std::string& study,
             const FleetComponentRecord& component,
             const ComponentSummary* summary) {
    const std::string& name = component.name;
    const ComponentSummary nothing;
    const ComponentSummary& found = summary == nullptr ? nothing : *summary;
    component_
        .With(name,
              study,
              summary == nullptr ? std::string_view("missing")
                                 : ToString(found.status),
              found.why,
              paths_.FolderOf(name),
              component.data,
              found.sha256,
              found.rows,
              found.sessions,
              found.target,
              found.unit,
              found.display.unit,
              found.display.scale,
              found.goal,
              found.fits_seconds)
        .Run();
    for (const auto& [field, value] : found.fields) {
      Insert("INTO fields", name, field, value);
    }
    for (const SummaryHoldoutRecord& holdout : found.holdouts) {
      Insert("INTO holdouts",
             name,
             holdout.name,
             holdout.folds,
             holdout.unit_of_analysis,
             holdout.units);
    }
    for (const SummaryModelRecord& model : found.models) {
      WriteModel(name, model);
    }
    for (const SummaryVerdictRecord& verdict : found.verdicts) {
      Insert("INTO verdicts",
             name,
             verdict.holdout,
             ToString(verdict.choice),
             verdict.model,
             verdict.established,
             ToString(verdict.confidence));
    }
    if (found.recommendation) WriteRecommendation(name, *found.recommendation);
    if (found.map) {
      Insert("INTO maps", name, found.map->sha256, found.map->bytes);
    }
  }

 private:
  // A value for each column; `table` may begin with what to do in a conflict.
  template <typename... T>
  void Insert(const std::string& table, const T&... values) {
    auto statement = inserts_.find(table);
    if (statement == inserts_.end()) {
      const std::vector<const char*> marks(sizeof...(values), "?");
      statement =
          inserts_
              .emplace(
                  table,
                  store_.Prepare(fmt::format(
                      "INSERT {} VALUES ({})", table, fmt::join(marks, ","))))
              .first;
    }
    statement->second.With(values...).Run();
  }

  void WriteModel(const std::string& name, const SummaryModelRecord& model) {
    Insert("INTO models",
           name,
           model.name,
           ToString(model.kind),
           ToString(model.choice),
           ToString(model.status),
           model.why,
           model.parameters,
           model.fit_seconds);
    for (const SummaryMetricsRecord& found : model.results) {
      Insert("INTO metrics",
             name,
             model.name,
             found.holdout,
             found.n,
             found.rmse,
             found.sd,
             found.mean,
             found.mae,
             found.range,
             found.train_rmse,
             found.ci95[0],
             found.ci95[1],
             found.tier,
             ToString(found.goal));
    }
  }

  void WriteRecommendation(const std::string& name,
                           const SummaryRecommendationRecord& found) {
    Insert("INTO recommendations",
           name,
           ToString(found.choice),
           found.model,
           found.holdout,
           found.rmse,
           found.ci95[0],
           found.ci95[1],
           found.uncompensated,
           found.constant,
           ToString(found.goal),
           found.established,
           found.longest_memory,
           found.zeroed,
           WithinOf(found, 0.9),
           WithinOf(found, 0.95),
           found.extrapolated_share,
           found.sentence);
    for (const std::string& sensor : found.sensors) {
      Insert("OR IGNORE INTO sensors", name, sensor);
    }
  }

  Database& store_;
  const StorePaths& paths_;
  Statement component_;
  std::map<std::string, Statement> inserts_;
};

}  // namespace

StoreLock::StoreLock(const StorePaths& paths) : file_(-1) {
  data::RemoveLink(paths.Lock());
  file_ = data::FileDescriptor(open(
      paths.Lock().c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666));
  if (!file_.is_open()) {
    throw std::system_error(
        errno,
        std::generic_category(),
        "cannot write " + data::PrintablePath(paths.Lock()));
  }
  constexpr auto kPause = std::chrono::milliseconds(50);
  constexpr int kMostPauses = 6000;  // five minutes
  for (int pause = 0; flock(file_.get(), LOCK_EX | LOCK_NB) != 0; ++pause) {
    // A file system without locks: then writers must not meet.
    if (errno != EWOULDBLOCK && errno != EINTR) return;
    if (pause == kMostPauses) {
      throw std::runtime_error(
          fmt::format("{} is being written by another errmap; try again later",
                      data::PrintablePath(paths.Database())));
    }
    std::this_thread::sleep_for(kPause);
  }
}

Database OpenStore(const StorePaths& paths) {
  const std::string path = paths.Database();
  std::error_code ignored;
  if (!fs::exists(path, ignored)) {
    throw data::InputError(
        fmt::format("{} is missing; errmap merge STORE makes it",
                    data::PrintablePath(path)));
  }
  // A named pipe would be waited for.
  if (!fs::is_regular_file(path, ignored)) {
    throw data::InputError(
        fmt::format("{}: is not a plain file; move it away, and errmap merge "
                    "STORE makes another",
                    data::PrintablePath(path)));
  }
  try {
    Database store(path, Database::Access::kRead);
    VersionOf(&store, path);
    return store;
  } catch (const SqliteError& error) {
    throw data::InputError(data::PrintablePath(path) + ": " + error.what());
  }
}

void ChangeStore(const StorePaths& paths,
                 const StoreLock& /*held*/,
                 const std::function<void(Database*)>& change) {
  const std::string path = paths.Database();
  std::error_code ignored;
  std::optional<Database> old;
  if (fs::exists(path, ignored)) old.emplace(OpenStore(paths));
  const Copy copy(path + ".new");
  try {
    {
      Database store(copy.path(), Database::Access::kPrivate);
      std::int64_t version = 0;
      if (old) {
        store.CopyFrom(&*old);
        store.RequireSound(path);
        version = VersionOf(&store, path);
      }
      store.Execute("BEGIN");
      Migrate(&store, version);
      change(&store);
      store.Execute("COMMIT");
    }
    copy.TakePlaceOf(path);
  } catch (const SqliteError& error) {
    throw std::runtime_error(fmt::format("cannot write {}: {}; it is unchanged",
                                         data::PrintablePath(path),
                                         error.what()));
  } catch (const std::system_error& error) {
    throw std::runtime_error(fmt::format("cannot write {}: {}; it is unchanged",
                                         data::PrintablePath(path),
                                         error.code().message()));
  }
}

Database OpenStore(const StorePaths& paths, const StoreLock& lock) {
  Database store = OpenStore(paths);
  if (VersionOf(&store, paths.Database()) == kStoreVersion) return store;
  ChangeStore(paths, lock, [](Database*) {});
  return OpenStore(paths);
}

void WriteSummaries(Database* store,
                    const StorePaths& paths,
                    const FleetRecord& fleet,
                    const std::vector<ComponentSummary>& summaries) {
  std::map<std::string_view, const ComponentSummary*> by_name;
  for (const ComponentSummary& summary : summaries) {
    by_name[summary.name] = &summary;
  }
  for (const char* table :
       {"fields", "models", "holdouts", "recommendations", "sensors", "maps"}) {
    store->Execute(std::string("DELETE FROM ") + table);
  }
  store
      ->Prepare(
          "INSERT INTO runs VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7) ON CONFLICT "
          "(study) DO UPDATE SET file = ?2, version = ?3, seed = ?4, "
          "command_line = ?5, components = ?6, missing = ?7")
      .With(fleet.sha256,
            fleet.file,
            fleet.version,
            static_cast<std::int64_t>(fleet.seed),
            fleet.command_line,
            std::ssize(fleet.components),
            static_cast<std::int64_t>(fleet.components.size() - by_name.size()))
      .Run();
  store->Prepare("UPDATE components SET study = ?, status = 'gone'")
      .With(fleet.sha256)
      .Run();
  store->Prepare("DELETE FROM runs WHERE study <> ?").With(fleet.sha256).Run();
  SummaryWriter writer(store, paths);
  for (const FleetComponentRecord& component : fleet.components) {
    const auto found = by_name.find(component.name);
    writer.Write(fleet.sha256,
                 component,
                 found == by_name.end() ? nullptr : found->second);
  }
  store->Execute(
      "DELETE FROM components WHERE status = 'gone' AND name NOT IN "
      "(SELECT component FROM deployments)");
}

}  // namespace errmap::fleet
