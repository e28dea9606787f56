#pragma once

#include <string>
#include <vector>

#include "cli/report/text/answers/component_numbers.h"

namespace errmap::report {

/// One message about the recommended map: "without a map", "11.5 um; 94 %
/// removed".
struct Remark {
  enum class Tone { kPlain, kGood, kBad };
  /// Its place: in the answer itself, among the next steps, or with --details.
  enum class Place { kAnswer, kNextSteps, kDetails };

  std::string label;  // at most 15 characters
  std::string text;   // the figure first, without a full stop
  Tone tone = Tone::kPlain;
  std::string measure = {};  // what measurements would settle it
  Place place = Place::kAnswer;
  bool is_caveat = false;  // bounds the map's worth, or else speaks for it
  bool must_show = false;  // always in the answer
};

/// A remark is a function of the record that returns nothing if it does not
/// apply. To add one, write the function with a test, and list it in remarks.cc
/// (the answer) or further_remarks.cc.
struct RemarkEntry {
  std::vector<Remark> (*make)(const ComponentNumbers& of);
  Remark::Place place;
  bool is_caveat;
};

/// Returns all remarks on the recommended map, most important first. Throws
/// data::InputError if the record lacks a figure.
std::vector<Remark> RemarksOf(const ComponentNumbers& component);

/// "Without a map: 11.5 um; 94 % removed."
std::string SentenceOf(const Remark& remark);

}  // namespace errmap::report
