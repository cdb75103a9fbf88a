// `vagus plan diff`: what differs between two versions of a plan, element by element.
#include "cli/plan/diff.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>

#include "base/file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "plan/differences.hpp"

namespace vagus::cli {

namespace {

constexpr std::string_view kNoFile = "/dev/null";  // what git gives where there is no version

struct DiffWords {
    std::string before;
    std::string after;
    bool places = false;
    bool json = false;
};

Result<JsonValue> read_version(const std::string& path) {
    if (path == kNoFile) return json_object({});
    const std::string text = TRY(read_file(path));
    return plan::read_plan_tree(text, path);
}

int diff(const DiffWords& words) {
    const Result<JsonValue> before = read_version(words.before);
    if (!before.ok()) return complain(before.error(), kExitUsage);
    const Result<JsonValue> after = read_version(words.after);
    if (!after.ok()) return complain(after.error(), kExitUsage);
    plan::Differences all = plan::differences(before.value(), after.value());
    const bool counts = std::any_of(all.begin(), all.end(), [&words](const auto& one) {
        return words.places || !plan::is_place(one);
    });
    if (words.json) {
        if (!words.places) std::erase_if(all, plan::is_place);
        print(plan::format_json(all));
    } else {
        const std::string text = plan::format_text(all, {.places = words.places});
        if (!text.empty()) print("--- " + words.before + "\n+++ " + words.after + "\n" + text);
    }
    return counts ? kExitFailed : kExitDone;
}

void add_version(CLI::App& verb, const std::string& name, std::string& path,
                 const std::string& help) {
    takes_file(*verb.add_option(name, path, help)->required(), {".plan.json"});
}

}  // namespace

void add_plan_diff(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("diff", "shows what differs between two versions");
    verb->footer(
        "Elements, formulas and arrows, not lines of text; sub-plans are files of their own. Exit "
        "codes: 0 no\ndifference (but for places), 1 some, 2 one of them is not a valid plan "
        "file.\n\nExample:\n  vagus plan diff old.plan.json new.plan.json\n"
        "  git config difftool.vagus.cmd 'vagus plan diff \"$LOCAL\" \"$REMOTE\"'");
    auto words = std::make_shared<DiffWords>();  // owners: CLI11's options and the callback
    add_version(*verb, "A", words->before, "the earlier version");
    add_version(*verb, "B", words->after, "the later version");
    verb->add_flag("--places", words->places, "also lists what stands elsewhere in the drawing");
    verb->add_flag("--json", words->json, "as a JSON array on stdout");
    verb->callback([words, &exit_code] { exit_code = diff(*words); });
}

}  // namespace vagus::cli
