#include "cli/report/gnuplot.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <sys/wait.h>

#include "data/text.h"

namespace errmap::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kInstallHint =
    "gnuplot is not installed; to have the figures: sudo apt-get install "
    "gnuplot-nox, then errmap report DIR";

// A scratch folder that vanishes with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "errmap-figures-XXXXXX")
            .string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), name);
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string operator/(const std::string& name) const {
    return (path_ / name).string();
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

class SpawnActions {
 public:
  SpawnActions() { posix_spawn_file_actions_init(&actions_); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

std::string FileText(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream),
          std::istreambuf_iterator<char>()};
}

void WriteText(const std::string& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) {
    throw std::system_error(errno, std::generic_category(), path);
  }
}

// gnuplot's first line that is a message: its script's name and line in it are
// nobody's business.
std::string FirstComplaint(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("line ");
    if (line.starts_with("\"") && at != std::string::npos) {
      const std::size_t colon = line.find(": ", at);
      if (colon != std::string::npos) {
        return data::Printable(line.substr(colon + 2), 200);
      }
    }
  }
  return "";
}

struct Ended {
  int status = 0;
  bool late = false;
};

Ended WaitUntil(pid_t process, Clock::time_point deadline) {
  constexpr auto kPoll = std::chrono::milliseconds(2);
  Ended ended;
  while (waitpid(process, &ended.status, WNOHANG) == 0) {
    if (Clock::now() >= deadline) {
      kill(process, SIGKILL);
      waitpid(process, &ended.status, 0);
      ended.late = true;
      break;
    }
    std::this_thread::sleep_for(kPoll);
  }
  return ended;
}

// Runs "gnuplot -d SCRIPT"; "" if it did what it was told, else why not.
// Throws std::runtime_error where there is no gnuplot.
std::string RunGnuplot(const ScratchFolder& scratch,
                       const std::string& script,
                       Clock::time_point deadline) {
  WriteText(scratch / "script", script);
  const std::string input = scratch / "script";
  const std::string log = scratch / "log";
  SpawnActions actions;
  posix_spawn_file_actions_addopen(actions.get(), 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), 1, "/dev/null", O_WRONLY, 0);
  constexpr mode_t kPrivate = 0600;
  posix_spawn_file_actions_addopen(
      actions.get(), 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, kPrivate);
  // Neither the user's settings nor his language change a figure.
  const char* path = std::getenv("PATH");
  std::string words[] = {
      "gnuplot",
      "-d",
      input,
      "LC_ALL=C.UTF-8",
      "HOME=" + scratch.path(),
      std::string("PATH=") + (path != nullptr ? path : "/usr/bin:/bin")};
  char* const argv[] = {
      words[0].data(), words[1].data(), words[2].data(), nullptr};
  char* const environment[] = {
      words[3].data(), words[4].data(), words[5].data(), nullptr};
  pid_t process = -1;
  const int error = posix_spawnp(
      &process, argv[0], actions.get(), nullptr, argv, environment);
  if (error != 0) {
    throw std::runtime_error(error == ENOENT || error == EACCES
                                 ? kInstallHint
                                 : "gnuplot cannot be started: " +
                                       std::generic_category().message(error));
  }
  const Ended ended = WaitUntil(process, deadline);
  if (ended.late) return "gnuplot took too long and was stopped";
  const std::string complaint = FirstComplaint(FileText(log));
  if (WIFSIGNALED(ended.status)) {
    return fmt::format("gnuplot crashed (signal {})", WTERMSIG(ended.status));
  }
  constexpr int kNotFound = 127;  // of an old posix_spawnp
  const int status = WEXITSTATUS(ended.status);
  if (status == kNotFound) throw std::runtime_error(kInstallHint);
  if (status == 0 && complaint.empty()) return "";
  return complaint.empty()
             ? fmt::format("gnuplot failed with status {}", status)
             : "gnuplot: " + complaint;
}

std::string Range(const Axis& axis) {
  const auto end = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.9g}", value) : "*";
  };
  return fmt::format("[{}:{}]", end(axis.low), end(axis.high));
}

std::string AxisCommands(char name, const Axis& axis) {
  std::string text = fmt::format("set {}label {}\nset {}range {}\n",
                                 name,
                                 GnuplotString(axis.label),
                                 name,
                                 Range(axis));
  if (axis.logarithmic) text += fmt::format("set logscale {}\n", name);
  if (!axis.tics.empty()) {
    std::string tics;
    for (const auto& [label, at] : axis.tics) {
      tics += fmt::format(
          "{}{} {:.9g}", tics.empty() ? "" : ", ", GnuplotTicString(label), at);
    }
    text += fmt::format("set {}tics {}({})\n",
                        name,
                        axis.slanted_tics ? "rotate by 45 right " : "",
                        tics);
  }
  return text;
}

bool IsColour(std::string_view colour) {
  return colour.size() == 7 && colour.front() == '#' &&
         colour.find_first_not_of("0123456789abcdefABCDEF", 1) ==
             std::string_view::npos;
}

