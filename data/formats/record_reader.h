#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Reads text as list-directed READ statements of FORTRAN do: each reading
/// begins on a new line and goes on over as many as it needs; values are
/// separated by blanks, tabs or commas, may be repeated (3*0.5) and have
/// exponents with E or D. What stands behind the last value of a reading is a
/// comment - unless it is one more number, which FORTRAN would pass over in
/// silence and here is an error.
///
/// All throw InputError naming file, line, what was expected and what was
/// found.
class RecordReader {
 public:
  /// `text` must outlive the reader; `file` begins every message.
  RecordReader(std::string_view text, std::string file);

  /// `what` names the values in messages: "41 column flags".
  std::vector<double> Numbers(std::size_t count, const std::string& what);
  std::vector<long long> Integers(std::size_t count, const std::string& what);
  /// Whole numbers and others in one reading: Numbers checked by WholeNumber.
  long long WholeNumber(double value, const std::string& what) const;
  /// Words, in single or double quotes or up to the next blank.
  std::vector<std::string> Words(std::size_t count, const std::string& what);
  /// One text: in quotes, or the whole line without the blanks at its ends.
  std::string Text(const std::string& what);

  /// True where nothing but blank lines is left.
  bool AtEnd() const;
  /// 1-based line of the last value read.
  std::size_t line() const { return line_; }

  /// Throws InputError about that line, or about the last value read.
  [[noreturn]] void Refuse(std::size_t line, const std::string& why) const;
  [[noreturn]] void Refuse(const std::string& why) const { Refuse(line_, why); }

 private:
  // True, and at the first character of a value, where the line has one more.
  bool SkipSeparators();
  // At the first value of the next line that has one, or refuses.
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
