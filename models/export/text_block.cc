#include "models/export/text_block.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "models/export/program/safe_names.h"
#include "models/version.h"

namespace errmap::models {
namespace {

using Type = TextVariable::Type;
using Kind = TextSection::Kind;

std::string_view TypeName(Type type, Precision precision) {
  if (type == Type::kBool) return "BOOL";
  if (type == Type::kInt) return "INT";
  return precision == Precision::kSingle ? "REAL" : "LREAL";
}

std::string NumberText(double value, Precision precision) {
  return RealText(value, precision == Precision::kSingle);
}

std::vector<std::string> InitialNumbers(const TextVariable& variable,
                                        Precision precision) {
  std::vector<std::string> numbers;
  for (const double value : variable.initial) {
    numbers.push_back(NumberText(value, precision));
  }
  return numbers;
}

// As IEC 61131-3 and SCL have it.
class TextWriter {
 public:
  TextWriter(const TextBlock& block, TextForm form)
      : block_(block), is_scl_(form == TextForm::kScl) {}

  std::string Write() const {
    std::string text = "(* " + Joined(block_.about, "   ").substr(3) + "*)\n";
    for (const TextFunction& function : block_.functions) {
      text += Function(function);
    }
    text += fmt::format("\nFUNCTION_BLOCK {}\n{}", Name(block_.name), Header());
    for (const TextSection& section : block_.sections) text += Section(section);
    return text + Begin() + block_.body + "END_FUNCTION_BLOCK\n";
  }

 private:
  std::string Name(const std::string& name) const {
    return is_scl_ ? '"' + name + '"' : name;
  }
  std::string Header() const {
    return is_scl_ ? "{ S7_Optimized_Access := 'TRUE' }\nVERSION : 0.1\n" : "";
  }
  std::string Begin() const { return is_scl_ ? "BEGIN\n" : "\n"; }

  std::string Function(const TextFunction& function) const {
    const std::string_view real = TypeName(Type::kReal, block_.precision);
    return fmt::format(
        "\nFUNCTION {} : {}\n{}{}VAR_INPUT\n  {} : {};\nEND_VAR\n{}{}"
        "END_FUNCTION\n",
        Name(function.name),
        real,
        Header(),
        function.comment.empty() ? "" : "(* " + function.comment + " *)\n",
        function.argument,
        real,
        is_scl_ ? "BEGIN\n" : "",
        function.body);
  }

  std::string Section(const TextSection& section) const {
    static constexpr const char* kKeywords[] = {
        "VAR_INPUT", "VAR_OUTPUT", "VAR", "VAR RETAIN"};
    std::string text = kKeywords[static_cast<std::size_t>(section.kind)];
    text += '\n';
    for (const TextVariable& variable : section.variables) {
      text += Variable(variable);
    }
    return text + "END_VAR\n";
  }

  std::string Variable(const TextVariable& variable) const {
    const std::string_view type = TypeName(variable.type, block_.precision);
    std::string text = "  " + variable.name + " : ";
    text += variable.size > 0
                ? fmt::format("ARRAY[0..{}] OF {}", variable.size - 1, type)
                : type;
    const auto numbers = InitialNumbers(variable, block_.precision);
    if (variable.size > 0 && !numbers.empty()) {
      text += " := [\n" + Joined(Wrapped(numbers, "    "), "");
      text.back() = ']';
    } else if (!numbers.empty()) {
      text += " := " + numbers.front();
    }
    text += ';';
    if (!variable.comment.empty()) text += " (* " + variable.comment + " *)";
    return text + '\n';
  }

