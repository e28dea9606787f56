#pragma once

#include <string>
#include <vector>

#include "data/measurements/builders/idle_inputs.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// Remarks on a data set under construction, and the inputs left out of it
/// (PreparedDataset has the same members).
class DatasetRemarks {
 public:
  /// `selection` must outlive this.
  explicit DatasetRemarks(const DatasetSelection& selection)
      : selection_(selection) {}

  std::vector<DroppedColumn> dropped;
  std::vector<std::string> remarks;
  std::vector<std::string> doubts;

  /// True if the user asked for this input.
  bool IsNamed(const std::string& input) const;
  void Add(std::vector<std::string> more);
  /// Leaves an input out, with a remark that ends with `behind`. If the user
  /// asked for the input, the remark is also a doubt. Inputs left out in
  /// succession for the same reason share a remark.
  void LeaveOut(const std::string& input,
                const std::string& why,
                const std::string& behind);
  /// Leaves out an input that the user has not named but may name.
  void LeaveOutUnlessNamed(const std::string& input, const std::string& why);
  /// Remarks on an idle input, and leaves a dead one out unless `keep_dead`.
  void ReportIdle(const std::string& input, const IdleInput& idle);

 private:
  void RemarkOnLeftOut(const std::string& name, const std::string& what);

  const DatasetSelection& selection_;
  struct {
    std::string what;
    std::vector<std::string> names;
    std::string remark;
  } shared_;  // the remark on those left out last
};

}  // namespace errmap::data
