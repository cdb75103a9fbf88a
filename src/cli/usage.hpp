// Wrong command lines: one sentence that says what is wrong, one that says how to go on.
#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace vagus::cli {

// For a person, with a final newline. `app` is the whole program after a failed parse.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error);

// Before parsing, when all verbs are there: an option is never the value of another.
void refuse_options_as_values(CLI::App& app);

// The command line names no verb.
std::string no_verb_error();

}  // namespace vagus::cli