int PointType(Shape shape) {
  switch (shape) {
    case Shape::kDot:
      return 7;
    case Shape::kCircle:
      return 6;
    case Shape::kSquare:
      return 5;
    case Shape::kDiamond:
      return 13;
  }
  return 7;
}

std::string Style(const Series& series) {
  const std::string colour = fmt::format(
      "lc rgb \"{}\"", IsColour(series.colour) ? series.colour : "#000000");
  const std::string line = fmt::format(
      "lw {:.3g} dt {}", series.size, series.dashed ? "(6,4)" : "1");
  switch (series.mark) {
    case Mark::kPoints:
      return fmt::format("with points pt {} ps {:.3g} {}",
                         PointType(series.shape),
                         0.4 * series.size,
                         colour);
    case Mark::kLine:
      return fmt::format("with lines {} {}", line, colour);
    case Mark::kSteps:
      return fmt::format("with steps {} {}", line, colour);
    case Mark::kBars:
      return fmt::format("with boxes fill solid 0.45 border {}", colour);
    case Mark::kInterval:
    case Mark::kSpan:
      return fmt::format("with vectors nohead {} {}", line, colour);
    case Mark::kCells:
      return "with boxxyerror fill solid 1 noborder lc palette";
  }
  return "";
}

std::string Using(Mark mark) {
  switch (mark) {
    case Mark::kBars:
      return "1:2:3";
    case Mark::kInterval:
      return "1:3:(0):($4-$3)";
    case Mark::kSpan:
      return "3:2:($4-$3):(0)";
    case Mark::kCells:
      return "1:2:3:4:5";
    default:
      return "1:2";
  }
}

std::size_t NumColumns(Mark mark) {
  switch (mark) {
    case Mark::kBars:
      return 3;
    case Mark::kInterval:
    case Mark::kSpan:
      return 4;
    case Mark::kCells:
      return 5;
    default:
      return 2;
  }
}

// The data block of a series: numbers only.
std::string DataBlock(const Series& series, std::size_t index) {
  const std::size_t columns = NumColumns(series.mark);
  if (series.columns.size() != columns) {
    throw std::invalid_argument("Plot: a series has not the columns it needs");
  }
  const std::size_t rows = series.columns.front().size();
  for (const std::vector<double>& column : series.columns) {
    if (column.size() != rows) {
      throw std::invalid_argument("Plot: columns of different lengths");
    }
  }
  const bool is_line =
      series.mark == Mark::kLine || series.mark == Mark::kSteps;
  std::string text = fmt::format("$data{} << END\n", index);
  bool gap = true;
  for (std::size_t row = 0; row < rows; ++row) {
    const bool finite = std::all_of(
        series.columns.begin(), series.columns.end(), [&](const auto& column) {
          return std::isfinite(column[row]);
        });
    if (!finite) {
      if (is_line && !gap) text += "\n";
      gap = true;
      continue;
    }
    gap = false;
    for (std::size_t column = 0; column < columns; ++column) {
      text += fmt::format(
          "{}{:.6g}", column == 0 ? "" : " ", series.columns[column][row]);
    }
    text += "\n";
  }
  return text + "END\n";
}

bool HasPoints(const Series& series) {
  if (series.columns.empty()) return false;
  for (std::size_t row = 0; row < series.columns.front().size(); ++row) {
    if (std::all_of(series.columns.begin(),
                    series.columns.end(),
                    [&](const auto& column) {
                      return row < column.size() && std::isfinite(column[row]);
                    })) {
      return true;
    }
  }
  return false;
}

std::string Terminal(const Plot& plot, ImageFormat format) {
  constexpr double kPointsPerInch = 72.0;
  switch (format) {
    case ImageFormat::kSvg:
      return fmt::format(
          "set terminal svg noenhanced size {},{} dynamic font "
          "\"sans-serif,12\" butt\n",
          plot.width,
          plot.height);
    case ImageFormat::kPdf:
      return fmt::format(
          "set terminal pdfcairo noenhanced color size {:.3f}in,{:.3f}in "
          "font \"sans-serif,11\" fontscale 0.9\n",
          plot.width / kPointsPerInch,
          plot.height / kPointsPerInch);
    case ImageFormat::kPng:
      return fmt::format(
          "set terminal pngcairo noenhanced size {},{} font "
          "\"sans-serif,11\" fontscale 2.4 linewidth 2.4 pointscale 2.4\n",
          3 * plot.width,
          3 * plot.height);
  }
  return "";
}

// Blue, white, vermillion: told apart in every kind of colour vision and, by
// depth, not by sign, in grey print.
std::string Palette(const Plot& plot) {
  if (!std::isfinite(plot.colour_limit)) return "";
  constexpr double kScaleWidth = 105.0;  // pixels
  return fmt::format(
      "set palette maxcolors 21 defined (0 \"#004B7A\", 2 \"#56B4E9\", "
      "5 \"#F7F7F7\", 8 \"#E69F00\", 10 \"#8C2D04\")\n"
      "set cbrange [{:.6g}:{:.6g}]\nset cblabel {} offset 1.5,0\n"
      "set rmargin at screen {:.3f}\n",
      -plot.colour_limit,
      plot.colour_limit,
      GnuplotString(plot.colour_label),
      1.0 - kScaleWidth / plot.width);
}

