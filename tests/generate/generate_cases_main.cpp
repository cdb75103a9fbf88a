// Generates the C++ of all golden plans that run, and of random ones, into a folder each, and files
// that include them all: `plans`, the namespace of generated code, is another word in each.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "plan/check.hpp"
#include "plan/generate.hpp"
#include "tests/plans/random_plan.hpp"
#include "toolbox/core.hpp"

namespace fs = std::filesystem;

namespace {

constexpr size_t kBatches = 4;

class Disk final : public vagus::plan::Files {
public:
    vagus::Result<std::string> read(const std::string& path) const override {
        return vagus::read_file(path);
    }
};

void write(const fs::path& path, const std::string& text) {
    const vagus::Status written = vagus::write_file(path.string(), text);
    if (written.ok()) return;
    std::fprintf(stderr, "generate_cases: %s\n", written.error().what.c_str());
    std::exit(1);
}

struct Case {
    std::string name;
    std::vector<std::string> sources;
    std::string make;
};

// Empty sources: a plan with errors, which is never run.
Case generate_case(const std::string& name, const vagus::plan::Checked& checked,
                   const fs::path& folder) {
    Case made{name, {}, {}};
    if (!checked.ok()) return made;
    fs::create_directories(folder / name);
    const auto files = vagus::plan::generate(checked);
    for (const auto& [file, text] : files) {
        // Compilers take files of equal content for one when they obey #pragma once.
        write(folder / name / file, fmt::format("// {}\n{}", name, text));
        if (file.ends_with(".cpp") && file != "main.cpp") made.sources.push_back(name + "/" + file);
    }
    // main.cpp is the one that knows: run_main(&plans::make_X, argc, argv)
    const std::string& main = files.at("main.cpp");
    const size_t at = main.find("&plans::") + 8;
    made.make = main.substr(at, main.find(',', at) - at);
    return made;
}

std::string batch_text(const std::vector<Case>& cases, size_t batch) {
    std::string text = "#include \"tests/generate/case.hpp\"\n";
    std::string table;
    for (size_t i = batch; i < cases.size(); i += kBatches) {
        text += fmt::format("#define plans case_{}\n", i);
        for (const std::string& source : cases[i].sources) {
            text += fmt::format("#include \"{}\"\n", source);
        }
        text += "#undef plans\n";
        table += fmt::format("    {{\"{}\", &case_{}::{}}},\n", cases[i].name, i, cases[i].make);
    }
    return text + fmt::format(
                      "static const vagus::GeneratedCase kCases[] = {{\n{}}};\n"
                      "std::span<const vagus::GeneratedCase> vagus::generated_batch{}() {{ return "
                      "kCases; }}\n",
                      table, batch);
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) return 2;
    const fs::path golden = arguments[1];
    const fs::path folder = arguments[3];
    vagus::run::CodeLibrary library;
    vagus::toolbox::add_core(library);
    std::vector<Case> cases;
    for (const auto& entry : fs::directory_iterator(golden)) {
        const std::string file = entry.path().filename().string();
        const size_t suffix = file.find(".plan.json");
        if (suffix == std::string::npos) continue;
        cases.push_back(generate_case(
            file.substr(0, suffix),
            vagus::plan::check(entry.path().string(), Disk(), library.templates()), folder));
    }
    for (uint64_t seed = 1; seed <= std::strtoull(arguments[2], nullptr, 10); ++seed) {
        const vagus::RandomPlans plans(seed);
        cases.push_back(generate_case(
            fmt::format("random-{}", seed),
            vagus::plan::check("main.plan.json", plans, library.templates()), folder));
    }
    std::erase_if(cases, [](const Case& one) { return one.sources.empty(); });
    std::sort(cases.begin(), cases.end(),
              [](const Case& a, const Case& b) { return a.name < b.name; });
    for (size_t batch = 0; batch < kBatches; ++batch) {
        write(folder / fmt::format("batch{}.cpp", batch), batch_text(cases, batch));
    }
}
