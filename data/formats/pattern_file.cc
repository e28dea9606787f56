#include "data/formats/pattern_file.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "data/column_header.h"
#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/formats/fortran_format.h"
#include "data/formats/record_reader.h"
#include "data/input_error.h"
#include "data/measurements/dataset.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kFirstBlock = 3;
constexpr std::size_t kLaterBlock = 6;
// What makes a CSV file one of ours; the numbers follow.
constexpr const char* kCsvMark = "# patterns for errmap netcg: targets %zu, ";
constexpr const char* kCsvScale = "scale %lf";
constexpr const char* kIndexColumn = "index";

std::string TwoDigits(long long number) {
  const std::string text = std::to_string(number);
  return text.size() < 2 ? "0" + text : text;
}

std::string TargetName(std::size_t j, std::size_t count) {
  return count == 1 ? "error_mm" : "error" + std::to_string(j + 1) + "_mm";
}

struct Header {
  std::size_t patterns = 0;
  std::size_t inputs = 0;
  std::size_t outputs = 0;
  double scale = 1.0;
};

// `text` is the whole file.
Header ReadHeader(std::string_view text, RecordReader* reader) {
  const std::string what =
      "numbers of patterns, inputs and outputs and a scale factor";
  const std::vector<double> numbers = reader->Numbers(4, what);
  const auto count = [&](std::size_t i) {
    const long long value = reader->WholeNumber(numbers[i], what);
    if (value < 1) {
      reader->Refuse("expected " + what + ", found a number below 1");
    }
    return static_cast<std::size_t>(value);
  };
  // Targets get their names before the first of them is read.
  if (count(2) > text.size()) {
    reader->Refuse("expected " + what +
                   ", found more outputs than the file has characters");
  }
  return {count(0), count(1), count(2), numbers[3]};
}

// Values as they come, row by row; their number is known at the end only.
Eigen::MatrixXd ToMatrix(const std::vector<double>& values,
                         std::size_t columns) {
  using RowMajor =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto width = static_cast<Index>(columns);
  return Eigen::Map<const RowMajor>(
      values.data(), static_cast<Index>(values.size()) / width, width);
}

std::string Ordinal(std::size_t row, std::size_t count) {
  return std::to_string(row + 1) + " of " + std::to_string(count);
}

// "6 numbers in row 2 of 397".
std::string NumbersIn(std::size_t width, std::size_t row, std::size_t count) {
  return std::to_string(width) + (width == 1 ? " number" : " numbers") +
         " in row " + Ordinal(row, count);
}

void RequireEnd(const RecordReader& reader, const Header& header) {
  if (reader.AtEnd()) return;
  reader.Refuse(reader.line() + 1,
                "expected the end of the file after " +
                    std::to_string(header.patterns) +
                    " patterns, as its first line says; found more");
}

std::string ThermocoupleName(long long label,
                             std::size_t place,
                             std::set<long long>* seen) {
  const std::string name = "t" + TwoDigits(label);
  if (seen->insert(label).second) return name + "_degC";
  return name + "_" + std::to_string(place) + "_degC";
}

