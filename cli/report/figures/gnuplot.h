#pragma once

#include <string>
#include <string_view>

#include "cli/report/plot.h"

namespace errmap::report {

enum class ImageFormat { kSvg, kPdf, kPng };
/// "svg", "pdf", "png".
std::string_view ToString(ImageFormat format);

/// A text as a gnuplot string that means these characters and nothing else:
/// whatever gnuplot could read as a command, an escape or a substitution is
/// written as an octal escape; line breaks and control characters become
/// blanks. In labels of tics '%' is doubled, since they are formats.
std::string GnuplotString(std::string_view text);
std::string GnuplotTicString(std::string_view text);

/// The plot for papers: a whole gnuplot script with its data, which writes
/// `file` when it is run.
std::string PlotScript(const Plot& plot,
                       ImageFormat format,
                       std::string_view file);

}  // namespace errmap::report
