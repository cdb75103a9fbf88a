#include "serve/edit/file_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "aesl/project.hpp"
#include "serve/edit/named_paths.hpp"
#include "serve/edit/plan_findings.hpp"
#include "serve/project/paths.hpp"
#include "session/project_file.hpp"
#include "sim/world_file.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/load.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::serve {

namespace {

namespace fs = std::filesystem;

const toolbox::Parts kNoParts;

// The text of one document is another one for this check.
struct Instead {
    std::string path = {}, text = {};
};

class FilesWithOneInstead final : public plan::Files {
public:
    FilesWithOneInstead(const CheckedTexts& texts, const Instead& instead)
        : texts_(texts), instead_(instead) {}
    Result<std::string> read(const std::string& path) const override {
        if (path == instead_.path) return instead_.text;
        return texts_.read(path);
    }

private:
    const CheckedTexts& texts_;
    const Instead& instead_;
};

// Sentences of readers that were given a path on the disk.
std::string without_root(std::string sentence, const std::string& root) {
    const std::string prefix = root + "/";
    for (size_t at = sentence.find(prefix); at != sentence.npos; at = sentence.find(prefix)) {
        sentence.erase(at, prefix.size());
    }
    return sentence;
}

toolbox::ReadProject reader_of(const CheckedTexts& texts) {
    return [&texts](const std::string& path) -> Result<toolbox::ProjectEvents> {
        const std::string text = TRY(texts.read_absolute(path));
        const aesl::Project project = TRY(aesl::parse_project(text, path));
        toolbox::ProjectEvents events;
        for (const aesl::GlobalEvent& event : project.common.events) {
            events[event.name] = event.size ? std::optional<size_t>(*event.size) : std::nullopt;
        }
        return events;
    };
}

// One document under check.
struct Subject {
    Files& files;
    std::string path, text;
    Checkup& checkup;

    std::string on_disk() const { return (files.root() / path).string(); }
    void say(const Error& error, const std::string& code) const {
        checkup.findings.push_back(finding_of_sentence(
            path, text, Severity::Error, code, without_root(error.what, files.root().string())));
    }
    void say_all(const std::vector<Error>& errors, const std::string& code) const {
        for (const Error& one : errors) say(one, code);
    }
};

// Seen from the root of the project. A folder may be named with a slash behind it.
std::string path_of(const Subject& subject, const NamedPath& named) {
    std::string path = path_from(subject.path, named.text);
    if (named.folder && path.size() > 1 && path.ends_with('/')) path.pop_back();
    return path;
}

// Files that it names and that are not there.
void check_named(const Subject& subject) {
    for (const NamedPath& named : named_paths(subject.path, subject.text)) {
        const std::string path = path_of(subject, named);
        if (named.folder && is_border(path)) continue;
        const bool inside = check_path(path).ok();
        if (inside && (named.folder || subject.files.exists(path))) continue;
        DocFinding finding{subject.path, Severity::Error, "named_file", {},
                           named.place,  named.place,     {},           {}};
        finding.end = end_of_word(subject.text, named.place);
        finding.what = inside
                           ? fmt::format(
                                 "there is no file {}; the path counts from the folder of this "
                                 "file",
                                 path)
                           : fmt::format(
                                 "“{}” leads out of the project; copy the file into it, and name "
                                 "that copy",
                                 named.text);
        subject.checkup.findings.push_back(std::move(finding));
    }
}

// Reads the document and lets `look` find what is wrong with it.
template <typename Look>
Checkup checkup_of(Files& files, const std::string& path, const Look& look) {
    CheckedTexts texts(files);
    Checkup checkup;
    const auto text = texts.read(path);
    if (text.ok()) {
        look(Subject{files, path, text.value(), checkup}, texts);
    } else {
        checkup.findings.push_back(
            finding_of_sentence(path, "", Severity::Error, "unreadable", text.error().what));
    }
    checkup.read = texts.take_read();
    return checkup;
}

// A plan with the sub-plans that it names.
Checkup checked_plan(Files& files, const std::string& path, const Instead& instead,
                     const Toolboxes& toolboxes, const std::optional<session::BusNames>& names) {
    const CheckedTexts again(files);
    CheckedTexts reading(files);
    const FilesWithOneInstead texts(reading, instead);
    const plan::Checked checked = plan::check(path, texts, toolboxes.library->templates());
    plan::Findings found = checked.findings;
    if (checked.ok()) add_warnings(checked, names, found);
    // Nobody knows what a toolbox declares that is not loaded.
    if (toolboxes.incomplete) {
        std::erase_if(found, [](const plan::Finding& one) { return one.rule == "P2"; });
    }
    Checkup checkup;
    checkup.read = reading.take_read();
    const FilesWithOneInstead seen(again, instead);
    checkup.findings =
        plan_findings(found, [&](const std::string& file) { return seen.read(file); });
    return checkup;
}

}  // namespace

