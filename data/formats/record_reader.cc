#include "data/formats/record_reader.h"

#include <cmath>
#include <utility>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

bool IsSeparator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

// The number of a token, FORTRAN's D exponents included.
bool ParseReal(std::string_view token, double* value) {
  std::string text(token);
  for (char& c : text) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  return ParseNumber(text, value);
}

// Takes "3*" off a token; 1 if there is none, 0 if it is not a count.
std::size_t TakeRepeat(std::string_view* token) {
  const std::size_t star = token->find('*');
  if (star == std::string_view::npos) return 1;
  constexpr double kMost = 1e9;
  double count = 0.0;
  if (!ParseNumber(token->substr(0, star), &count) || count < 1.0 ||
      count > kMost || count != std::floor(count)) {
    return 0;
  }
  token->remove_prefix(star + 1);
  return static_cast<std::size_t>(count);
}

}  // namespace

RecordReader::RecordReader(std::string_view text, std::string file)
    : text_(text), file_(std::move(file)) {}

std::vector<double> RecordReader::Numbers(std::size_t count,
                                          const std::string& what) {
  std::vector<double> values;
  std::size_t begin = 0;  // line of the first
  while (values.size() < count) {
    SkipToValue(values.empty()
                    ? what
                    : what + " from line " + std::to_string(begin) + " on");
    if (values.empty()) begin = line_;
    std::string_view token = Token();
    const std::string_view found = token;
    const std::size_t repeat = TakeRepeat(&token);
    double value = 0.0;
    if (repeat == 0 || !ParseReal(token, &value)) {
      Refuse("expected " + what + ", found " + QuotedText(found));
    }
    if (repeat > count - values.size()) {
      Refuse("expected " + what + ", found more: " + QuotedText(found));
    }
    values.insert(values.end(), repeat, value);
  }
  double value = 0.0;
  if (SkipSeparators()) {
    const std::string_view rest = Token();
    if (ParseReal(rest, &value)) {
      Refuse("expected " + what +
             ", found one more number: " + QuotedText(rest));
    }
  }
  SkipLine();
  return values;
}

long long RecordReader::WholeNumber(double value,
                                    const std::string& what) const {
  constexpr double kMost = 1e15;
  if (value != std::floor(value) || std::abs(value) > kMost) {
    Refuse("expected " + what +
           ", found a number that is not whole: " + std::to_string(value));
  }
  return static_cast<long long>(value);
}

std::vector<long long> RecordReader::Integers(std::size_t count,
                                              const std::string& what) {
  std::vector<long long> integers;
  for (const double value : Numbers(count, what)) {
    integers.push_back(WholeNumber(value, what));
  }
  return integers;
}

std::vector<std::string> RecordReader::Words(std::size_t count,
                                             const std::string& what) {
  std::vector<std::string> words;
  while (words.size() < count) {
    SkipToValue(what);
    words.push_back(Word());
  }
  SkipLine();
  return words;
}

std::string RecordReader::Text(const std::string& what) {
  SkipToValue(what);
  std::string text;
  if (text_[at_] == '\'' || text_[at_] == '"') {
    text = Word();
  } else {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    if (line.ends_with('\r')) line.remove_suffix(1);
    text = Trimmed(line);
  }
  SkipLine();
  return text;
}

bool RecordReader::AtEnd() const {
  for (std::size_t i = at_; i < text_.size(); ++i) {
    if (text_[i] != '\n' && !IsSeparator(text_[i])) return false;
  }
  return true;
}

void RecordReader::Refuse(std::size_t line, const std::string& why) const {
  throw InputError(PrintablePath(file_) + ": line " + std::to_string(line) +
                   ": " + why);
}

bool RecordReader::SkipSeparators() {
  while (at_ < text_.size() && IsSeparator(text_[at_])) ++at_;
  return at_ < text_.size() && text_[at_] != '\n';
}

void RecordReader::SkipToValue(const std::string& what) {
  while (!SkipSeparators()) {
    if (at_ >= text_.size()) {
      Refuse(next_line_, "expected " + what + ", but the file ends here");
    }
    SkipLine();
  }
  line_ = next_line_;
}

void RecordReader::SkipLine() {
  const std::size_t end = text_.find('\n', at_);
  if (end == std::string_view::npos) {
    at_ = text_.size();
    return;
  }
  at_ = end + 1;
  ++next_line_;
}

std::string_view RecordReader::Token() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && text_[at_] != '\n' && !IsSeparator(text_[at_])) {
    ++at_;
  }
  return text_.substr(begin, at_ - begin);
}

std::string RecordReader::Word() {
  const char quote = text_[at_];
  if (quote != '\'' && quote != '"') return std::string(Token());
  std::string word;
  for (++at_; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
    if (text_[at_] != quote) {
      word += text_[at_];
    } else if (at_ + 1 < text_.size() && text_[at_ + 1] == quote) {
      word += quote;
      ++at_;
    } else {
      ++at_;
      return word;
    }
  }
  Refuse("the quote " + std::string(1, quote) +
         " is not closed before the line ends");
}

}  // namespace errmap::data
