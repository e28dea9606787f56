#include <algorithm>
#include <bit>
#include <cstdint>

#include "models/export/program/run_program.h"
#include "models/version.h"

namespace errmap::models {
namespace {

// FNV-1a of 64 bits.
class Hash {
 public:
  void Add(double number) {
    Add(std::bit_cast<std::uint64_t>(number), sizeof(double));
  }
  void Add(std::uint64_t bits, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i) {
      value_ = (value_ ^ (bits >> (8 * i) & 0xFF)) * 0x100000001B3U;
    }
  }
  void Add(std::string_view text) {
    for (const char c : text) Add(static_cast<unsigned char>(c), 1);
  }
  // From 1 to 2^24.
  double Number() const {
    constexpr int kBits = 24;
    return static_cast<double>(value_ >> (64 - kBits)) + 1.0;
  }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

}  // namespace

double Fingerprint(const MapProgram& program) {
  // The layout of the saved state; change it with the layout.
  constexpr double kLayout = 2.0;
  Hash hash;
  hash.Add(kLayout);
  for (const Instructions* part : program.parts()) {
    for (const Instruction& it : *part) {
      hash.Add(static_cast<std::uint64_t>(it.op), 1);
      for (const Operand& place : {it.to, it.a, it.b}) {
        hash.Add(static_cast<std::uint64_t>(place.space), 1);
        hash.Add(static_cast<std::uint64_t>(place.index), 2);
      }
      hash.Add(it.c);
      hash.Add(it.d);
    }
  }
  for (const MatrixXd& table : program.tables) {
    for (const double number : table.reshaped()) hash.Add(number);
  }
  return hash.Number();
}

double ExportId(const MapProgram& program,
                std::string_view name,
                Precision precision) {
  Hash hash;
  hash.Add(Version());
  hash.Add(name);
  hash.Add(static_cast<std::uint64_t>(precision), 1);
  hash.Add(Fingerprint(program));
  hash.Add(program.limits.max_error);
  hash.Add(program.limits.max_rate);
  for (const ProgramReading& reading : program.readings) {
    hash.Add(reading.column.name);
    for (const ReadingTable& table : kTables) hash.Add(reading.*table.value);
    hash.Add(reading.slope);
  }
  return hash.Number();
}

double LongestAge(const MapProgram& program) {
  constexpr double kHour = 3600.0;
  constexpr double kForEver = 1e9;  // of a map with a zero
  return program.settles_after < kForEver
             ? std::max(program.settles_after, kHour)
             : kHour;
}

}  // namespace errmap::models
