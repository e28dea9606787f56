#include "data/tables/cells/missing_cells.h"

#include "data/text.h"

namespace errmap::data {

bool IsMissingText(std::string_view text) {
  return text.empty() || IsOneOf(text, "na nan n/a #n/a #na #nv null (null)");
}

bool IsMissingNumber(std::string_view text) {
  // A dash, or any number of them.
  return IsMissingText(text) || text.find_first_not_of('-') == text.npos ||
         EqualsIgnoringCase(text, "no reading") ||
         IsOneOf(text,
                 "? . none nil missing -nan nan(ind) -nan(ind) 1.#qnan "
                 "-1.#ind 1.#ind #value! #div/0! #num! #ref! #name? #null! "
                 "open ol -ol +ol o.l. over overload overflow overrange "
                 "underflow err fault nc n.c.");
}

}  // namespace errmap::data
