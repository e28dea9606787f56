#include "data/spreadsheet.h"

#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "data/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "data/xml_scanner.h"
#include "data/zip_archive.h"

namespace errmap::data {
namespace {

using Kind = XmlScanner::Kind;

constexpr std::size_t kMostRows = 1U << 20U;  // of any sheet
constexpr std::size_t kMostColumns = 1U << 14U;

// What of a moment a format shows.
struct ShownTime {
  bool date = false;
  bool hours = false;
};

std::size_t WholeNumber(std::string_view text, std::size_t otherwise) {
  std::size_t number = otherwise;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// Formats that every workbook has: ECMA-376 part 1, 18.8.30.
ShownTime BuiltIn(std::size_t format) {
  const auto within = [&](std::size_t first, std::size_t last) {
    return format >= first && format <= last;
  };
  return {.date = within(14, 17) || format == 22 || within(27, 36) ||
                  within(50, 58),
          .hours = within(18, 22) || within(45, 47)};
}

// By the letters that are no literal text: "yyyy-mm-dd", "[h]:mm", "0.00 \m".
ShownTime ShownBy(std::string_view code) {
  ShownTime shown;
  bool months_or_minutes = false;
  for (std::size_t i = 0; i < code.size() && code[i] != ';'; ++i) {
    const char c = code[i];
    if (c == '\\' || c == '_' || c == '*') {
      ++i;
    } else if (c == '"') {
      i = std::min(code.find('"', i + 1), code.size());
    } else if (c == '[') {
      // A colour, a condition, a currency; or hours beyond a day.
      const std::size_t end = std::min(code.find(']', i), code.size());
      const std::string_view inside = code.substr(i + 1, end - i - 1);
      if (inside.find_first_not_of("hHmMsS") == std::string_view::npos) {
        shown.hours = true;
      }
      i = end;
    } else if (c == 'y' || c == 'Y' || c == 'd' || c == 'D') {
      shown.date = true;
    } else if (c == 'h' || c == 'H' || c == 's' || c == 'S') {
      shown.hours = true;
    } else if (c == 'm' || c == 'M') {
      months_or_minutes = true;
    }
  }
  if (months_or_minutes && !shown.hours) shown.date = true;
  return shown;
}

std::string PaddedNumber(std::int64_t number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

// A number of days as the moment that it stands for.
std::string MomentText(double days, ShownTime shown, bool from_1904) {
  constexpr double kMillisecondsOfADay = 86'400'000.0;
  constexpr double kLastDay = 2'958'465.0;  // 9999-12-31
  std::string text;
  auto milliseconds =
      static_cast<std::int64_t>(std::round(days * kMillisecondsOfADay));
  if (days < 0.0 || days > kLastDay + 1.0) return text;
  const auto whole_days =
      milliseconds / static_cast<std::int64_t>(kMillisecondsOfADay);
  milliseconds -= whole_days * static_cast<std::int64_t>(kMillisecondsOfADay);
  if (shown.date) {
    // Day 60 is the 29th of February 1900, which there was not.
    constexpr std::int64_t kNoDay = 60;
    const std::chrono::sys_days first =
        from_1904 ? std::chrono::sys_days(std::chrono::January / 1 / 1904)
                  : std::chrono::sys_days(std::chrono::December / 30 / 1899);
    const std::chrono::year_month_day date{
        first + std::chrono::days(whole_days +
                                  (!from_1904 && whole_days < kNoDay ? 1 : 0))};
    const std::int64_t month = static_cast<unsigned>(date.month());
    const std::int64_t day = static_cast<unsigned>(date.day());
    text = std::to_string(static_cast<int>(date.year())) + "-" +
           PaddedNumber(month) + "-" + PaddedNumber(day);
  }
  if (shown.hours) {
    const std::int64_t seconds = milliseconds / 1000;
    // Hours of a duration beyond a day.
    const std::int64_t hours =
        seconds / 3600 + (shown.date ? 0 : 24 * whole_days);
    text += (text.empty() ? "" : " ") + PaddedNumber(hours) + ":" +
            PaddedNumber(seconds / 60 % 60) + ":" + PaddedNumber(seconds % 60);
    if (const std::int64_t rest = milliseconds % 1000; rest != 0) {
      text += "." + std::to_string(1000 + rest).substr(1);
    }
  }
  return text;
}

// A cell in one line, so that its row stays one.
std::string OneLine(std::string text) {
  for (char& c : text) {
    if (c == '\t' || c == '\n' || c == '\r' || c == '\0') c = ' ';
  }
  if (!text.starts_with('"')) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

// Texts until `element` closes, without how they are pronounced.
std::string TextWithin(XmlScanner* xml, std::string_view element) {
  std::string text;
  bool pronounced = false;
  bool inside = element == "v";
  for (Kind kind = xml->Next(); !xml->Closes(element); kind = xml->Next()) {
    if (kind == Kind::kEnd) throw InputError("is damaged: its XML breaks off");
    if (kind == Kind::kText && inside && !pronounced) text += xml->Text();
    if (kind == Kind::kText) continue;
    if (xml->name() == "rPh") pronounced = kind == Kind::kOpen;
    if (xml->name() == "t") inside = kind == Kind::kOpen;
  }
  return text;
}

class Workbook {
 public:
  explicit Workbook(std::string_view bytes) : archive_(bytes) {}

  bool IsOne() const { return archive_.Has(kPath); }

  std::string Text(const std::string& sheet) {
    ReadSheets();
    ReadFormats();
    ReadTexts();
    if (!sheet.empty()) {
      for (const Sheet& one : sheets_) {
        if (EqualsIgnoringCase(one.name, sheet)) return TextOf(one);
      }
      throw InputError("has no sheet " + QuotedName(sheet) + "; it has " +
                       Names(sheets_));
    }
    std::vector<Sheet> with_cells;
    std::string text;
    for (const Sheet& one : sheets_) {
      if (one.hidden) continue;
      std::string cells = TextOf(one);
      if (cells.empty()) continue;
      with_cells.push_back(one);
      text = std::move(cells);
    }
    if (with_cells.size() > 1) {
      throw InputError("has the sheets " + Names(with_cells) +
                       "; name one after a colon: FILE.xlsx:" +
                       Printable(with_cells.front().name, kMostShown));
    }
    return text;
  }

 private:
  static constexpr const char* kPath = "xl/workbook.xml";
  static constexpr std::size_t kMostShown = 40;

  struct Sheet {
    std::string name;
    std::string part;
    bool hidden = false;
  };

  static std::string Names(const std::vector<Sheet>& sheets) {
    constexpr std::size_t kMostNamed = 8;
    std::string names;
    for (std::size_t i = 0; i < sheets.size() && i < kMostNamed; ++i) {
      names += (i == 0 ? "" : ", ") + QuotedName(sheets[i].name);
    }
    return names + (sheets.size() > kMostNamed ? ", ..." : "");
  }

  std::string Part(const std::string& name) const {
    return archive_.Read(name, kMostTextOfPrograms);
  }

  void ReadSheets() {
    std::map<std::string, std::string> parts;  // by relation
    const std::string relations = Part("xl/_rels/workbook.xml.rels");
    XmlScanner of_relations(relations);
    while (of_relations.Next() != Kind::kEnd) {
      if (!of_relations.Opens("Relationship")) continue;
      const std::string target = of_relations.Attribute("Target");
      parts[of_relations.Attribute("Id")] =
          target.starts_with('/') ? target.substr(1) : "xl/" + target;
    }
    const std::string text = Part(kPath);
    XmlScanner xml(text);
    while (xml.Next() != Kind::kEnd) {
      if (xml.Opens("workbookPr")) {
        const std::string first = xml.Attribute("date1904");
        from_1904_ = first == "1" || first == "true";
      }
      if (!xml.Opens("sheet")) continue;
      // "id" and "r:id" differ in their prefix, which is whatever it is.
      const auto part = parts.find(xml.Attribute("id"));
      if (part == parts.end() || !archive_.Has(part->second)) continue;
      const std::string state = xml.Attribute("state");
      sheets_.push_back({xml.Attribute("name"),
                         part->second,
                         !state.empty() && state != "visible"});
    }
    if (sheets_.empty()) throw InputError("has no sheet of cells");
  }

  void ReadFormats() {
    constexpr const char* kStyles = "xl/styles.xml";
    if (!archive_.Has(kStyles)) return;
    const std::string text = Part(kStyles);
    std::map<std::size_t, ShownTime> own;
    XmlScanner xml(text);
    bool in_cells = false;
    while (xml.Next() != Kind::kEnd) {
      if (xml.name() == "cellXfs") in_cells = !xml.Closes("cellXfs");
      if (xml.Opens("numFmt")) {
        own[WholeNumber(xml.Attribute("numFmtId"), 0)] =
            ShownBy(xml.Attribute("formatCode"));
      } else if (in_cells && xml.Opens("xf")) {
        const std::size_t id = WholeNumber(xml.Attribute("numFmtId"), 0);
        const auto found = own.find(id);
        styles_.push_back(found != own.end() ? found->second : BuiltIn(id));
      }
    }
  }

  void ReadTexts() {
    constexpr const char* kTexts = "xl/sharedStrings.xml";
    if (!archive_.Has(kTexts)) return;
    const std::string text = Part(kTexts);
    XmlScanner xml(text);
    while (xml.Next() != Kind::kEnd) {
      if (xml.Opens("si")) texts_.push_back(OneLine(TextWithin(&xml, "si")));
    }
  }

  std::string TextOf(const Sheet& sheet) const;
  std::string CellText(XmlScanner* xml, const std::string& place) const;

  ZipArchive archive_;
  std::vector<Sheet> sheets_;
  std::vector<ShownTime> styles_;  // of the cells' styles
  std::vector<std::string> texts_;
  bool from_1904_ = false;
};

// The cell whose tag has been opened.
std::string Workbook::CellText(XmlScanner* xml,
                               const std::string& place) const {
  const std::string type = xml->Attribute("t");
  const std::size_t style = WholeNumber(xml->Attribute("s"), 0);
  std::string value;
  bool has_formula = false;
  while (xml->Next() != Kind::kEnd && !xml->Closes("c")) {
    if (xml->Opens("f")) has_formula = true;
    if (xml->Opens("v") || xml->Opens("is")) {
      value = TextWithin(xml, std::string(xml->name()));
    }
  }
  if (has_formula && value.empty() && type != "str") {
    throw InputError("cell " + place +
                     " has a formula without a value; open the file in a "
                     "spreadsheet program and save it there");
  }
  if (type == "s") {
    const std::size_t index = WholeNumber(value, texts_.size());
    if (index >= texts_.size()) throw InputError("is damaged at cell " + place);
    return texts_[index];
  }
  if (type == "b") return value == "1" ? "TRUE" : "FALSE";
  // Else "#N/A" would begin a comment.
  if (type == "e") return '"' + value + '"';
  if (type.empty() || type == "n") {
    double days = 0.0;
    const ShownTime shown =
        style < styles_.size() ? styles_[style] : ShownTime();
    if ((shown.date || shown.hours) && ParseNumber(value, &days)) {
      if (std::string moment = MomentText(days, shown, from_1904_);
          !moment.empty()) {
        return moment;
      }
    }
  }
  return OneLine(std::move(value));
}

std::string Workbook::TextOf(const Sheet& sheet) const {
  const std::string part = Part(sheet.part);
  XmlScanner xml(part);
  std::vector<std::vector<std::string>> rows;
  std::size_t width = 0;
  std::size_t row = 0;  // 1-based, as they are in the file
  std::size_t column = 0;
  while (xml.Next() != Kind::kEnd) {
    if (xml.Opens("row")) {
      row = WholeNumber(xml.Attribute("r"), row + 1);
      column = 0;
      if (row == 0 || row > kMostRows) throw InputError("has a row beyond any");
      rows.resize(std::max(rows.size(), row));
    }
    if (!xml.Opens("c") || row == 0) continue;
    const std::string place = xml.Attribute("r");
    std::size_t number = 0;
    for (const char c : place) {
      if (c < 'A' || c > 'Z' || number > kMostColumns) break;
      number = 26 * number + static_cast<std::size_t>(c - 'A') + 1;
    }
    column = number == 0 ? column + 1 : number;
    if (column > kMostColumns) throw InputError("has a column beyond any");
    std::string text = CellText(&xml, place);
    if (text.empty()) continue;
    width = std::max(width, column);
    auto& cells = rows[row - 1];
    if (cells.size() < column) cells.resize(column);
    cells[column - 1] = std::move(text);
  }
  std::string text;
  for (const std::vector<std::string>& cells : rows) {
    for (std::size_t i = 0; !cells.empty() && i < width; ++i) {
      if (i > 0) text += '\t';
      if (i < cells.size()) text += cells[i];
    }
    text += '\n';
    if (text.size() > kMostTextOfPrograms) {
      throw InputError("is too long when unpacked");
    }
  }
  return width == 0 ? "" : text;
}

}  // namespace

std::optional<std::string> SheetText(std::string_view bytes,
                                     const std::string& sheet) {
  if (!IsZip(bytes)) return std::nullopt;
  Workbook workbook(bytes);
  if (!workbook.IsOne()) return std::nullopt;
  return workbook.Text(sheet);
}

}  // namespace errmap::data
