#include "serve/edit/plan_desk.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "plan/generate.hpp"
#include "serve/edit/json_patch.hpp"
#include "serve/edit/plan_findings.hpp"
#include "serve/edit/text_places.hpp"
#include "toolbox/builtin.hpp"

namespace vagus::serve {

namespace {

// Of the protocol.
constexpr size_t kShownNameMax = 256;
constexpr size_t kCodeMax = 4 * 1024 * 1024;
constexpr size_t kMarksMax = 20000;

// The plan that a call is about; fails the call if it is none.
std::optional<DocumentView> plan_of(const Call& call, Files& files) {
    const std::string doc = call.in["doc"];
    auto view = files.open(doc);
    if (!view.ok()) {
        call.fail(view.error());
        return std::nullopt;
    }
    if (view.value().language == "plan") return std::move(view.value());
    call.fail("bad_input",
              fmt::format("{} is no plan; name a file that ends with .plan.json", doc));
    return std::nullopt;
}

class OpenFiles final : public plan::Files {
public:
    explicit OpenFiles(serve::Files& files) : files_(files) {}
    Result<std::string> read(const std::string& path) const override { return files_.text(path); }

private:
    serve::Files& files_;
};

nlohmann::json errors_of(const std::vector<DocFinding>& findings) {
    auto list = nlohmann::json::array();
    for (const DocFinding& one : findings) {
        if (one.severity == Severity::Error && list.size() < kFindingsMax) {
            list.push_back(json_of(one));
        }
    }
    return list;
}

plan::OwnToolboxes own_toolboxes(const plan::Library& library) {
    plan::OwnToolboxes own;
    for (const plan::Toolbox& toolbox : library.toolboxes()) {
        if (!toolbox::is_builtin(toolbox.name)) own.insert(toolbox.name);
    }
    return own;
}

nlohmann::json marks_of(const plan::MarkedText& code) {
    auto marks = nlohmann::json::array();
    for (const plan::CodeMark& one : code.marks()) {
        if (marks.size() == kMarksMax) break;
        marks.push_back({{"keys", one.keys}, {"first", one.first}, {"last", one.last}});
    }
    return marks;
}

}  // namespace

PlanDesk::PlanDesk(Desk& desk, Files& files, Findings& findings)
    : files_(files), findings_(findings) {
    desk.command("plan.code", [this](const Call& call) { code(call); });
    desk.command("plan.check", [this](const Call& call) { check(call); });
}

// What would be wrong after some steps; nothing is changed.
void PlanDesk::check(const Call& call) {
    const auto view = plan_of(call, files_);
    if (!view) return;
    const std::string doc = call.in["doc"];
    const auto steps = read_steps(call.in["steps"]);
    if (!steps.ok()) return call.fail(steps.error());
    const auto text = patched(view->text, {view->language, doc}, steps.value());
    if (!text.ok()) return call.fail(text.error());
    const Checkup checkup =
        check_plan_as(files_, doc, text.value(), findings_.toolboxes(), findings_.bus_names());
    auto list = nlohmann::json::array();
    for (const DocFinding& one : checkup.findings) {
        if (one.doc == doc && list.size() < kFindingsMax) list.push_back(json_of(one));
    }
    call.done({{"findings", std::move(list)}});
}

// As the studio has no shared libraries loaded, a plan that uses one has findings here.
void PlanDesk::code(const Call& call) {
    if (!plan_of(call, files_)) return;
    const std::string doc = call.in["doc"];
    const OpenFiles texts(files_);
    const plan::Library& library = findings_.toolboxes().library->templates();
    const plan::Checked checked = plan::check(doc, texts, library);
    if (!checked.ok()) {
        const auto text_of = [&](const std::string& file) { return texts.read(file); };
        return call.done({{"name", ""},
                          {"text", ""},
                          {"marks", nlohmann::json::array()},
                          {"findings", errors_of(plan_findings(checked.findings, text_of))}});
    }
    const plan::MarkedText code = plan::generate_code(checked, own_toolboxes(library));
    call.done({{"name", line_of(checked.plans.front().name + ".cpp", kShownNameMax)},
               {"text", utf8_prefix(code.text(), kCodeMax)},
               {"marks", marks_of(code)},
               {"findings", nlohmann::json::array()}});
}

}  // namespace vagus::serve
