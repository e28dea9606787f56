#include "models/export/measured_cost.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "data/files/atomic_file.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"

namespace errmap::models {
namespace {

namespace fs = std::filesystem;

// A folder that vanishes with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / kPattern).string()) {
    if (mkdtemp(path_.data()) == nullptr) {
      throw std::system_error(
          errno, std::generic_category(), "cannot make the folder " + path_);
    }
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  fs::path operator/(const std::string& name) const {
    return fs::path(path_) / name;
  }

 private:
  static constexpr const char* kPattern = "errmap_cost_XXXXXX";
  std::string path_;
};

// Returns the stdout of a shell line run in `folder`; nothing if it fails.
std::optional<std::string> OutputOf(const TemporaryFolder& folder,
                                    const std::string& line) {
  std::string quoted;
  for (const char c : (folder / "").string()) {
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  }
  const std::string command =
      fmt::format("(cd '{}' && {}) 2>/dev/null </dev/null", quoted, line);
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) text += buffer;
  if (pclose(pipe) != 0) return std::nullopt;
  return text;
}

// The steps are those of the self-test, in a file of their own so that no
// compiler sees through the call.
constexpr const char* kTimer = R"(#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
{3}

enum {{ ROWS = {1}, BATCH = 500, BATCHES = 301, SINGLES = 100000 }};
static const double readings[ROWS][{0}_INPUTS + 1] = {{
{2}}};
static {0}_real rows[ROWS][{0}_INPUTS + 1];
static {0}_real sum;
static {0}_state state;

static double now(void) {{
  struct timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}}

static void step(int row) {{
  {0}_real error = 0;
  (void){0}_step(&state, 1.0, rows[row], &error);
  sum += error;
}}

static int compare(const void *a, const void *b) {{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}}

int main(void) {{
  static double batches[BATCHES], singles[SINGLES];
  double clock = 1e9;
  int row, i, k;
  for (row = 0; row < ROWS; ++row) {{
    for (i = 0; i < {0}_INPUTS; ++i) rows[row][i] = ({0}_real)readings[row][i];
  }}
  {0}_init(&state);
  for (k = 0; k < BATCHES; ++k) {{
    const double begin = now();
    for (i = 0; i < BATCH; ++i) step(i % ROWS);
    batches[k] = (now() - begin) / BATCH;
  }}
  qsort(batches, BATCHES, sizeof batches[0], compare);
  for (k = 0; k < SINGLES; ++k) {{
    const double begin = now();
    const double end = now();
    if (end - begin < clock) clock = end - begin;
  }}
  for (k = 0; k < SINGLES; ++k) {{
    const double begin = now();
    step(k % ROWS);
    singles[k] = now() - begin - clock;
  }}
  qsort(singles, SINGLES, sizeof singles[0], compare);
  printf("%.17g %.17g %.17g\n", batches[BATCHES / 2],
         singles[SINGLES - SINGLES / 1000 - 1], singles[SINGLES - 1]);
  return sum != sum;
}}
)";

std::string TimerText(const MapExport& map) {
  // Of what sensors move between rows, so much in a step: none jumps.
  constexpr double kShare = 0.01;
  const VectorXd mean = MeanReadings(map.program);
  std::string rows;
  // Within the trained range, where a controller is.
  std::size_t count = 0;
  for (const SelfTestRow& row : map.rows) {
    if ((row.status & (kMapOutside | kMapNotTaken)) != 0) continue;
    std::string numbers;
    for (std::size_t i = 0; i < map.program.readings.size(); ++i) {
      const auto at = static_cast<Index>(i);
      const double share = map.program.readings[i].is_position ? 1.0 : kShare;
      numbers +=
          RealText(mean[at] + share * (row.readings[at] - mean[at])) + ", ";
    }
    rows += "  {" + numbers + "0.0},\n";
    ++count;
  }
  const std::string& name = map.name;
  return fmt::format(kTimer, name, count, rows, "#include \"" + name + ".h\"");
}

// Sizes of the sections of an object file whose name begins with `prefix`, as
// `size -A` lists them.
std::int64_t SectionBytes(const std::string& listing,
                          const std::string& prefix) {
  std::int64_t bytes = 0;
  std::size_t at = 0;
  while (at < listing.size()) {
    const std::size_t end = listing.find('\n', at);
    const std::string line = listing.substr(at, end - at);
    char section[128];
    long long size = 0;
    if (std::sscanf(line.c_str(), "%127s %lld", section, &size) == 2 &&
        std::string(section).starts_with(prefix)) {
      bytes += size;
    }
    if (end == std::string::npos) break;
    at = end + 1;
  }
  return bytes;
}

}  // namespace

std::optional<MeasuredCost> MeasureCost(const MapExport& map,
                                        std::string* why) {
  const TemporaryFolder folder;
  for (const ExportedFile& file :
       CCode(map.program, map.name, map.precision, map.rows, map.tolerance())) {
    data::WriteFileAtomically((folder / file.name).string(), file.content);
  }
  data::WriteFileAtomically((folder / "timer_main.c").string(), TimerText(map));
  if (!OutputOf(folder,
                fmt::format("{0} -c {1}.c && {0} timer_main.c {1}.o -o "
                            "timer_main -lm",
                            kCostCompiler,
                            map.name))) {
    *why = fmt::format("nothing measured: `{}` does not compile it here",
                       kCostCompiler);
    return std::nullopt;
  }
  const auto times = OutputOf(folder, "./timer_main");
  MeasuredCost cost;
  if (!times || std::sscanf(times->c_str(),
                            "%lf %lf %lf",
                            &cost.median_ns,
                            &cost.high_ns,
                            &cost.worst_ns) != 3) {
    *why = "nothing measured: the compiled map does not run here";
    return std::nullopt;
  }
  const std::string listing =
      OutputOf(folder, fmt::format("size -A -d {}.o", map.name)).value_or("");
  cost.code_bytes = SectionBytes(listing, ".text");
  cost.constant_bytes = SectionBytes(listing, ".rodata");
  return cost;
}

}  // namespace errmap::models