PatternTable ParseStacked(std::string_view text, const std::string& name) {
  RecordReader reader(text, name);
  const Header header = ReadHeader(text, &reader);
  const std::size_t thermocouples = header.inputs - 1;
  PatternTable table;
  table.scale = header.scale;
  table.inputs = {"position_mm"};
  for (std::size_t j = 0; j < header.outputs; ++j) {
    table.targets.push_back(TargetName(j, header.outputs));
  }
  std::vector<double> positions;
  std::vector<double> targets;
  std::vector<std::vector<double>> blocks;
  std::set<long long> labels;
  std::size_t done = 0;
  do {
    const bool first = blocks.empty();
    const std::size_t width =
        std::min(first ? kFirstBlock : kLaterBlock, thermocouples - done);
    const std::string block = "block " + std::to_string(blocks.size() + 1);
    const std::string label_line = "the numbers of " + std::to_string(width) +
                                   " thermocouples above " + block;
    const std::size_t titles = first ? 1 + header.outputs : 0;
    const std::vector<std::string> words =
        reader.Words(titles + width, label_line);
    for (std::size_t i = titles; i < words.size(); ++i) {
      double label = 0.0;
      if (!ParseNumber(words[i], &label) || label < 0.0 ||
          words[i].find('.') != std::string::npos) {
        reader.Refuse("expected " + label_line + ", found " +
                      QuotedText(words[i]) +
                      "; has the block before it as many rows as the first "
                      "line says?");
      }
      table.inputs.push_back(ThermocoupleName(
          reader.WholeNumber(label, label_line), done + i - titles, &labels));
    }
    const std::size_t before = first ? 2 + header.outputs : 0;
    std::vector<double>& values = blocks.emplace_back();
    for (std::size_t p = 0; p < header.patterns; ++p) {
      const std::string what =
          NumbersIn(before + width, p, header.patterns) + " of " + block;
      const std::vector<double> row = reader.Numbers(before + width, what);
      if (first) {
        table.index.push_back(reader.WholeNumber(row[0], what));
        positions.push_back(row[1]);
        targets.insert(targets.end(),
                       row.begin() + 2,
                       row.begin() + static_cast<std::ptrdiff_t>(before));
      }
      values.insert(values.end(),
                    row.begin() + static_cast<std::ptrdiff_t>(before),
                    row.end());
    }
    done += width;
  } while (done < thermocouples);
  RequireEnd(reader, header);

  const auto rows = static_cast<Index>(header.patterns);
  table.target_values = ToMatrix(targets, header.outputs);
  table.input_values.resize(rows, static_cast<Index>(header.inputs));
  table.input_values.col(0) = ToMatrix(positions, 1);
  Index column = 1;
  for (const std::vector<double>& values : blocks) {
    const std::size_t width = values.size() / header.patterns;
    if (width == 0) continue;
    table.input_values.middleCols(column, static_cast<Index>(width)) =
        ToMatrix(values, width);
    column += static_cast<Index>(width);
  }
  return table;
}

PatternTable ParsePlain(std::string_view text, const std::string& name) {
  RecordReader reader(text, name);
  const Header header = ReadHeader(text, &reader);
  const std::size_t width = header.inputs + header.outputs;
  PatternTable table;
  table.scale = header.scale;
  const std::vector<std::string> names =
      reader.Words(width, "names of " + std::to_string(width) + " columns");
  const auto split = names.begin() + static_cast<std::ptrdiff_t>(header.inputs);
  table.inputs.assign(names.begin(), split);
  table.targets.assign(split, names.end());
  std::vector<double> values;
  for (std::size_t p = 0; p < header.patterns; ++p) {
    const std::vector<double> row =
        reader.Numbers(width, NumbersIn(width, p, header.patterns));
    values.insert(values.end(), row.begin(), row.end());
  }
  RequireEnd(reader, header);
  const Eigen::MatrixXd all = ToMatrix(values, width);
  table.input_values = all.leftCols(static_cast<Index>(header.inputs));
  table.target_values = all.rightCols(static_cast<Index>(header.outputs));
  return table;
}

// Columns of a CSV file that PatternText wrote: targets last.
PatternTable TakeColumns(const CsvTable& csv,
                         std::size_t num_targets,
                         double scale) {
  PatternTable table;
  table.scale = scale;
  const auto rows = static_cast<Index>(csv.num_rows);
  std::vector<Eigen::VectorXd> columns;
  std::vector<std::string> names;
  for (const CsvColumn& column : csv.columns) {
    std::vector<Index> kept;
    const Eigen::VectorXd values =
        NumericColumn(csv, column.name, MissingPolicy::kError, &kept);
    if (names.empty() && table.index.empty() && column.name == kIndexColumn) {
      for (const double value : values) {
        table.index.push_back(static_cast<long long>(value));
      }
      continue;
    }
    columns.push_back(values);
    names.push_back(column.name);
  }
  if (columns.size() <= num_targets) {
    throw InputError(PrintablePath(csv.file) +
                     ": line 2: expected inputs and " +
                     std::to_string(num_targets) +
                     " targets, as its first line says; found " +
                     std::to_string(columns.size()) + " columns");
  }
  const std::size_t num_inputs = columns.size() - num_targets;
  table.input_values.resize(rows, static_cast<Index>(num_inputs));
  table.target_values.resize(rows, static_cast<Index>(num_targets));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool is_input = i < num_inputs;
    (is_input ? table.inputs : table.targets).push_back(names[i]);
    (is_input ? table.input_values : table.target_values)
        .col(static_cast<Index>(is_input ? i : i - num_inputs)) = columns[i];
  }
  return table;
}

