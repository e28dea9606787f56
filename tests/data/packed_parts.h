#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "data/tables/text/gzip.h"

namespace errmap::testing {

using Parts = std::vector<std::pair<std::string, std::string>>;

/// A zip archive of these names and contents, deflated.
inline std::string ZipOf(const Parts& parts) {
  const auto number = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) {
      text += static_cast<char>((value >> (8 * i)) & 0xFFU);
    }
    return text;
  };
  std::string files;
  std::string directory;
  for (const auto& [name, content] : parts) {
    // gzip is a header of ten bytes, what zip wants, the sum and the size.
    const std::string gzip = data::Gzip(content);
    const std::string packed = gzip.substr(10, gzip.size() - 18);
    const std::string common =
        number(20, 2) + number(0, 2) + number(8, 2) + number(0, 4) +
        gzip.substr(gzip.size() - 8, 4) + number(packed.size(), 4) +
        number(content.size(), 4) + number(name.size(), 2) + number(0, 2);
    directory += "PK\x01\x02" + number(20, 2) + common + number(0, 8) +
                 number(0, 2) + number(files.size(), 4) + name;
    files += "PK\x03\x04" + common + name + packed;
  }
  return files + directory + "PK\x05\x06" + number(0, 4) +
         number(parts.size(), 2) + number(parts.size(), 2) +
         number(directory.size(), 4) + number(files.size(), 4) + number(0, 2);
}

/// A workbook of sheets: names and what stands between <sheetData> and its
/// end. Style 1 is a date, 2 date and time, 3 hours and minutes, 4 a number of
/// millimetres; text 0 is "error_um", text 1 "position_mm".
inline std::string XlsxOf(const Parts& sheets,
                          const std::string& workbook_more = "") {
  Parts parts;
  std::string names;
  std::string relations;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    const std::string n = std::to_string(i + 1);
    names += "<sheet name=\"" + sheets[i].first + "\" sheetId=\"" + n +
             "\" r:id=\"rId" + n + "\"/>";
    relations += "<Relationship Id=\"rId" + n +
                 "\" Type=\"worksheet\" Target=\"worksheets/sheet" + n +
                 ".xml\"/>";
    parts.emplace_back("xl/worksheets/sheet" + n + ".xml",
                       "<?xml version=\"1.0\"?><worksheet><sheetData>" +
                           sheets[i].second + "</sheetData></worksheet>");
  }
  parts.emplace_back("xl/workbook.xml",
                     "<workbook>" + workbook_more + "<sheets>" + names +
                         "</sheets></workbook>");
  parts.emplace_back("xl/_rels/workbook.xml.rels",
                     "<Relationships>" + relations + "</Relationships>");
  parts.emplace_back(
      "xl/styles.xml",
      "<styleSheet><numFmts><numFmt numFmtId=\"164\" "
      "formatCode=\"dd\\.mm\\.yyyy hh:mm\"/><numFmt numFmtId=\"165\" "
      "formatCode=\"0.00 &quot;mm day&quot;\"/></numFmts><cellStyleXfs><xf "
      "numFmtId=\"14\"/></cellStyleXfs><cellXfs><xf numFmtId=\"0\"/><xf "
      "numFmtId=\"14\"/><xf numFmtId=\"164\"/><xf numFmtId=\"20\"/><xf "
      "numFmtId=\"165\"/></cellXfs></styleSheet>");
  parts.emplace_back("xl/sharedStrings.xml",
                     "<sst><si><t>error_um</t></si><si><r><t>position</t></r>"
                     "<rPh sb=\"0\"><t>ignored</t></rPh><r><t>_mm</t></r></si>"
                     "</sst>");
  return ZipOf(parts);
}

}  // namespace errmap::testing
