// Any text as a message of a page: refused with a sentence, or a command that fits the protocol.
// What such commands do to texts is done, too: changes give what a plain string of UTF-16 units
// gives, patches of JSON files leave JSON, expressions end within their steps.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "serve/edit/json_patch.hpp"
#include "serve/edit/pattern.hpp"
#include "serve/project/text_change.hpp"
#include "serve/protocol/protocol.hpp"

using namespace vagus;

namespace {

using Wire = nlohmann::json;

constexpr std::string_view kText = "var é = 1\n# 😀 and more\nonevent tick\n";
constexpr std::u16string_view kUnits = u"var é = 1\n# 😀 and more\nonevent tick\n";
constexpr std::string_view kJson =
    "{\n  \"format\": \"vagus-plan/1\",\n  \"a\": { \"b\": [1, 2, { \"c\": null }] },\n  \"\": "
    "0\n}\n";

bool cuts_a_pair(size_t at) {
    return at > 0 && at < kUnits.size() && kUnits[at] >= 0xdc00 && kUnits[at] < 0xe000;
}

// How many bytes of kText these units are.
size_t bytes_between(size_t from, size_t to) {
    size_t bytes = 0;
    for (size_t at = from; at < to; ++at) {
        const char16_t unit = kUnits[at];
        const bool pair = unit >= 0xd800 && unit < 0xe000;
        bytes += unit < 0x80 ? 1 : unit < 0x800 || pair ? 2 : 3;
    }
    return bytes;
}

void edit(const Wire& in) {
    std::vector<serve::TextChange> changes;
    for (const Wire& one : in["changes"]) changes.push_back({one["from"], one["to"], one["text"]});
    const auto done = serve::applied(kText, changes);
    if (changes.size() != 1) return;
    const serve::TextChange& only = changes.front();
    const bool good = only.from <= only.to && only.to <= kUnits.size() && !cuts_a_pair(only.from) &&
                      !cuts_a_pair(only.to);
    if (done.has_value() != good) std::abort();
    if (!good) return;
    const size_t bytes = kText.size() - bytes_between(only.from, only.to) + only.text.size();
    const size_t front = bytes_between(0, only.from);
    const std::string_view back = kText.substr(bytes_between(0, only.to));
    if (done->size() != bytes || !done->starts_with(kText.substr(0, front)) ||
        done->substr(front, only.text.size()) != only.text || !done->ends_with(back)) {
        std::abort();
    }
}

void patch(const Wire& in) {
    const auto steps = serve::read_steps(in["steps"]);
    if (!steps.ok()) return;
    for (const char* language : {"plan", "json"}) {
        const auto done = serve::patched(kJson, {language, "f.json"}, steps.value());
        if (done.ok() && !std::holds_alternative<JsonValue>(read_json(done.value()))) std::abort();
        if (!done.ok() && done.error().what.empty()) std::abort();
    }
}

void search(const Wire& in) {
    const auto made = serve::Pattern::make(
        in["text"].get<std::string>(),
        {.regex = in["regex"], .exact_case = in["case"], .whole = in["whole"]});
    if (!made.ok()) return;
    size_t steps = 100'000;
    size_t from = 0;
    while (const auto match = made.value().find(kText, from, steps)) {
        if (match->from < from || match->to <= match->from || match->to > kText.size()) {
            std::abort();
        }
        (void)made.value().replacement(*match, kText, "$0$1$9$$");
        from = match->to;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view message(reinterpret_cast<const char*>(data), size);
    const auto read = serve::Protocol::get().read(message);
    if (const auto* refusal = std::get_if<serve::Refusal>(&read)) {
        if (refusal->problem.what.empty() || refusal->problem.code.empty()) std::abort();
        return 0;
    }
    if (std::holds_alternative<serve::Pong>(read)) return 0;
    const serve::Request& request = std::get<serve::Request>(read);
    if (request.name == "doc.edit") edit(request.in);
    if (request.name == "doc.patch") patch(request.in);
    if (request.name == "text.search" || request.name == "text.replace") search(request.in);
    return 0;
}
