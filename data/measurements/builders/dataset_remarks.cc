#include "data/measurements/builders/dataset_remarks.h"

#include <algorithm>
#include <iterator>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::data {

bool DatasetRemarks::IsNamed(const std::string& input) const {
  return std::ranges::find(selection_.inputs, input) != selection_.inputs.end();
}

void DatasetRemarks::Add(std::vector<std::string> more) {
  std::ranges::move(more, std::back_inserter(remarks));
}

void DatasetRemarks::LeaveOut(const std::string& input,
                              const std::string& why,
                              const std::string& behind) {
  dropped.push_back({.column = input, .why = why});
  const std::string what = why + " and is left out" + behind;
  RemarkOnLeftOut(NameInRemark(input), what);
  if (!IsNamed(input)) return;
  doubts.push_back("The input " + NameInRemark(input) + ", asked for by " +
                   ArgumentName("inputs") + ", " + what + ".");
}

void DatasetRemarks::RemarkOnLeftOut(const std::string& name,
                                     const std::string& what) {
  const bool again = what == shared_.what && !remarks.empty() &&
                     remarks.back() == shared_.remark;
  if (again) {
    remarks.pop_back();
  } else {
    shared_ = {.what = what, .names = {}, .remark = ""};
  }
  shared_.names.push_back(name);
  shared_.remark =
      again ? "inputs " + JoinWords(shared_.names, ", ") + ": each " + what
            : "input " + name + " " + what;
  remarks.push_back(shared_.remark);
}

void DatasetRemarks::LeaveOutUnlessNamed(const std::string& input,
                                         const std::string& why) {
  LeaveOut(input, why, "; name it in " + ArgumentName("inputs") + " to use it");
}

void DatasetRemarks::ReportIdle(const std::string& input,
                                const IdleInput& idle) {
  if (!idle.dead) {
    remarks.push_back("input " + NameInRemark(input) + " is " + idle.how +
                      " and is kept: its effect depends on the others");
    return;
  }
  const std::string why = "is dead (" + idle.how + ")";
  if (selection_.keep_dead) {
    remarks.push_back("input " + NameInRemark(input) + " " + why +
                      " and is kept");
    return;
  }
  LeaveOut(input, why, "; " + ArgumentName("keep_dead") + " keeps it");
}

}  // namespace errmap::data
