#pragma once

#include <string>
#include <string_view>

namespace errmap::cli {

/// gnuplot's SVG made fit for standing inline in a page: only lines, areas,
/// points and text are taken over, whatever else there is (prolog, ids, links,
/// scripts, embedded pictures) is left out; coordinates to 0.1 px, points of
/// one kind in one path. `attributes` go into the <svg> tag and `head` (such
/// as <title>) behind it, both as they are. "" where it is no SVG.
std::string CompactSvg(std::string_view svg,
                       std::string_view attributes,
                       std::string_view head);

}  // namespace errmap::cli
