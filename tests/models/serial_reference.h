#pragma once

// tests/golden/normality/serial_reference.csv: what R gives.

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "tests/places.h"

namespace errmap {

/// Statistics of one sample by name.
inline const std::map<std::string, double>& SerialReference(
    const std::string& sample) {
  static const auto reference = [] {
    std::map<std::string, std::map<std::string, double>> read;
    std::ifstream file(tests::TestDir() +
                       "/golden/normality/serial_reference.csv");
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream cells(line);
      std::string name;
      std::string statistic;
      std::string value;
      std::getline(cells, name, ',');
      std::getline(cells, statistic, ',');
      std::getline(cells, value, ',');
      read[name][statistic] = std::strtod(value.c_str(), nullptr);
    }
    return read;
  }();
  return reference.at(sample);
}

}  // namespace errmap
