#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// Walks through XML in UTF-8: tags and texts one after another, in memory that
/// does not grow with depth. Knows the five named characters and those by
/// number; a DOCTYPE, and so any entity of its own, is refused. Names come
/// without the prefix of their namespace.
class XmlScanner {
 public:
  enum class Kind { kOpen, kClose, kText, kEnd };

  /// `text` must outlive it.
  explicit XmlScanner(std::string_view text);

  /// Goes to the next tag or text; `<a/>` opens and closes. Throws InputError
  /// where the text breaks off or is none of XML.
  Kind Next();

  /// Of the tag.
  std::string_view name() const { return name_; }
  bool Opens(std::string_view name) const {
    return kind_ == Kind::kOpen && name_ == name;
  }
  bool Closes(std::string_view name) const {
    return kind_ == Kind::kClose && name_ == name;
  }
  /// Of the opening tag, "" where it has none.
  std::string Attribute(std::string_view name) const;
  /// Of the text, its characters decoded.
  std::string Text() const;

 private:
  std::string_view TakeUntil(std::string_view mark);

  std::string_view rest_;
  Kind kind_ = Kind::kText;
  bool closes_at_once_ = false;
  bool is_literal_ = false;  // CDATA
  std::string_view name_;
  std::string_view attributes_;
  std::string_view text_;
};

}  // namespace errmap::data
