#include "cli/netcg/run_file.h"

#include "data/csv.h"
#include "data/formats/record_reader.h"
#include "data/text.h"

namespace errmap::netcg {
namespace {

using data::RecordReader;
// The program read its flags by two statements, 20 and 21 of them.
constexpr std::size_t kFirstFlags = 20;
constexpr std::size_t kSecondFlags = 21;

void ReadNetwork(RecordReader* reader, NetcgSpecification* run) {
  const std::string what =
      "patterns, inputs, hidden nodes, outputs, wfactor and seed (6 numbers)";
  const std::vector<double> numbers = reader->Numbers(6, what);
  run->network_line = reader->line();
  const auto count = [&](std::size_t i, const char* name) {
    const long long value = reader->WholeNumber(numbers[i], what);
    constexpr long long kMost = 100'000'000;
    if (value < 1 || value > kMost) {
      reader->Refuse("the number of " + std::string(name) + " must be 1 to " +
                     std::to_string(kMost) + ", found " +
                     std::to_string(value));
    }
    return static_cast<Index>(value);
  };
  run->patterns = count(0, "patterns");
  run->inputs = count(1, "inputs");
  run->hidden = count(2, "hidden nodes");
  run->outputs = count(3, "outputs");
  run->wfactor = numbers[4];
  run->seed = reader->WholeNumber(numbers[5], what);
  constexpr Index kMostWeights = 10'000'000;
  if (run->num_weights() > kMostWeights) {
    reader->Refuse("these nodes make " + std::to_string(run->num_weights()) +
                   " weights; at most " + std::to_string(kMostWeights) +
                   " are taken");
  }
  if (run->wfactor < 0.0) {
    reader->Refuse("wfactor must be at least 0, found " +
                   data::CsvNumber(run->wfactor));
  }
}

void ReadConvergence(RecordReader* reader, NetcgSpecification* run) {
  const std::string what =
      "iterations, egoal, gwgoal, frequency and errdel (5 numbers)";
  const std::vector<double> numbers = reader->Numbers(5, what);
  run->iterations = reader->WholeNumber(numbers[0], what);
  run->egoal = numbers[1];
  run->gwgoal = numbers[2];
  run->nfreq = reader->WholeNumber(numbers[3], what);
  run->errdel = numbers[4];
  if (run->nfreq < 1) {
    reader->Refuse("the frequency of checks must be at least 1, found " +
                   std::to_string(run->nfreq));
  }
  if (!(run->errdel > 0.0)) {
    reader->Refuse("errdel must be above 0, found " +
                   data::CsvNumber(run->errdel));
  }
}

void ReadFlags(RecordReader* reader, NetcgSpecification* run) {
  const std::string all =
      " of the " + std::to_string(kFirstFlags + kSecondFlags) + " column flags";
  for (const auto& [count, which] :
       {std::pair{kFirstFlags, "the first "}, {kSecondFlags, "the last "}}) {
    const std::string what = which + std::to_string(count) + all;
    const std::vector<long long> flags = reader->Integers(count, what);
    if (run->flags_line == 0) run->flags_line = reader->line();
    for (const long long flag : flags) run->uses_column.push_back(flag != 0);
  }
}

NetcgSpecification ReadRun(RecordReader* reader) {
  NetcgSpecification run;
  run.title = reader->Text("the title of a run");
  for (std::size_t i = 0; i < kNumNetcgFiles; ++i) {
    const std::string what =
        "the name of the " + std::string(NameOf(static_cast<NetcgFile>(i)));
    run.files[i] = reader->Words(1, what).front();
    run.file_lines[i] = reader->line();
    if (run.files[i].empty()) reader->Refuse(what + " is empty");
    double number = 0.0;
    if (data::ParseNumber(run.files[i], &number)) {
      reader->Refuse("expected " + what + ", found the number " +
                     data::QuotedText(run.files[i]) +
                     "; a run has a title and eight names before its numbers");
    }
  }
  ReadNetwork(reader, &run);
  ReadConvergence(reader, &run);
  ReadFlags(reader, &run);
  return run;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\n') continue;
    quoted += c == '\'' ? "''" : std::string(1, c);
  }
  return quoted + "'\n";
}

}  // namespace

std::string_view NameOf(NetcgFile file) {
  static constexpr std::array<std::string_view, kNumNetcgFiles> kNames = {
      "run report",
      "pattern file",
      "initial weights file",
      "final weights file",
      "error curve file",
      "input-to-hidden weights graphics file",
      "hidden-to-output weights graphics file",
      "residual graphics file"};
  return data::NameOf(kNames, file);
}

std::vector<NetcgSpecification> ParseRunFile(std::string_view text,
                                             const std::string& name) {
  RecordReader reader(text, name);
  const std::string what = "the number of runs";
  const long long count = reader.Integers(1, what).front();
  constexpr long long kMostRuns = 10'000;
  if (count < 1 || count > kMostRuns) {
    reader.Refuse(what + " must be 1 to " + std::to_string(kMostRuns) +
                  ", found " + std::to_string(count));
  }
  std::vector<NetcgSpecification> runs;
  for (long long r = 0; r < count; ++r) runs.push_back(ReadRun(&reader));
  if (!reader.AtEnd()) {
    reader.Refuse(reader.line() + 1,
                  "expected the end of the file after " +
                      std::to_string(count) + (count == 1 ? " run" : " runs") +
                      ", as its first line says; found more");
  }
  return runs;
}

std::string RunFileText(const std::vector<NetcgSpecification>& runs) {
  std::string text = std::to_string(runs.size()) + "\n";
  const auto append = [&](double number, char after) {
    text += data::CsvNumber(number) + after;
  };
  for (const NetcgSpecification& run : runs) {
    text += Quoted(run.title);
    for (const std::string& file : run.files) text += Quoted(file);
    for (const Index count :
         {run.patterns, run.inputs, run.hidden, run.outputs}) {
      text += std::to_string(count) + " ";
    }
    append(run.wfactor, ' ');
    text +=
        std::to_string(run.seed) + "\n" + std::to_string(run.iterations) + " ";
    append(run.egoal, ' ');
    append(run.gwgoal, ' ');
    text += std::to_string(run.nfreq) + " ";
    append(run.errdel, '\n');
    for (std::size_t i = 0; i < kFirstFlags + kSecondFlags; ++i) {
      const bool uses = i >= run.uses_column.size() || run.uses_column[i];
      const bool ends =
          i + 1 == kFirstFlags || i + 1 == kFirstFlags + kSecondFlags;
      text += std::string(uses ? "1" : "0") + (ends ? "\n" : " ");
    }
  }
  return text;
}

}  // namespace errmap::netcg