Result<std::string> CheckedTexts::read(const std::string& path) const {
    read_[path] = 0;
    DocumentView view = TRY(files_.open(path));
    read_[path] = view.version;
    // Its text is still in an editor, but nobody who runs this would find it.
    if (view.gone && !view.unsaved) {
        return Error{Code::NotFound, path + ": there is no such file in the project"};
    }
    return std::move(view.text);
}

Result<std::string> CheckedTexts::read_absolute(const std::string& path) const {
    return read(fs::path(path).lexically_relative(files_.root()).generic_string());
}

Toolboxes load_toolboxes(Files& files, const std::vector<std::string>& paths) {
    Toolboxes loaded;
    loaded.library = std::make_unique<run::CodeLibrary>();
    toolbox::add_builtin(*loaded.library, kNoParts);
    for (const std::string& path : paths) {
        if (path.ends_with(".so")) {
            loaded.incomplete = true;
            continue;
        }
        Checkup one = checkup_of(files, path, [&](const Subject& subject, const auto& texts) {
            const Status added = toolbox::load_toolbox_text(
                *loaded.library, subject.text, subject.on_disk(), kNoParts, reader_of(texts));
            if (added.ok()) return;
            loaded.incomplete = true;  // what it declares is not known
            const auto mistakes =
                toolbox::mistakes_of_toolbox(subject.text, subject.on_disk(), reader_of(texts));
            subject.say_all(mistakes, "toolbox");
            if (mistakes.empty()) subject.say(added.error(), "toolbox");
        });
        loaded.checkup.read.merge(one.read);
        std::move(one.findings.begin(), one.findings.end(),
                  std::back_inserter(loaded.checkup.findings));
    }
    return loaded;
}

Checkup check_plan(Files& files, const std::string& path, const Toolboxes& toolboxes,
                   const std::optional<session::BusNames>& names) {
    return checked_plan(files, path, {}, toolboxes, names);
}

Checkup check_plan_as(Files& files, const std::string& path, const std::string& text,
                      const Toolboxes& toolboxes, const std::optional<session::BusNames>& names) {
    return checked_plan(files, path, {path, text}, toolboxes, names);
}

Checkup check_world_file(Files& files, const std::string& path) {
    return checkup_of(files, path, [&](const Subject& subject, const auto&) {
        const auto mistakes = sim::mistakes_of_world(subject.text, path);
        if (!mistakes.empty()) return subject.say_all(mistakes, "world");
        for (const std::string& hint : sim::hints_of_world(subject.text, path)) {
            subject.checkup.findings.push_back(
                finding_of_sentence(path, subject.text, Severity::Warning, "world", hint));
        }
        check_named(subject);
    });
}

Checkup check_toolbox_file(Files& files, const std::string& path) {
    return checkup_of(files, path, [&](const Subject& subject, const CheckedTexts& texts) {
        subject.say_all(
            toolbox::mistakes_of_toolbox(subject.text, subject.on_disk(), reader_of(texts)),
            "toolbox");
    });
}

Checkup check_project_file(Files& files, const std::string& path) {
    return checkup_of(files, path, [&](const Subject& subject, const auto&) {
        const auto mistakes = session::mistakes_of_project(subject.text, path);
        if (!mistakes.empty()) return subject.say_all(mistakes, "project");
        check_named(subject);
    });
}

}  // namespace vagus::serve
