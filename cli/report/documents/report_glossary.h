#pragma once

#include <string>

namespace errmap::report {

/// HTML links from a page's first screen to the meaning of its words, and the
/// section of the page that explains them.
std::string GlossaryLinks();
std::string Glossary();

}  // namespace errmap::report
