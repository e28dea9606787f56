#include <algorithm>
#include <sstream>

#include "cli/report/wrap_text.h"
#include "cli/shell/help_text.h"

namespace errmap::cli {
namespace {

// Removes the marks of Markdown: "[words](page.md)" becomes "words", `code` and
// **strong** become what they enclose, a picture becomes its description.
std::string Unmarked(std::string_view text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::string_view rest = text.substr(at);
    const std::size_t middle = rest.find("](");
    const std::size_t end =
        middle == rest.npos ? middle : rest.find(')', middle);
    if (rest.starts_with("![") && end != rest.npos) {
      plain.append("[Picture: ").append(rest.substr(2, middle - 2)) += "]";
      at += end;
    } else if (rest.front() == '[' && end != rest.npos) {
      plain += Unmarked(rest.substr(1, middle - 1));
      at += end;
    } else if (rest.starts_with("**")) {
      ++at;
    } else if (rest.front() != '`') {
      plain += rest.front();
    }
  }
  return plain;
}

/// Gathers the lines of a paragraph or an item until it ends.
class PageWriter {
 public:
  explicit PageWriter(std::size_t width) : width_(width) {}

  void Add(std::string_view line) {
    if (line.starts_with("```")) {
      EndParagraph();
      in_code_ = !in_code_;
    } else if (in_code_) {
      text_ += (line.empty() ? "" : "    ") + std::string(line) + "\n";
    } else if (line.starts_with("<!--") || line.starts_with("|--")) {
      EndParagraph();
    } else if (line.empty()) {
      EndParagraph();
      if (!text_.empty() && !text_.ends_with("\n\n")) text_ += "\n";
    } else if (line.front() == '#') {
      EndParagraph();
      AddHeading(line);
    } else if (line.front() == '|') {
      EndParagraph();
      text_ += Unmarked(line) + "\n";
    } else {
      if (line.starts_with("- ")) EndParagraph();
      paragraph_ += (paragraph_.empty() ? "" : " ") +
                    std::string(line.substr(line.find_first_not_of(' ')));
    }
  }

  std::string Text() {
    EndParagraph();
    while (text_.ends_with("\n\n")) text_.pop_back();
    return text_;
  }

 private:
  void AddHeading(std::string_view line) {
    const std::string words =
        Unmarked(line.substr(std::min(line.find(' ') + 1, line.size())));
    text_ += words + "\n" +
             std::string(report::WidthOf(words),
                         line.starts_with("# ") ? '=' : '-') +
             "\n";
  }

  void EndParagraph() {
    const bool is_item = paragraph_.starts_with("- ");
    const std::string words = Unmarked(paragraph_.substr(is_item ? 2 : 0));
    paragraph_.clear();
    text_ += report::Hanging(is_item ? "- " : "", words, width_);
  }

  std::size_t width_;
  std::string text_;
  std::string paragraph_;
  bool in_code_ = false;
};

}  // namespace

std::vector<std::string> TopicNames() {
  std::vector<std::string> names;
  for (const Topic& topic : Topics()) names.push_back(topic.name);
  return names;
}

std::string TitleOf(const Topic& topic) {
  const std::string_view line = topic.page.substr(0, topic.page.find('\n'));
  return std::string(line.substr(std::min<std::size_t>(2, line.size())));
}

std::string TopicText(const Topic& topic, std::size_t width) {
  std::istringstream lines{std::string(topic.page)};
  PageWriter writer(width);
  for (std::string line; std::getline(lines, line);) writer.Add(line);
  return writer.Text();
}

}  // namespace errmap::cli
