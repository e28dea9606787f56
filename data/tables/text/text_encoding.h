#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// The text of a file in another encoding, converted to UTF-8.
struct EncodedText {
  std::string text;           // "": it is UTF-8, or Windows 1252
  std::string encoding = {};  // to be told; "" where the file itself says it
};

/// Recognises UTF-16 by its byte order mark or by the NULs among its first
/// characters. Other text that is not UTF-8 gets the encoding in which most
/// words of its first lines are common in tables. Tried are DOS, eastern
/// European, Cyrillic, Japanese, Chinese and Korean encodings. `name` stands
/// for the file in messages. Throws InputError, with a remedy, if the text is
/// cut off. Also if the file is not text but is often mistaken for a table (a
/// spreadsheet, an archive, a page).
EncodedText TextOfFile(std::string_view bytes, const std::string& name);

}  // namespace errmap::data
