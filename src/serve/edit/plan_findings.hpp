// What the checker says of plans, as findings whose fixes are edits of documents.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plan/check.hpp"
#include "serve/edit/doc_finding.hpp"
#include "session/bus_names.hpp"

namespace vagus::serve {

// Of plans without an error: templates that others hide, events that nobody declares.
void add_warnings(const plan::Checked& checked, const std::optional<session::BusNames>& names,
                  plan::Findings& findings);

using TextOf = std::function<Result<std::string>(const std::string& file)>;
std::vector<DocFinding> plan_findings(const plan::Findings& findings, const TextOf& text_of);

}  // namespace vagus::serve
