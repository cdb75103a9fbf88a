// `vagus plan generate`: a plan as a C++ program (docs/plans.md, section 9).
#pragma once

namespace CLI {
class App;
}  // namespace CLI

namespace vagus::cli {

void add_plan_generate(CLI::App& plan, int& exit_code);

}  // namespace vagus::cli
