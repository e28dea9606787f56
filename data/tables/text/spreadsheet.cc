#include "data/tables/text/spreadsheet.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/tables/text/gzip.h"
#include "data/tables/text/zip_archive.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::size_t kMostRows = 1U << 20U;  // of any sheet
constexpr std::size_t kMostColumns = 1U << 14U;
// Bytes of a part: some six million cells. Its elements take up to 16 times as
// much memory.
constexpr std::size_t kMostXml = std::size_t{1} << 28U;
// Cells of a table, the empty ones between others counted.
constexpr std::size_t kMostCells = std::size_t{1} << 26U;

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

// By the letters that are not literal text: "yyyy-mm-dd", "[h]:mm", "0.00 \m".
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

// Names of elements and attributes come with a prefix that is whatever it is.
bool IsNamed(std::string_view full_name, std::string_view name) {
  return full_name.substr(full_name.find(':') + 1) == name;
}

pugi::xml_node Child(pugi::xml_node parent, std::string_view name) {
  return parent.find_child(
      [&](pugi::xml_node node) { return IsNamed(node.name(), name); });
}

std::vector<pugi::xml_node> Children(pugi::xml_node parent,
                                     std::string_view name) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xml_node node : parent.children()) {
    if (IsNamed(node.name(), name)) found.push_back(node);
  }
  return found;
}

// "" if there is none.
std::string Attribute(pugi::xml_node node, std::string_view name) {
  return node
      .find_attribute([&](pugi::xml_attribute attribute) {
        return IsNamed(attribute.name(), name);
      })
      .value();
}

std::string TextIn(pugi::xml_node node) {
  std::string text;
  for (const pugi::xml_node part : node.children()) text += part.value();
  return text;
}

// Of a text in runs of several styles, without how it is pronounced.
std::string RichText(pugi::xml_node node) {
  std::string text;
  for (const pugi::xml_node part : node.children()) {
    if (IsNamed(part.name(), "t")) text += TextIn(part);
    if (IsNamed(part.name(), "r")) text += TextIn(Child(part, "t"));
  }
  return text;
}

class Workbook {
 public:
  explicit Workbook(std::string_view bytes)
      : archive_(bytes),
        most_xml_(std::min(kMostXml, MostUnpacked(bytes.size()))) {}

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
                       "; name one after a colon, or several as files: "
                       "'FILE.xlsx:" +
                       Printable(with_cells.front().name, kMostShown) + "'");
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

  // Reads a part and returns its outermost element.
  pugi::xml_node Load(const std::string& part,
                      pugi::xml_document* document) const {
    const std::string text = archive_.Read(part, most_xml_);
    // Neither are entities of its own known, nor is what they stand for.
    if (!document->load_buffer(
            text.data(),
            text.size(),
            pugi::parse_default | pugi::parse_ws_pcdata_single)) {
      throw InputError("is damaged: its XML is incomplete or invalid");
    }
    return document->document_element();
  }

  void ReadSheets() {
    std::map<std::string, std::string> parts;  // by relation
    pugi::xml_document relations;
    for (const pugi::xml_node one : Children(
             Load("xl/_rels/workbook.xml.rels", &relations), "Relationship")) {
      const std::string target = Attribute(one, "Target");
      parts[Attribute(one, "Id")] =
          target.starts_with('/') ? target.substr(1) : "xl/" + target;
    }
    pugi::xml_document document;
    const pugi::xml_node book = Load(kPath, &document);
    const std::string first = Attribute(Child(book, "workbookPr"), "date1904");
    from_1904_ = first == "1" || first == "true";
    for (const pugi::xml_node one : Children(Child(book, "sheets"), "sheet")) {
      const auto part = parts.find(Attribute(one, "id"));
      if (part == parts.end() || !archive_.Has(part->second)) continue;
      const std::string state = Attribute(one, "state");
      sheets_.push_back({Attribute(one, "name"),
                         part->second,
                         !state.empty() && state != "visible"});
    }
    if (sheets_.empty()) throw InputError("has no sheet of cells");
  }

  void ReadFormats() {
    constexpr const char* kStyles = "xl/styles.xml";
    if (!archive_.Has(kStyles)) return;
    pugi::xml_document document;
    const pugi::xml_node styles = Load(kStyles, &document);
    std::map<std::size_t, ShownTime> own;
    for (const pugi::xml_node one :
         Children(Child(styles, "numFmts"), "numFmt")) {
      own[WholeNumber(Attribute(one, "numFmtId"), 0)] =
          ShownBy(Attribute(one, "formatCode"));
    }
    for (const pugi::xml_node one : Children(Child(styles, "cellXfs"), "xf")) {
      const std::size_t id = WholeNumber(Attribute(one, "numFmtId"), 0);
      const auto found = own.find(id);
      styles_.push_back(found != own.end() ? found->second : BuiltIn(id));
    }
  }

  void ReadTexts() {
    constexpr const char* kTexts = "xl/sharedStrings.xml";
    if (!archive_.Has(kTexts)) return;
    pugi::xml_document document;
    for (const pugi::xml_node one : Children(Load(kTexts, &document), "si")) {
      texts_.push_back(OneLine(RichText(one)));
    }
  }

  std::string TextOf(const Sheet& sheet) const;
  std::string CellText(pugi::xml_node cell, const std::string& place) const;

  ZipArchive archive_;
  std::size_t most_xml_;
  std::vector<Sheet> sheets_;
  std::vector<ShownTime> styles_;  // of the cells' styles
  std::vector<std::string> texts_;
  bool from_1904_ = false;
};

