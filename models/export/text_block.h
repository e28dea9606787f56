#pragma once

#include <string>
#include <vector>

#include "models/export/language.h"

namespace errmap::models {

/// The dialects of structured text that controllers accept.
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
  int size = 0;                      // of an array from 0; 0: a scalar
  std::vector<double> initial = {};  // empty: the language's default
  std::string comment = {};
};

struct TextSection {
  enum class Kind { kInput, kOutput, kLocal, kRetained };

  Kind kind = Kind::kLocal;
  std::vector<TextVariable> variables;
};

/// A function of one real number; its body is statements.
struct TextFunction {
  std::string name;
  std::string argument;
  std::string comment;
  std::string body;
};

/// A function block and the functions it calls, before formatting. The bodies
/// are already in the target dialect, since SCL marks local names.
struct TextBlock {
  std::string name;
  Precision precision = Precision::kDouble;
  Lines about;
  std::vector<TextFunction> functions;
  std::vector<TextSection> sections;
  std::string body;
};

/// Returns the file of a block: NAME.st, NAME.scl or NAME.xml, where NAME is
/// the map's `name`.
ExportedFile TextFile(const TextBlock& block,
                      const std::string& name,
                      TextForm form);

}  // namespace errmap::models
