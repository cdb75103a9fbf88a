// Any text as a plan file: findings with a sentence and a line, or a plan that can be run. What can
// be read can be formatted, and formatting twice changes nothing more.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "plan/check.hpp"
#include "plan/file.hpp"
#include "plan/graph.hpp"
#include "plan/template.hpp"

using namespace vagus;

namespace {

plan::Library library() {
    plan::Toolbox core{.name = "core"};
    core.templates = {{.name = "Wait",
                       .inputs = {{.name = "seconds", .type = plan::Type::Float}},
                       .outcomes = {{.name = "Done"}}},
                      {.name = "Assign",
                       .kind = plan::Kind::Computation,
                       .inputs = {{.name = "value", .type = {}}},
                       .outputs = {{.name = "result", .type = {}}},
                       .outcomes = {{.name = "Done"}}},
                      {.name = "Timeout",
                       .kind = plan::Kind::Supervisor,
                       .inputs = {{.name = "seconds", .type = plan::Type::Float}},
                       .outcomes = {{.name = "Timeout"}}}};
    plan::Library made;
    made.add(std::move(core));
    return made;
}

// The same text for the plan and for the first sub-plans that it names: each names them again, by a
// longer path, up to the limit of plans, which would take seconds.
class FewTexts final : public plan::Files {
public:
    explicit FewTexts(std::string_view text) : text_(text) {}
    Result<std::string> read(const std::string& path) const override {
        if (left_ == 0) return Error{Code::NotFound, path};
        --left_;
        return text_;
    }

private:
    std::string text_;
    mutable int left_ = 8;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    static const plan::Library kLibrary = library();
    const plan::Checked checked = plan::check("fuzz.plan.json", FewTexts(text), kLibrary);
    for (const plan::Finding& finding : checked.findings) {
        if (finding.message.empty() || finding.rule.empty() || finding.line < 1) std::abort();
    }
    if (checked.ok()) (void)plan::make_graph(checked);
    const Result<std::string> formatted = plan::format_plan(text, "fuzz.plan.json");
    if (!formatted.ok()) return 0;
    const Result<std::string> again = plan::format_plan(formatted.value(), "fuzz.plan.json");
    if (!again.ok() || again.value() != formatted.value()) std::abort();
    return 0;
}
