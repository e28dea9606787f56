#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Reads text like FORTRAN's list-directed READ statements. Each reading begins
/// on a new line and takes as many lines as it needs. Values are separated by
/// blanks, tabs or commas, may be repeated (3*0.5) and have exponents with E or
/// D. Text after the last value of a reading is a comment. A further number,
/// which FORTRAN would ignore, is an error here. All functions throw InputError
/// naming file, line, and what was expected and found.
class RecordReader {
 public:
  /// `text` must outlive the reader; `file` begins every message.
  RecordReader(std::string_view text, std::string file);

  /// `what` names the values in messages: "41 column flags".
  std::vector<double> Numbers(std::size_t count, const std::string& what);
  std::vector<long long> Integers(std::size_t count, const std::string& what);
  /// For whole numbers and others in one reading: Numbers checked by
  /// WholeNumber.
  long long WholeNumber(double value, const std::string& what) const;
  /// Reads words, in single or double quotes or up to the next blank.
  std::vector<std::string> Words(std::size_t count, const std::string& what);
  /// Reads one text: in quotes, or the whole line without the blanks at its
  /// ends.
  std::string Text(const std::string& what);

  /// True if only blank lines remain.
  bool AtEnd() const;
  /// 1-based line of the last value read.
  std::size_t line() const { return line_; }

  /// Throws InputError about that line, or about the last value read.
  [[noreturn]] void Refuse(std::size_t line, const std::string& why) const;
  [[noreturn]] void Refuse(const std::string& why) const { Refuse(line_, why); }

 private:
  // Moves to the next value of the line; false if there is none.
  bool SkipSeparators();
  // Moves to the next value of this or a later line; refuses at the file's end.
  void SkipToValue(const std::string& what);
  void SkipLine();
  std::string_view Token();
  std::string Word();

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;       // of the last value
  std::size_t next_line_ = 1;  // of text_[at_]
};

}  // namespace errmap::data