PatternTable TakeDataset(const CsvTable& csv) {
  const Dataset dataset = MakeDataset(csv, {.keep_dead = true}).dataset;
  PatternTable table;
  table.targets = {dataset.target().name};
  table.target_values = dataset.target_values();
  table.input_values.resize(dataset.num_rows(), dataset.num_inputs());
  // The position first, all others in their order.
  std::vector<Index> order;
  for (Index i = 0; i < dataset.num_inputs(); ++i) order.push_back(i);
  std::stable_partition(order.begin(), order.end(), [&](Index i) {
    return StartsWithIgnoringCase(dataset.inputs()[i].name, "position");
  });
  for (const Index i : order) {
    table.input_values.col(static_cast<Index>(table.inputs.size())) =
        dataset.input_values().col(i);
    table.inputs.push_back(dataset.inputs()[i].name);
  }
  return table;
}

PatternTable ParseCsvPatterns(std::string_view text, const std::string& name) {
  const CsvTable csv = ParseCsv(text, name);
  const std::string first_line(text.substr(0, text.find('\n')));
  std::size_t num_targets = 0;
  double scale = 1.0;
  const std::string mark = std::string(kCsvMark) + kCsvScale;
  if (std::sscanf(first_line.c_str(), mark.c_str(), &num_targets, &scale) ==
          2 &&
      num_targets > 0) {
    return TakeColumns(csv, num_targets, scale);
  }
  return TakeDataset(csv);
}

// In its columns where these keep every digit, else as long as it must be.
std::string Fixed(const std::string& text, double value) {
  double read = 0.0;
  if (ParseNumber(Trimmed(text), &read) && read == value) return text;
  const std::string exact = CsvNumber(value);
  const std::size_t room = text.size() > exact.size() + 1
                               ? text.size() - exact.size()
                               : std::size_t{1};
  return std::string(room, ' ') + exact;
}

std::string ScaleText(double scale) {
  constexpr int kWidth = 11;
  const std::string text = Fixed(EditF(scale, kWidth, 6), scale);
  return std::string(Trimmed(text));
}

std::string FirstLine(const PatternTable& table) {
  return std::to_string(table.input_values.rows()) + " " +
         std::to_string(table.inputs.size()) + " " +
         std::to_string(table.targets.size()) + " " + ScaleText(table.scale) +
         "\n";
}

// Names, and numbers of a pattern: inputs, then targets.
std::vector<std::string> NamesOf(const PatternTable& table) {
  std::vector<std::string> names = table.inputs;
  names.insert(names.end(), table.targets.begin(), table.targets.end());
  return names;
}

std::vector<std::string> NumbersOf(const PatternTable& table, Index p) {
  std::vector<std::string> numbers;
  for (const double value : table.input_values.row(p)) {
    numbers.push_back(CsvNumber(value));
  }
  for (const double value : table.target_values.row(p)) {
    numbers.push_back(CsvNumber(value));
  }
  return numbers;
}

std::string PlainText(const PatternTable& table) {
  std::vector<std::string> names = NamesOf(table);
  for (std::string& name : names) std::ranges::replace(name, ' ', '_');
  std::string text = FirstLine(table) + JoinWords(names, " ") + "\n";
  for (Index p = 0; p < table.input_values.rows(); ++p) {
    text += JoinWords(NumbersOf(table, p), " ") + "\n";
  }
  return text;
}

std::string CsvText(const PatternTable& table) {
  const bool has_index = !table.index.empty();
  std::vector<std::string> names = NamesOf(table);
  for (std::string& name : names) name = CsvField(name);
  std::string text = "# patterns for errmap netcg: targets " +
                     std::to_string(table.targets.size()) + ", scale " +
                     ScaleText(table.scale) + "\n" +
                     (has_index ? std::string(kIndexColumn) + "," : "") +
                     JoinWords(names, ",") + "\n";
  for (Index p = 0; p < table.input_values.rows(); ++p) {
    if (has_index) text += std::to_string(table.index[p]) + ",";
    text += JoinWords(NumbersOf(table, p), ",") + "\n";
  }
  return text;
}

