#pragma once

#include <string>

namespace errmap::report {

/// Links of a page's first screen to what its words mean, and the place in the
/// same page where that stands, as HTML.
std::string GlossaryLinks();
std::string Glossary();

}  // namespace errmap::report
