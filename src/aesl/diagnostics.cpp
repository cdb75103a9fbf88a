#include "aesl/diagnostics.hpp"

#include <algorithm>
#include <utility>

#include "aesl/limits.hpp"

namespace vagus::aesl {
namespace {

constexpr CatalogueEntry kCatalogue[] = {
#define DIAGNOSTIC(name, code, number, wording) {#name, code, number, wording},
#include "aesl/diagnostics.def"
#undef DIAGNOSTIC
};

// Puts the words in the places {0}, {1}, … of the wording.
std::string fill(std::string_view wording, std::initializer_list<std::string_view> words) {
    std::string sentence;
    for (size_t i = 0; i < wording.size(); ++i) {
        const bool is_place = wording[i] == '{' && i + 2 < wording.size() && wording[i + 2] == '}';
        if (!is_place) {
            sentence += wording[i];
            continue;
        }
        const auto index = static_cast<size_t>(wording[i + 1] - '0');
        if (index < words.size()) sentence += words.begin()[index];
        i += 2;
    }
    return sentence;
}

bool stands_before(const Diagnostic& a, const Diagnostic& b) {
    return a.at < b.at;
}

}  // namespace

std::span<const CatalogueEntry> catalogue() {
    return kCatalogue;
}

std::string catalogue_page() {
    std::string page =
        "# Errors and warnings of the AESL compiler\n\n"
        "Made from `src/aesl/diagnostics.def` by `aesl_catalogue`; a test compares the two.\n\n"
        "| code | no | situation | sentence |\n| --- | ---: | --- | --- |\n";
    for (const CatalogueEntry& entry : kCatalogue) {
        const std::string number = entry.is_warning() ? "" : std::to_string(entry.number);
        page += "| `" + std::string(entry.code) + "` | " + number + " | " +
                std::string(entry.name) + " | " + std::string(entry.wording) + " |\n";
    }
    return page;
}

void Diagnostics::report(Diag what, Mark mark, std::initializer_list<std::string_view> words,
                         Extra extra) {
    const CatalogueEntry& entry = kCatalogue[static_cast<size_t>(what)];
    if (!entry.is_warning()) ++errors_found_;
    std::vector<Diagnostic>& list = entry.is_warning() ? warnings_ : errors_;
    if (list.size() >= (entry.is_warning() ? kWarningsMax : kErrorsMax)) return;
    list.push_back({.code = std::string(entry.code),
                    .number = entry.number,
                    .at = mark.at,
                    .end = mark.end,
                    .message = fill(entry.wording, words),
                    .fix = std::move(extra.fix),
                    .formal = extra.formal});
}

void Diagnostics::set_declared(size_t error, uint16_t words) {
    if (error >= errors_.size() || !errors_[error].fix || !errors_[error].fix->declares) return;
    errors_[error].fix->declares->size = words;
}

bool Diagnostics::full() const {
    return errors_.size() >= kErrorsMax;
}

size_t Diagnostics::first_of() const {
    if (errors_.empty()) return 0;
    const auto goes_before = [&](const Diagnostic& other) {
        return stands_before(other, errors_.front());
    };
    return static_cast<size_t>(std::count_if(errors_.begin(), errors_.end(), goes_before));
}

std::vector<Diagnostic> Diagnostics::take_errors() {
    std::stable_sort(errors_.begin(), errors_.end(), stands_before);
    return std::move(errors_);
}

std::vector<Diagnostic> Diagnostics::take_warnings() {
    std::stable_sort(warnings_.begin(), warnings_.end(), stands_before);
    return std::move(warnings_);
}

std::string words_of(int64_t count) {
    return std::to_string(count) + (count == 1 ? " word" : " words");
}

}  // namespace vagus::aesl
