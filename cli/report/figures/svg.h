#pragma once

#include <string>
#include <string_view>

#include "cli/report/plot.h"

namespace errmap::report {

/// The plot as SVG, fit for standing inline in a page (SvgFile: by itself):
/// flat shapes and text, coordinates to 0.1 px, what is alike in one path. All
/// text is escaped. `title` and `description` are for those who do not see
/// it; their ids begin with the plot's name. Texts, lines and paper carry the
/// classes "words", "frame", "grid" and "paper", by which a page's style may
/// give them its own colours. Tics are as many as stand side by side.
/// Throws std::invalid_argument where a series has not the columns it needs.
std::string Svg(const Plot& plot,
                std::string_view title,
                std::string_view description);

/// What Svg draws as a file of its own.
std::string SvgFile(std::string_view svg);

}  // namespace errmap::report
