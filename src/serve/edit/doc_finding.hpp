// A mistake or a remark of any checker, as pages get it: where, what, and how a click fixes it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"
#include "base/diagnostic.hpp"

namespace vagus::serve {

struct TextEdit {
    std::string doc;
    size_t from = 0, to = 0;  // in UTF-16 units
    std::string text;
};

struct FindingFix {
    std::string label;  // of a button
    std::vector<TextEdit> edits;
};

struct DocFinding {
    std::string doc;
    Severity severity = Severity::Error;
    std::string code;     // of the catalogue, or the rule
    std::string element;  // actor, supervisor, variable; may be empty
    aesl::Position at, end;
    std::string what;
    std::vector<FindingFix> fixes;
    // Of a JSON file: keys and indices that lead to what is meant, as in a JsonStep.
    nlohmann::json keys = nlohmann::json::array();
};

// As the protocol has it, within its limits.
nlohmann::json json_of(const DocFinding& finding);
nlohmann::json json_of(aesl::Position at);
// A Place of the protocol.
aesl::Position position_of(const nlohmann::json& place);

// A finding from a sentence that begins with its place, "FILE:LINE:COLUMN: …", where FILE is `doc`;
// what is marked is the word there.
DocFinding finding_of_sentence(const std::string& doc, std::string_view text, Severity severity,
                               const std::string& code, std::string_view sentence);

// The end of the JSON value, key or word that begins at a place.
aesl::Position end_of_word(std::string_view text, aesl::Position at);

}  // namespace vagus::serve
