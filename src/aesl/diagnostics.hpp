// What the compiler says. Each sentence is worded once, in diagnostics.def; the phases report an
// entry of that list, a place and the words to fill in.
//
//     diagnostics.report(Diag::UnknownVariable, mark, {"speed"});
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/compile.hpp"

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

// A range of the text; all zero for an error without position.
struct Mark {
    Position at;
    Position end;
};

// Collects what one run finds, in the order in which it is found.
class Diagnostics {
public:
    void report(Diag what, Mark mark, std::initializer_list<std::string_view> words = {});

    // Errors so far, also those beyond kErrorsMax, which are counted only.
    size_t errors_found() const { return errors_found_; }
    bool full() const;

    // The first error found, then the others by position; warnings by position.
    std::vector<Diagnostic> take_errors();
    std::vector<Diagnostic> take_warnings();

private:
    std::vector<Diagnostic> errors_;
    std::vector<Diagnostic> warnings_;
    size_t errors_found_ = 0;
};

// "1 word", "3 words".
std::string words_of(int64_t count);

}  // namespace vagus::aesl