// The thermocouple's own number where its name has one, else its place.
long long LabelOf(const std::string& name, std::size_t place) {
  const std::size_t begin = name.find_first_of("0123456789");
  if (begin == std::string::npos) return static_cast<long long>(place);
  const std::size_t end = name.find_first_not_of("0123456789", begin);
  double label = 0.0;
  constexpr std::size_t kMostDigits = 9;
  const std::string digits = name.substr(begin, end - begin);
  if (digits.size() > kMostDigits || !ParseNumber(digits, &label)) {
    return static_cast<long long>(place);
  }
  return static_cast<long long>(label);
}

std::string StackedText(const PatternTable& table) {
  constexpr int kWide = 11;
  constexpr int kNarrow = 10;
  const std::size_t thermocouples = table.inputs.size() - 1;
  const Index rows = table.input_values.rows();
  std::string text =
      EditI(rows, kNarrow) +
      EditI(static_cast<long long>(table.inputs.size()), kNarrow) +
      EditI(static_cast<long long>(table.targets.size()), kNarrow) +
      Fixed(EditF(table.scale, kWide, 6), table.scale) + "\n POSITION";
  for (std::size_t j = 0; j < table.targets.size(); ++j) text += "  DIFF";
  const auto label = [&](std::size_t k) {
    return LabelOf(table.inputs[k + 1], k);
  };
  const auto reading = [&](Index p, std::size_t k) {
    const double value = table.input_values(p, static_cast<Index>(k + 1));
    return Fixed(EditF(value, kWide, 5), value);
  };
  const std::size_t first = std::min(kFirstBlock, thermocouples);
  for (std::size_t k = 0; k < first; ++k) text += EditI(label(k), kNarrow);
  text += '\n';
  for (Index p = 0; p < rows; ++p) {
    text += EditI(table.index.empty() ? p + 1 : table.index[p], kNarrow);
    const double position = table.input_values(p, 0);
    text += Fixed(EditF(position, kWide, 4), position);
    for (const double target : table.target_values.row(p)) {
      constexpr int kTarget = 16;
      text += Fixed(Edit1PE(target, kTarget, 7), target);
    }
    for (std::size_t k = 0; k < first; ++k) {
      // The third stands below, as Table 2 has it.
      if (k == kFirstBlock - 1) text += '\n';
      text += reading(p, k);
    }
    text += '\n';
  }
  for (std::size_t begin = first; begin < thermocouples; begin += kLaterBlock) {
    const std::size_t end = std::min(begin + kLaterBlock, thermocouples);
    for (std::size_t k = begin; k < end; ++k) text += EditI(label(k), kWide);
    text += '\n';
    for (Index p = 0; p < rows; ++p) {
      for (std::size_t k = begin; k < end; ++k) text += reading(p, k);
      text += '\n';
    }
  }
  return text;
}

}  // namespace

PatternForm PatternFormOf(std::string_view path) {
  if (EndsWithIgnoringCase(path, ".tab")) return PatternForm::kPlain;
  return EndsWithIgnoringCase(path, ".csv") ? PatternForm::kCsv
                                            : PatternForm::kStacked;
}

PatternTable ReadPatterns(const std::string& path) {
  return ParsePatterns(ReadFile(path), path);
}

PatternTable ParsePatterns(std::string_view text, const std::string& name) {
  const PatternForm form = PatternFormOf(name);
  if (form == PatternForm::kPlain) return ParsePlain(text, name);
  if (form == PatternForm::kCsv) return ParseCsvPatterns(text, name);
  return ParseStacked(text, name);
}

std::string PatternText(const PatternTable& table, PatternForm form) {
  if (table.inputs.empty() || table.targets.empty()) {
    throw std::invalid_argument("PatternText: no inputs or no targets");
  }
  if (form == PatternForm::kPlain) return PlainText(table);
  if (form == PatternForm::kCsv) return CsvText(table);
  return StackedText(table);
}

}  // namespace errmap::data
