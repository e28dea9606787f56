#include "data/tables/text/text_encoding.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iconv.h>
#include <optional>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

struct KnownFormat {
  std::string_view start;
  std::string_view what;
  bool in_any_case = false;
  std::size_t at = 0;  // where `start` stands
};

// What files of other programs begin with.
constexpr auto kFormats = std::to_array<KnownFormat>(
    {{"PK\x03\x04",
      "an archive or a spreadsheet other than xlsx; save it as xlsx or CSV"},
     {"\xD0\xCF\x11\xE0",
      "a spreadsheet (xls, or with a password); save it as xlsx or CSV"},
     {.start = "1AY&SY",  // of the first block; "BZh" may begin a name
      .what = "compressed (bzip2); unpack it with bunzip2",
      .at = 4},
     {"\xFD"
      "7zXZ",
      "compressed (xz); unpack it with unxz"},
     {"7z\xBC\xAF", "an archive (7z); unpack it"},
     {"%PDF-", "a PDF; export the table as CSV"},
     {"<!DOCTYPE", "a web page; save the table as CSV", true},
     {"<html", "a web page; save the table as CSV", true},
     {"<table", "a web page; save the table as CSV", true},
     {"<?xml", "XML; export the table as CSV", true},
     {"CREATE TABLE", "SQL; export the table as CSV", true},
     {"INSERT INTO", "SQL; export the table as CSV", true},
     {"[{", "JSON; export the table as CSV"},
     {"{", "JSON, as maps and results are; measurements are CSV or xlsx"}});

// Of UTF-16, by the mark, else where every other byte of the first characters
// is NUL; null: it is none.
const char* Utf16Of(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return "UTF-16LE";
  if (bytes.starts_with("\xFE\xFF")) return "UTF-16BE";
  constexpr std::size_t kLooked = 64;
  const std::size_t size = std::min(bytes.size(), kLooked) / 2 * 2;
  if (size < 4) return nullptr;
  std::array<std::size_t, 2> nuls{};
  for (std::size_t i = 0; i < size; ++i) nuls[i % 2] += bytes[i] == '\0';
  if (nuls[0] == 0 && nuls[1] == size / 2) return "UTF-16LE";
  if (nuls[1] == 0 && nuls[0] == size / 2) return "UTF-16BE";
  return nullptr;
}

// Text in another encoding as UTF-8, as far as it is whole.
struct Decoded {
  std::string text;
  std::size_t used = 0;  // bytes
};

// Nothing where the system does not know the encoding.
std::optional<Decoded> Decode(std::string_view bytes, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  // POSIX has -1 for the pointer; std::bit_cast of it crashes clang-tidy 14.
  if (reinterpret_cast<std::intptr_t>(converter) == -1) {  // NOLINT
    return std::nullopt;
  }
  Decoded decoded;
  std::array<char, 1U << 14U> part{};
  std::string input(bytes);
  char* in = input.data();
  std::size_t left = input.size();
  for (bool goes_on = true; goes_on;) {
    char* out = part.data();
    std::size_t room = part.size();
    const bool failed = iconv(converter, &in, &left, &out, &room) ==
                        static_cast<std::size_t>(-1);
    decoded.text.append(part.data(), part.size() - room);
    goes_on = failed && room < 16 && left > 0;  // more than a character's room
  }
  iconv_close(converter);
  decoded.used = bytes.size() - left;
  return decoded;
}

// Words and units that tables have and that are not written in ASCII.
int CountKnownWords(std::string_view text) {
  constexpr std::string_view kBetween = ",;|\t\r\n\"";
  int count = 0;
  for (const std::string_view part : SplitWords(text, kBetween)) {
    const std::string cell = AsUtf8(part);
    if (std::ranges::all_of(cell, [](char c) { return (c & 0x80) == 0; })) {
      continue;
    }
    const std::vector<std::string> words = WordsOf(cell);
    count += ReadHeader(cell).source == UnitSource::kStated ? 1 : 0;
    for (int word = 0; word <= static_cast<int>(Word::kPlace); ++word) {
      count += SayAny(words, static_cast<Word>(word)) ? 1 : 0;
    }
  }
  return count;
}

// What makes known words of the first lines where they are not UTF-8; null:
// Windows 1252 does as well, which is read cell by cell.
const char* EncodingByWords(std::string_view bytes) {
  constexpr std::size_t kLooked = 1U << 14U;
  std::string_view head = bytes.substr(0, kLooked);
  head = head.substr(0, head.find_last_of("\r\n"));
  if (AsUtf8(head) == head) return nullptr;
  const char* best = nullptr;
  int most = CountKnownWords(head);
  for (const char* encoding : {"CP850",
                               "CP1250",
                               "CP1251",
                               "CP1254",
                               "MACINTOSH",
                               "CP932",
                               "EUC-JP",
                               "GB18030",
                               "BIG5",
                               "CP949"}) {
    const std::optional<Decoded> decoded = Decode(head, encoding);
    if (!decoded || decoded->used < head.size()) continue;
    const int words = CountKnownWords(decoded->text);
    if (words <= most) continue;
    most = words;
    best = encoding;
  }
  return best;
}

}  // namespace

EncodedText TextOfFile(std::string_view bytes, const std::string& name) {
  for (const KnownFormat& format : kFormats) {
    const std::string_view from =
        bytes.substr(std::min(format.at, bytes.size()));
    if (format.in_any_case ? StartsWithIgnoringCase(from, format.start)
                           : from.starts_with(format.start)) {
      throw InputError(PrintablePath(name) + ": this is " +
                       std::string(format.what));
    }
  }
  const char* const utf16 = Utf16Of(bytes);
  const char* const encoding =
      utf16 != nullptr ? utf16 : EncodingByWords(bytes);
  if (encoding == nullptr) return {};
  std::optional<Decoded> decoded = Decode(bytes, encoding);
  if (!decoded || decoded->used < bytes.size()) {
    const std::size_t at = decoded ? decoded->used : 0;
    throw InputError(PrintablePath(name) + ": " +
                     (utf16 != nullptr ? "UTF-16" : encoding) +
                     " that breaks off at byte " + std::to_string(at) +
                     "; save it as CSV in UTF-8");
  }
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (decoded->text.starts_with(kMark)) decoded->text.erase(0, kMark.size());
  return {.text = std::move(decoded->text),
          .encoding = utf16 != nullptr ? "" : encoding};
}

}  // namespace errmap::data
