// What the compiler says of a script, as findings whose fixes are edits of documents.
#pragma once

#include <string>
#include <vector>

#include "serve/edit/doc_finding.hpp"
#include "serve/script/scripts.hpp"

namespace vagus::serve {

// `file` is the text of the file around the script: events that a fix declares go there. Empty: it
// cannot be changed now.
std::vector<DocFinding> findings_of_script(const ScriptPart& part, const CompiledScript& script,
                                           const std::string& file);

}  // namespace vagus::serve