  const TextBlock& block_;
  bool is_scl_;
};

// Of an attribute or an element.
std::string XmlText(std::string_view text) {
  static constexpr std::pair<char, const char*> kEntities[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string escaped;
  for (const char c : text) {
    const auto* entity =
        std::ranges::find(kEntities, c, &std::pair<char, const char*>::first);
    escaped +=
        entity == std::end(kEntities) ? std::string(1, c) : entity->second;
  }
  return escaped;
}

std::string Documentation(const std::string& text) {
  if (text.empty()) return "";
  return fmt::format("<documentation><xhtml:p>{}</xhtml:p></documentation>",
                     XmlText(text));
}

class XmlWriter {
 public:
  explicit XmlWriter(const TextBlock& block) : block_(block) {}

  // The creation of a file is no news of it, but the schema wants a time.
  std::string Write() const {
    std::string text = fmt::format(
        R"(<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml">
<fileHeader companyName="errmap" productName="errmap" productVersion="{}" creationDateTime="2026-01-01T00:00:00"/>
<contentHeader name="{}">
<coordinateInfo>
<fbd><scaling x="1" y="1"/></fbd><ld><scaling x="1" y="1"/></ld><sfc><scaling x="1" y="1"/></sfc>
</coordinateInfo>
</contentHeader>
<types>
<dataTypes/>
<pous>
)",
        Version(),
        block_.name);
    const std::string real =
        "<" + std::string(TypeName(Type::kReal, block_.precision)) + "/>";
    for (const TextFunction& function : block_.functions) {
      text += fmt::format(
          "<pou name=\"{}\" pouType=\"function\">\n<interface>\n"
          "<returnType>{}</returnType>\n<inputVars>\n"
          "<variable name=\"{}\"><type>{}</type></variable>\n</inputVars>\n"
          "</interface>\n{}{}</pou>\n",
          function.name,
          real,
          function.argument,
          real,
          Body(function.body),
          Documentation(function.comment));
    }
    text += fmt::format(
        "<pou name=\"{}\" pouType=\"functionBlock\">\n<interface>\n",
        block_.name);
    for (const TextSection& section : block_.sections) text += Section(section);
    return text + "</interface>\n" + Body(block_.body) +
           Documentation(Joined(block_.about, "")) +
           "</pou>\n</pous>\n</types>\n<instances><configurations/></instances>"
           "\n</project>\n";
  }

 private:
  static std::string Body(const std::string& text) {
    return fmt::format("<body><ST><xhtml:p>{}</xhtml:p></ST></body>\n",
                       XmlText(text));
  }

  std::string Section(const TextSection& section) const {
    const char* tag = section.kind == Kind::kInput    ? "inputVars"
                      : section.kind == Kind::kOutput ? "outputVars"
                                                      : "localVars";
    std::string text =
        fmt::format("<{}{}>\n",
                    tag,
                    section.kind == Kind::kRetained ? " retain=\"true\"" : "");
    for (const TextVariable& variable : section.variables) {
      text += Variable(variable);
    }
    return text + fmt::format("</{}>\n", tag);
  }

  std::string Variable(const TextVariable& variable) const {
    std::string type =
        fmt::format("<{}/>", TypeName(variable.type, block_.precision));
    if (variable.size > 0) {
      type = fmt::format(
          "<array><dimension lower=\"0\" upper=\"{}\"/><baseType>{}</baseType>"
          "</array>",
          variable.size - 1,
          type);
    }
    std::string values;
    for (const std::string& number :
         InitialNumbers(variable, block_.precision)) {
      const std::string value =
          fmt::format("<simpleValue value=\"{}\"/>", number);
      values += variable.size > 0 ? "<value>" + value + "</value>\n" : value;
    }
    if (variable.size > 0 && !values.empty()) {
      values = "<arrayValue>\n" + values + "</arrayValue>";
    }
    if (!values.empty()) values = "<initialValue>" + values + "</initialValue>";
    return fmt::format("<variable name=\"{}\"><type>{}</type>{}{}</variable>\n",
                       variable.name,
                       type,
                       values,
                       Documentation(variable.comment));
  }

  const TextBlock& block_;
};

}  // namespace

ExportedFile TextFile(const TextBlock& block,
                      const std::string& name,
                      TextForm form) {
  if (form == TextForm::kPlcOpen) {
    return {name + ".xml", XmlWriter(block).Write()};
  }
  return {name + (form == TextForm::kScl ? ".scl" : ".st"),
          TextWriter(block, form).Write()};
}

}  // namespace errmap::models
