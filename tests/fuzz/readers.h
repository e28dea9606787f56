#pragma once

#include <string_view>
#include <vector>

namespace errmap::fuzz {

/// A reader of what users hand to the program. `read` takes any bytes; what it
/// refuses by an exception of its own kind is fine, all else is a finding.
struct Reader {
  const char* name;  // and the folder of its corpus
  void (*read)(std::string_view bytes);
};

const std::vector<Reader>& Readers();

/// Ends the run, as a crash does, where a property does not hold.
void Require(bool holds);

/// The program with words, one per line. Runs in a folder of its own that has
/// small files of every kind (d.csv, m.json, study.toml, ...), as if Ctrl-C had
/// been pressed before it began: everything is read and nothing is fitted.
void RunWithArguments(std::string_view bytes);

/// A small study of noise drawn from the first bytes, cells changed by those
/// that follow. Every figure of its record can be written and read again, and
/// where too few groups are held out to show anything, nothing is established.
void CompareSmallModels(std::string_view bytes);

}  // namespace errmap::fuzz
