// What is wrong with a project before anything of it runs: its files by the checks that pages show
// as they are typed, its scripts compiled for the nodes that are there.
#pragma once

#include <filesystem>
#include <vector>

#include "serve/edit/doc_finding.hpp"
#include "serve/script/scripts.hpp"

namespace vagus::serve {

std::vector<DocFinding> check_project(const std::filesystem::path& folder,
                                      const Scripts::TargetOf& target_of);

}  // namespace vagus::serve
