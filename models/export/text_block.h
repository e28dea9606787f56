#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"

namespace errmap::models {

/// The forms in which controllers take structured text.
enum class TextForm {
  kStandard,  // IEC 61131-3, as matiec, CODESYS and TwinCAT read it
  kScl,       // Siemens: a source file of TIA Portal
  kPlcOpen,   // XML that PLCopen calls TC6, version 2.01
};

/// A variable of a block.
struct TextVariable {
  enum class Type { kReal, kBool, kInt };

  std::string name;
  Type type = Type::kReal;
  int size = 0;                      // of an array from 0; 0: a single one
  std::vector<double> initial = {};  // none: the language's own
  std::string comment = {};
};

struct TextSection {
  enum class Kind { kInput, kOutput, kLocal, kRetained };

  Kind kind = Kind::kLocal;
  std::vector<TextVariable> variables;
};

/// Of one real number, as an expression or as statements.
struct TextFunction {
  std::string name;
  std::string argument;
  std::string comment;
  std::string body;
};

/// A function block and what it calls, before it has a form. Bodies are of the
/// form already: SCL marks what is local.
struct TextBlock {
  std::string name;
  Precision precision = Precision::kDouble;
  Lines about;
  std::vector<TextFunction> functions;
  std::vector<TextSection> sections;
  std::string body;
};

/// The file of a block: NAME.st, NAME.scl or NAME.xml, where `name` is the
/// map's.
ExportedFile TextFile(const TextBlock& block,
                      const std::string& name,
                      TextForm form);

}  // namespace errmap::models
