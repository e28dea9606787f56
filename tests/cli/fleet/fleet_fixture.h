#pragma once

// A small fleet: two machines, components that are good, and a broken one.

#include <map>
#include <sqlite3.h>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {

inline const std::vector<std::string> kFleetTables = {"runs",
                                                      "components",
                                                      "fields",
                                                      "holdouts",
                                                      "models",
                                                      "metrics",
                                                      "verdicts",
                                                      "recommendations",
                                                      "sensors",
                                                      "maps"};

class FleetTest : public CliTest {
 protected:
  static constexpr int kComponents = 9;  // the broken one among them

  void WriteComponent(const std::string& path, int seed, int days = 4) const {
    std::string text = "day,cycle,position_mm,t1_degC,t2_degC,error_mm\n";
    int state = seed;
    const auto drawn = [&] {
      state = (state * 1103 + 12345) % 65521;
      return state / 65521.0 - 0.5;
    };
    for (int day = 1; day <= days; ++day) {
      for (int cycle = 1; cycle <= 3; ++cycle) {
        const double t1 = 20.0 + cycle + 0.3 * day + 0.02 * drawn();
        const double t2 = 20.0 + 0.5 * cycle + 0.2 * day + 0.02 * drawn();
        for (int i = 0; i < 6; ++i) {
          const double x = 50.0 * i;
          const double error =
              1e-5 * x + 0.002 * (t1 - 20.0) + 0.0005 * drawn();
          text += std::to_string(day) + "," + std::to_string(3 * day + cycle) +
                  "," + std::to_string(x) + "," + std::to_string(t1) + "," +
                  std::to_string(t2) + "," + std::to_string(error) + "\n";
        }
      }
    }
    std::filesystem::create_directories((scratch_ / path).parent_path());
    Write(path, text);
  }

  void WriteFleet() const {
    int seed = 1;
    for (const char* machine : {"m01", "m02"}) {
      for (const char* file : {"x_down", "x_up", "z_down", "z_up"}) {
        WriteComponent(std::string("data/") + machine + "/" + file + ".csv",
                       ++seed);
      }
    }
    Write("data/m02/yaw_up.csv", "position_mm,error_mm\n1,\n");
    Write("fleet.toml",
          "models = [\"mean\", \"poly:position\", \"poly:full:degree=1\"]\n"
          "[[component]]\n"
          "name = \"{machine}/{component}\"\n"
          "data = \"data/{machine}/{component}_{direction}.csv\"\n");
  }

  Outcome Study(const std::string& store,
                std::vector<std::string> more = {}) const {
    std::vector<std::string> words{
        "compare", "--config", "fleet.toml", "--out", store};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  // Where no file can grow beyond so many bytes, as on a disk that is full.
  Outcome RunWithFilesUpTo(rlim_t bytes,
                           const std::vector<std::string>& words) const {
    rlimit old{};
    EXPECT_EQ(getrlimit(RLIMIT_FSIZE, &old), 0);
    rlimit limit = old;
    limit.rlim_cur = bytes;
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const Outcome outcome = Run(words);
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &old), 0);
    return outcome;
  }

  // Of schema 99: the user version stands in bytes 60 to 63, big-endian.
  void MakeSchemaNewer(const std::string& database) const {
    std::string content = Read(database);
    constexpr std::size_t kLastOfUserVersion = 63;
    content[kLastOfUserVersion] = 99;
    Write(database, content);
  }

  Json Rows(const std::string& store, const std::string& sql) const {
    return Ask(store, sql)["rows"];
  }

  // What the store answers: names of columns, and rows.
  Json Ask(const std::string& store, const std::string& sql) const {
    Json answer = {{"columns", Json::array()}, {"rows", Json::array()}};
    sqlite3* database = nullptr;
    sqlite3_stmt* query = nullptr;
    const std::string path = (scratch_ / store / "errmap.sqlite").string();
    EXPECT_EQ(
        sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr),
        SQLITE_OK);
    EXPECT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &query, nullptr),
              SQLITE_OK)
        << sql << ": " << sqlite3_errmsg(database);
    const int columns = sqlite3_column_count(query);
    for (int i = 0; i < columns; ++i) {
      answer["columns"].push_back(sqlite3_column_name(query, i));
    }
    while (query != nullptr && sqlite3_step(query) == SQLITE_ROW) {
      Json row = Json::array();
      for (int i = 0; i < columns; ++i) row.push_back(ValueOf(query, i));
      answer["rows"].push_back(std::move(row));
    }
    sqlite3_finalize(query);
    sqlite3_close(database);
    return answer;
  }

  static Json ValueOf(sqlite3_stmt* query, int column) {
    switch (sqlite3_column_type(query, column)) {
      case SQLITE_NULL:
        return nullptr;
      case SQLITE_INTEGER:
        return sqlite3_column_int64(query, column);
      case SQLITE_FLOAT:
        return sqlite3_column_double(query, column);
      default:
        return reinterpret_cast<const char*>(
            sqlite3_column_text(query, column));
    }
  }

  // All that is in the tables, times apart.
  std::map<std::string, Json> Content(
      const std::string& store,
      const std::vector<std::string>& tables = kFleetTables) const {
    std::map<std::string, Json> content;
    for (const std::string& table : tables) {
      const Json found = Ask(store, "SELECT * FROM " + table);
      Json rows = Json::array();
      for (const Json& row : found["rows"]) {
        Json kept = Json::array();
        for (std::size_t i = 0; i < row.size(); ++i) {
          const std::string name = found["columns"][i];
          if (name.find("seconds") == name.npos) kept.push_back(row[i]);
        }
        rows.push_back(std::move(kept));
      }
      content[table] = std::move(rows);
    }
    return content;
  }

  // Every component's full results and map, times apart.
  std::map<std::string, Json> Results(const std::string& store) const {
    std::map<std::string, Json> results;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             scratch_ / store / "components")) {
      if (!entry.is_regular_file()) continue;
      const std::string path = entry.path().string();
      std::string text = Process::TextOf(path);
      if (path.ends_with(".gz")) text = Unpacked(path);
      Json document = Json::parse(text, nullptr, false);
      EXPECT_FALSE(document.is_discarded()) << path;
      DropTimes(&document);
      results[std::filesystem::relative(entry.path(), scratch_ / store)
                  .string()] = std::move(document);
    }
    return results;
  }

  std::string Unpacked(const std::string& path) const {
    const std::string command =
        "gzip -dc '" + path + "' > '" + (scratch_ / "unpacked").string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << path;
    return Read("unpacked");
  }
};

}  // namespace errmap