std::string Commands(const Plot& plot,
                     ImageFormat format,
                     std::string_view file) {
  std::string text = "reset\nset encoding utf8\nset minussign\n";
  text += Terminal(plot, format);
  text += fmt::format("set output {}\n", GnuplotString(file));
  text +=
      "set border 3 lc rgb \"#555555\"\nset tics nomirror\n"
      "set grid lc rgb \"#DDDDDD\" dt 1 lw 0.5\nset style fill solid 1 "
      "noborder\n";
  const bool labelled =
      std::any_of(plot.series.begin(), plot.series.end(), [](const auto& s) {
        return !s.label.empty();
      });
  if (!labelled) {
    text += "unset key\n";
  } else if (plot.legend_below) {
    text += "set key below center Left reverse samplen 1.5 spacing 1.1\n";
  } else {
    text += "set key above left Left reverse samplen 1.5 spacing 1.1\n";
  }
  text += AxisCommands('x', plot.x) + AxisCommands('y', plot.y);
  text += Palette(plot);
  std::string data;
  std::string plots;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!HasPoints(series)) continue;
    data += DataBlock(series, i);
    plots += fmt::format("{}$data{} using {} {} {}",
                         plots.empty() ? "plot " : ", \\\n     ",
                         i,
                         Using(series.mark),
                         Style(series),
                         series.label.empty()
                             ? "notitle"
                             : "title " + GnuplotString(series.label));
  }
  return text + data + plots + "\nunset output\n";
}

}  // namespace

std::string_view ToString(ImageFormat format) {
  switch (format) {
    case ImageFormat::kSvg:
      return "svg";
    case ImageFormat::kPdf:
      return "pdf";
    case ImageFormat::kPng:
      return "png";
  }
  return "";
}

std::string GnuplotString(std::string_view text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
      " _-+*/=:,.()^<>|!?[]&%";
  std::string quoted = "\"";
  bool after_escape = false;
  for (const char c : data::AsUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    constexpr unsigned char kFirstBeyondAscii = 0x80;
    constexpr unsigned char kDelete = 0x7f;
    const bool plain =
        byte >= kFirstBeyondAscii || kPlain.find(c) != std::string_view::npos;
    // gnuplot takes a digit behind an octal escape for a part of it.
    const bool joins = after_escape && c >= '0' && c <= '9';
    after_escape = false;
    if (byte < ' ' || byte == kDelete) {
      quoted += ' ';
    } else if (plain && !joins) {
      quoted += c;
    } else {
      quoted += fmt::format("\\{:03o}", byte);
      after_escape = true;
    }
  }
  return quoted + "\"";
}

std::string GnuplotTicString(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled += c == '%' ? "%%" : std::string(1, c);
  return GnuplotString(doubled);
}

std::string PlotScript(const Plot& plot,
                       ImageFormat format,
                       std::string_view file) {
  return fmt::format("# Drawn by: gnuplot {}.gp\n", plot.name) +
         Commands(plot, format, file);
}

Drawings DrawPlots(const std::vector<Plot>& plots,
                   ImageFormat format,
                   double seconds) {
  Drawings result;
  result.drawings.resize(plots.size());
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(seconds));
  try {
    const ScratchFolder scratch;
    const auto image = [&](std::size_t i) {
      return scratch / fmt::format("{}.{}", i, ToString(format));
    };
    std::size_t first = 0;
    while (first < plots.size()) {
      std::string script;
      for (std::size_t i = first; i < plots.size(); ++i) {
        script += Commands(plots[i], format, image(i));
        // A mark that this plot is done; the next may fail.
        script += fmt::format("set print {}\nprint 1\nset print\n",
                              GnuplotString(scratch / fmt::format("{}.ok", i)));
      }
      const std::string failure = RunGnuplot(scratch, script, deadline);
      std::size_t i = first;
      for (; i < plots.size(); ++i) {
        if (!std::filesystem::exists(scratch / fmt::format("{}.ok", i))) break;
        result.drawings[i].image = FileText(image(i));
        if (result.drawings[i].image.empty()) {
          result.drawings[i].failure = "gnuplot wrote nothing";
        }
      }
      if (i == plots.size()) break;
      result.drawings[i].failure =
          failure.empty() ? "gnuplot stopped without a word" : failure;
      first = i + 1;
      if (Clock::now() >= deadline) {
        for (; first < plots.size(); ++first) {
          result.drawings[first].failure = result.drawings[i].failure;
        }
      }
    }
  } catch (const std::exception& error) {
    result.failure = error.what();
    for (Drawing& drawing : result.drawings) {
      drawing = {.image = "", .failure = result.failure};
    }
  }
  return result;
}

}  // namespace errmap::cli
