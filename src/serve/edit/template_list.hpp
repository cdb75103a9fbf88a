// What plans can be made of, as pages are told it: the templates of each toolbox, the words of
// formulas.
#pragma once

#include <nlohmann/json.hpp>

#include "plan/template.hpp"

namespace vagus::serve {

// The topic "templates". `of`: what a loaded project knows; toolboxes in the order of the library.
nlohmann::json template_list(const plan::Library& of);

}  // namespace vagus::serve
