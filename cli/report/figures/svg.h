#pragma once

#include <string>
#include <string_view>

#include "cli/report/plot.h"

namespace errmap::report {

/// Draws the plot as SVG for use within a page (SvgFile: alone): flat shapes
/// and text, coordinates to 0.1 px, equal marks in one path. All text is
/// escaped. `title` and `description` serve blind readers; their ids begin with
/// the plot's name. Texts, lines and paper have the classes "words", "frame",
/// "grid" and "paper", so that a page's style can set their colours. Draws as
/// many tics as fit. Throws std::invalid_argument if a series lacks columns
/// that it needs.
std::string Svg(const Plot& plot,
                std::string_view title,
                std::string_view description);

/// Makes a standalone file from the result of Svg.
std::string SvgFile(std::string_view svg);

}  // namespace errmap::report
