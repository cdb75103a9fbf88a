// What the compiler says. Each sentence is worded once, in diagnostics.def; the phases report an
// entry of that list, a place and the words to fill in.
//
//     diagnostics.report(Diag::UnknownVariable, mark, {"speed"});
//     diagnostics.report(Diag::UnknownVariableGuess, mark, {"sped", "speed"}, {.fix = fix});
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"

namespace vagus::aesl {

enum class Diag : uint8_t {
#define DIAGNOSTIC(name, code, number, wording) name,
#include "aesl/diagnostics.def"
#undef DIAGNOSTIC
};

// One entry of the registry.
struct CatalogueEntry {
    std::string_view name;
    std::string_view code;
    int number = 0;
    std::string_view wording;
    bool is_warning() const { return code.starts_with("W_"); }
};

// The whole registry, in its order: index by Diag.
std::span<const CatalogueEntry> catalogue();

// The table docs/diagnostics.md.
std::string catalogue_page();

// What a report may carry beside its words.
struct Extra {
    std::optional<Fix> fix = std::nullopt;
    std::optional<Position> formal = std::nullopt;  // see Diagnostic::formal
};

// Collects what one run finds, in the order in which it is found.
class Diagnostics {
public:
    explicit Diagnostics(int first_line = 1) : first_line_(first_line) {}

    void report(Diag what, Mark mark, std::initializer_list<std::string_view> words = {},
                Extra extra = {});

    // How many words the event has that the fix of an error declares: known only behind it. `error`
    // is errors_found() before it was reported.
    void set_declared(size_t error, uint16_t words);

    // A line of the script in the words of a sentence: as the file counts it (Options::first_line).
    std::string line_text(int line) const { return std::to_string(line + first_line_ - 1); }

    // Errors so far, also those beyond kErrorsMax, which are counted only.
    size_t errors_found() const { return errors_found_; }
    bool full() const;

    // By position. Where the error that was found first has gone is what first_of() says, which
    // must be asked before.
    std::vector<Diagnostic> take_errors();
    std::vector<Diagnostic> take_warnings();
    size_t first_of() const;

private:
    std::vector<Diagnostic> errors_;
    std::vector<Diagnostic> warnings_;
    size_t errors_found_ = 0;
    int first_line_;
};

// "1 word", "3 words".
std::string words_of(int64_t count);

}  // namespace vagus::aesl
