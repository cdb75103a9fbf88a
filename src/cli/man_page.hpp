// The manual page vagus(1), from the description of the command line; `vagus page man` prints it.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vagus::cli {

std::string man_page(CLI::App& app);

}  // namespace vagus::cli
