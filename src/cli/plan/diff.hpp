// `vagus plan diff`.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

void add_plan_diff(CLI::App& plan, int& exit_code);

}  // namespace vagus::cli
