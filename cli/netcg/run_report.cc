#include <array>

#include "cli/netcg/netcg_files.h"
#include "data/argument_name.h"
#include "data/formats/fortran_format.h"

namespace errmap::netcg {
namespace {

using data::Edit1PE;
using data::EditF;
using data::EditG;
using data::EditI;
std::string Blanks(int n) {
  return std::string(static_cast<std::size_t>(n), ' ');
}

// A text in a field of that many columns, left-aligned.
std::string Padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

constexpr std::size_t kTitleWidth = 80;
constexpr std::size_t kFileNameWidth = 40;
constexpr const char* kGap = "\n\n\n";
constexpr const char* kSmallGap = "\n\n";
constexpr const char* kNewPage = "1\n";

std::string Rule() { return " " + std::string(kTitleWidth, '*') + "\n"; }

std::string FileName(const std::string& name) {
  return Padded(name, kFileNameWidth) + "\n";
}

std::string Heading(int indent, const std::string& title) {
  return Blanks(indent) + title + "\n" + kGap + Rule() + kGap;
}

std::string Opening(const NetcgSpecification& run) {
  const std::string title =
      Padded(run.title.substr(0, kTitleWidth), kTitleWidth);
  return Blanks(22) + "NEURAL NET RUN REPORT\n" + Rule() + " " + title + "\n" +
         Rule() + kGap + Heading(36, "DATA SET") + " \n" +
         (run.is_training() ? " Training on " : " Testing on  ") +
         FileName(run.file(NetcgFile::kPatterns)) + kGap +
         " The number of data patterns is " + EditI(run.patterns, 6) + "\n" +
         kGap + Rule() + kGap;
}

std::string Network(const NetcgSpecification& run) {
  return Heading(29, "NETWORK SPECIFICATION") + Blanks(12) + "INPUT NODES" +
         Blanks(11) + "HIDDEN NODES" + Blanks(11) + "OUTPUT NODES\n" +
         kSmallGap + Blanks(15) + EditI(run.inputs, 2) + Blanks(22) +
         EditI(run.hidden, 2) + Blanks(22) + EditI(run.outputs, 2) + "\n" +
         kSmallGap + Blanks(8) + "WEIGHTS (I TO H)" + Blanks(8) +
         "WEIGHTS (H TO O)" + Blanks(9) + "TOTAL WEIGHTS\n" + kSmallGap +
         Blanks(14) + EditI(run.num_weights1(), 4) + Blanks(20) +
         EditI(run.num_weights2(), 4) + Blanks(19) +
         EditI(run.num_weights(), 4) + "\n" + kGap + Rule() + kGap;
}

std::string Parameters(const NetcgSpecification& run) {
  return Heading(33, "RUN PARAMETERS") +
         (run.draws_weights()
              ? " Random initial weights, seed " + EditI(run.seed, 10) + "\n"
              : " Initial weights from file  " +
                    FileName(run.file(NetcgFile::kInitialWeights))) +
         " Regularization factor wfactor = " + Edit1PE(run.wfactor, 12, 3) +
         "\n";
}

std::string Criteria(const NetcgSpecification& run) {
  return kNewPage + Rule() + kGap + Heading(28, "RUN TERMINATION CRITERIA") +
         " Maximum number of iterations is " + EditI(run.iterations, 6) +
         "\n Error checking frequency is every " + EditI(run.nfreq, 3) +
         " iterations\n Run is terminated on either max iterations or\n"
         " one of the criteria below.\n RMS error <= " +
         EditG(run.egoal, 12, 3) +
         "\n (RMS of g) <= " + EditG(run.gwgoal, 12, 3) +
         " * (RMS of w)\n (RMS err) > " + EditG(run.errdel, 12, 3) +
         " * (RMS err " + EditI(run.nfreq, 4) +
         " iterations ago)\n max iterations = " + EditI(run.iterations, 6) +
         " # of weights = " + EditI(run.num_weights(), 6) + "\n";
}

std::string TwoNumbers(double a, double b) {
  return Blanks(9) + EditG(a, 15, 7) + Blanks(25) + EditG(b, 15, 7) + "\n";
}

std::string Results(const NetcgFigures& figures) {
  std::string text =
      kNewPage + Rule() + kGap + Heading(35, "RUN RESULTS") + kSmallGap +
      Blanks(28) + "R-SQ of nonlinear fit = " + EditG(figures.r2, 15, 7) +
      "\n" + kSmallGap + Blanks(28) + "Pointwise Error\n" + kSmallGap +
      Blanks(15) + "Mean" + Blanks(27) + "Standard Deviation\n" +
      TwoNumbers(figures.mean, figures.sd) + kSmallGap + Blanks(14) +
      "Minimum" + Blanks(32) + "Maximum\n" +
      TwoNumbers(figures.min, figures.max) + kSmallGap +
      "        Data       Output       Desired       Predicted"
      "       Absolute\n"
      "        Index       Node        Output        Output"
      "          Error\n";
  for (Index p = 0; p < figures.errors.rows(); ++p) {
    for (Index j = 0; j < figures.errors.cols(); ++j) {
      text += Blanks(8) + EditI(p + 1, 4) + Blanks(8) + EditI(j + 1, 4) +
              Blanks(5) + EditG(figures.desired(p, j), 12, 4) + " " +
              EditG(figures.predicted(p, j), 12, 4) + Blanks(7) +
              EditG(figures.errors(p, j), 12, 4) + "\n";
    }
  }
  return text;
}

std::string KolmogorovSmirnov(const NetcgFigures& figures,
                              NetcgStatistics statistics) {
  return " Kolmogorov-Smirnov distance statistic = " +
         EditG(figures.ks_d, 15, 7) +
         "\n Kolmogorov-Smirnov significance value = " +
         EditG(figures.ks_p, 15, 7) +
         (statistics == NetcgStatistics::kCorrected
              ? " (Lilliefors: mean and sd estimated)"
              : "") +
         "\n";
}

std::string Ending(const NetcgSpecification& run, const NetcgResult& result) {
  return " Iter" + EditI(result.iterations, 6) + "; ierr " +
         EditI(result.ierr, 1) + " : " + EndingOf(result.ierr) + "\n Used" +
         EditI(result.iterations, 6) + " iterations; " +
         EditI(result.function_calls, 6) + " function calls; Err " +
         EditF(result.error, 6, 3) + "; |g|/|w| " +
         Edit1PE(result.gradient_ratio, 9, 3) + "\n Rms change in weights" +
         EditF(result.weight_change, 6, 3) + "\n Weights written to file " +
         FileName(run.file(NetcgFile::kFinalWeights));
}

std::string WhatTheyAre(const NetcgResult& result, NetcgStatistics statistics) {
  if (statistics == NetcgStatistics::kAsPrinted) {
    return " Statistics as the program of 1995 prints them; \"errmap netcg " +
           data::ArgumentName("help") + "\" names its errata\n";
  }
  std::string text =
      " Corrected: divisors n and n - 1, R-SQ = 1 - SSE/SST, scale factor "
      "applied\n";
  if (result.corrected_scaling == NetcgScaling::kTestFile) {
    text +=
        " The training run's scaling is not known: targets are scaled by the "
        "test file's own range\n";
  }
  return text;
}

}  // namespace

std::string EndingOf(int ierr) {
  static constexpr std::array kEndings = {"achieved error goal",
                                          "iteration limit",
                                          "gradient small",
                                          "slow convergence of error"};
  return kEndings.at(static_cast<std::size_t>(ierr));
}

std::string RunReport(const NetcgSpecification& specification,
                      const NetcgResult& result,
                      NetcgStatistics statistics) {
  const NetcgFigures& figures = statistics == NetcgStatistics::kCorrected
                                    ? result.corrected
                                    : result.printed;
  std::string text = Opening(specification) + Network(specification) +
                     Parameters(specification);
  if (specification.is_training()) text += Criteria(specification);
  text += Results(figures) + KolmogorovSmirnov(figures, statistics);
  if (specification.is_training()) text += Ending(specification, result);
  return text + WhatTheyAre(result, statistics);
}

std::string ErrorCurveGraph(const NetcgResult& result,
                            NetcgPrecision precision) {
  if (result.function_calls == 0) return "";  // of a testing run
  constexpr long long kColumns = 2;
  std::string text =
      data::ListDirected(static_cast<long long>(result.iterations)) +
      data::ListDirected(kColumns) + "\n";
  long long k = 0;
  for (const double error : result.error_curve) {
    text += data::ListDirected(++k) +
            (precision == NetcgPrecision::kSingle
                 ? data::ListDirected(static_cast<float>(error))
                 : data::ListDirected(error)) +
            "\n";
  }
  return text;
}

std::string ResidualGraph(const NetcgFigures& figures) {
  std::string text;
  for (const double error : figures.errors.col(0)) {
    text += EditG(error, 12, 4) + "\n";
  }
  return text;
}

std::string NetcgErrata() {
  return "What the program of 1995 gets wrong, and prints without " +
         data::ArgumentName("corrected") +
         ":\n- Sums of n rows and J outputs are divided by (n+1)(J+1) in place "
         "of n J. With one\noutput, means are about half the true ones, and "
         "standard deviations 0.71 of them.\n- So the K-S test standardises "
         "with wrong values. Its p also assumes a given mean\nand standard "
         "deviation, where Lilliefors' test applies.\n- R-SQ is SSreg/SStot "
         "about that wrong mean, not 1 - SSE/SST.\n- A testing run scales by "
         "the range of the test file, not of the training file.\n- The scale "
         "factor of a pattern file is read and never applied.\n- Line k of the "
         "error curve has the error before iteration k. Err is E, not its "
         "root.\n- The run file is closed inside the loop over runs, so a "
         "second run fails.\n- Weights for other numbers of nodes are refused "
         "only if all three numbers differ.\n";
}

}  // namespace errmap::netcg