std::string Workbook::CellText(pugi::xml_node cell,
                               const std::string& place) const {
  const std::string type = Attribute(cell, "t");
  const std::size_t style = WholeNumber(Attribute(cell, "s"), 0);
  const pugi::xml_node text = Child(cell, "is");
  std::string value = text ? RichText(text) : TextIn(Child(cell, "v"));
  if (Child(cell, "f") && value.empty() && type != "str") {
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

// 1-based, of "AB12"; 0 where the place has no letters.
std::size_t ColumnOf(std::string_view place) {
  std::size_t number = 0;
  for (const char c : place) {
    if (c < 'A' || c > 'Z' || number > kMostColumns) break;
    number = 26 * number + static_cast<std::size_t>(c - 'A') + 1;
  }
  return number;
}

// Cells of a row by column, from 1; what lies between them takes no memory.
using SparseRow = std::vector<std::pair<std::size_t, std::string>>;

void SetCell(std::size_t column, std::string text, SparseRow* row) {
  const auto at = std::ranges::lower_bound(
      *row, column, {}, &std::pair<std::size_t, std::string>::first);
  if (at != row->end() && at->first == column) {
    at->second = std::move(text);
  } else {
    row->emplace(at, column, std::move(text));
  }
}

std::string TextOfRows(const std::vector<SparseRow>& rows, std::size_t width) {
  const auto with_cells = static_cast<std::size_t>(std::ranges::count_if(
      rows, [](const auto& row) { return !row.empty(); }));
  if (width > 0 && with_cells > kMostCells / width) {
    throw InputError("has " + std::to_string(with_cells) + " rows and " +
                     std::to_string(width) +
                     " columns, more than can be read; delete cells far from "
                     "the table, or save it as CSV");
  }
  std::string text;
  for (const SparseRow& row : rows) {
    std::size_t column = 1;
    for (const auto& [place, cell] : row) {
      text.append(place - column, '\t');
      text += cell;
      column = place;
    }
    if (!row.empty()) text.append(width - column, '\t');
    text += '\n';
    if (text.size() > kMostTextOfPrograms) {
      throw InputError("is too long when unpacked");
    }
  }
  return width == 0 ? "" : text;
}

std::string Workbook::TextOf(const Sheet& sheet) const {
  pugi::xml_document document;
  std::vector<SparseRow> rows;
  std::size_t width = 0;
  std::size_t row = 0;  // 1-based, as they are in the file
  for (const pugi::xml_node line :
       Children(Child(Load(sheet.part, &document), "sheetData"), "row")) {
    row = WholeNumber(Attribute(line, "r"), row + 1);
    if (row == 0 || row > kMostRows) throw InputError("has a row beyond any");
    rows.resize(std::max(rows.size(), row));
    std::size_t column = 0;
    for (const pugi::xml_node cell : Children(line, "c")) {
      const std::string place = Attribute(cell, "r");
      const std::size_t number = ColumnOf(place);
      column = number == 0 ? column + 1 : number;
      if (column > kMostColumns) throw InputError("has a column beyond any");
      std::string text = CellText(cell, place);
      if (text.empty()) continue;
      width = std::max(width, column);
      SetCell(column, std::move(text), &rows[row - 1]);
    }
  }
  return TextOfRows(rows, width);
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
