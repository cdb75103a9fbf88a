// How `vagus toolbox` shows templates, to people and to programs (docs/formats.md, "Outputs").
#pragma once

#include <string>
#include <vector>

#include "plan/template.hpp"

namespace vagus::cli {

// A toolbox and those of its templates that are to be shown.
struct ShownToolbox {
    const plan::Toolbox* toolbox;
    std::vector<const plan::Template*> templates;
};

// One line for each template.
std::string list_text(const std::vector<ShownToolbox>& shown);
// All that each template declares.
std::string show_text(const std::vector<ShownToolbox>& shown);

enum class Detail { Names, All };
std::string toolboxes_json(const std::vector<ShownToolbox>& shown, Detail detail);

}  // namespace vagus::cli
