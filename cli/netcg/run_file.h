#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "stats/eigen.h"

namespace errmap::netcg {

/// The eight files that a run names, in the order of the run file.
enum class NetcgFile {
  kReport,          // run output
  kPatterns,        // read
  kInitialWeights,  // read where the seed is 0
  kFinalWeights,    // written by a training run
  kErrorCurve,      // graphics: error of each iteration
  kFirstLayer,      // graphics: weights input to hidden
  kSecondLayer,     // graphics: weights hidden to output
  kResiduals,       // graphics: errors after the fit
};
inline constexpr std::size_t kNumNetcgFiles = 8;

/// Returns a description of a file for messages: "pattern file".
std::string_view NameOf(NetcgFile file);

/// One run of a run specification file ("netcg.in" of NISTIR 5367, Appendix A;
/// the program's names in brackets).
struct NetcgSpecification {
  std::string title;
  std::array<std::string, kNumNetcgFiles> files;  // as written
  Index patterns = 0;                             // npats
  Index inputs = 0;                               // ninp
  Index hidden = 0;                               // nhid
  Index outputs = 0;                              // nout
  double wfactor = 0.0;                           // at least 0
  std::int64_t seed = 0;  // nseed: above 0 draws the weights, else reads them
  std::int64_t iterations = 0;  // niter: 0 or less is a testing run
  double egoal = 0.0;
  double gwgoal = 0.0;
  std::int64_t nfreq = 1;
  double errdel = 1.0;
  /// idatfl: flags of the columns of the pattern file that are inputs. Columns
  /// beyond the program's 41 are inputs, too.
  std::vector<bool> uses_column;

  /// Lines of the run file, for messages.
  std::array<std::size_t, kNumNetcgFiles> file_lines = {};
  std::size_t network_line = 0;
  std::size_t flags_line = 0;

  const std::string& file(NetcgFile which) const {
    return files[static_cast<std::size_t>(which)];
  }
  std::size_t line_of(NetcgFile which) const {
    return file_lines[static_cast<std::size_t>(which)];
  }
  bool is_training() const { return iterations > 0; }
  bool draws_weights() const { return seed > 0; }
  Index num_weights1() const { return hidden * (inputs + 1); }
  Index num_weights2() const { return outputs * (hidden + 1); }
  Index num_weights() const { return num_weights1() + num_weights2(); }
};

/// Reads the runs of a run file. The original program closed its file inside
/// the loop over runs, so it could do only one. Throws InputError naming
/// `name`, the line, and what was expected and found.
std::vector<NetcgSpecification> ParseRunFile(std::string_view text,
                                             const std::string& name);

/// Returns the text of a run file from which the same runs can be read.
std::string RunFileText(const std::vector<NetcgSpecification>& runs);

}  // namespace errmap::netcg
