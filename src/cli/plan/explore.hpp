// `vagus plan explore`.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

void add_plan_explore(CLI::App& plan, int& exit_code);

}  // namespace vagus::cli
