#include "serve/project/open_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "aesl/project.hpp"
#include "aesl/project_text.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kScriptChangesMax = 50;  // that are put into the file one by one

bool is_project(std::string_view text) {
    const size_t first = text.find_first_not_of(" \t\n");
    return first != text.npos && text[first] == '<';
}

// A carriage return that is written as &#13; would count as a line end.
std::string script_of(const aesl::ProjectText& project, size_t index) {
    std::string script = project.script(index);
    std::replace(script.begin(), script.end(), '\r', ' ');
    return script;
}

}  // namespace

std::string kind_of_file(std::string_view path) {
    if (path.ends_with(".aesl")) return "script";
    if (path.ends_with(".plan.json")) return "plan";
    if (path.ends_with(".world.json")) return "world";
    if (path.ends_with(".toolbox.json")) return "toolbox";
    if (path == "vagus.json" || path.ends_with("/vagus.json")) return "project";
    if (path.ends_with(".png") || path.ends_with(".jpg") || path.ends_with(".svg")) {
        return "picture";
    }
    for (const std::string_view end : {".txt", ".md", ".json", ".py", ".c", ".cpp", ".h", ".hpp"}) {
        if (path.ends_with(end)) return "text";
    }
    return "other";
}

OpenText::OpenText(std::string path, std::string_view bytes, uint32_t first_version)
    : path_(std::move(path)),
      file_(FileText::read(bytes)),
      updates_(first_version),
      first_version_(first_version) {
    refresh_parts("");
}

size_t OpenText::scripts() const {
    return static_cast<size_t>(std::count_if(parts_.begin(), parts_.end(),
                                             [](const auto& one) { return one.second.there; }));
}

const std::string& OpenText::text(int part) const {
    return part == 0 ? file_.text() : parts_.at(part).text;
}

const Updates& OpenText::updates(int part) const {
    return part == 0 ? updates_ : parts_.at(part).updates;
}

std::string OpenText::language(int part) const {
    const std::string kind = kind_of_file(path_);
    if (part > 0) return "aesl";
    if (kind == "script") return is_project(file_.text()) ? "aesl-file" : "aesl";
    if (kind == "plan" || kind == "world" || kind == "toolbox") return kind;
    return path_.ends_with(".json") ? "json" : "text";
}

uint32_t OpenText::newest_version() const {
    uint32_t newest = updates_.version();
    for (const auto& [number, part] : parts_) newest = std::max(newest, part.updates.version());
    return newest;
}

std::string OpenText::name_of(int part) const {
    return part == 0 ? path_ : fmt::format("{}#{}", path_, part);
}

Status OpenText::check_size(int part, size_t bytes) const {
    if (bytes <= kTextBytesMax) return Status::done();
    return Error{Code::Limit, fmt::format("{}: the text would have {} bytes; at most {} are edited",
                                          name_of(part), bytes, kTextBytesMax)};
}

Status OpenText::edit(int part, std::vector<TextChange> changes, const std::string& by) {
    for (TextChange& change : changes) change.text = with_line_feeds(change.text);
    const std::string before = text(part);
    const auto places = in_bytes(before, changes);
    if (!places) {
        return Error{Code::BadInput, name_of(part) +
                                         ": a change lies outside of the text, inside a "
                                         "character, or over another"};
    }
    const std::string after = applied(before, *places);
    if (changes.empty()) return Status::done();
    TRY(check_size(part, after.size()));
    if (changes.size() > kDifferencesMax) changes = in_units(before, differences(before, after));
    if (part == 0) {
        file_.apply(*places);
        updates_.add(std::move(changes), by);
    } else {
        const std::string file_before = file_.text();
        TRY(edit_script(part, *places));
        updates_.add(in_units(file_before, differences(file_before, file_.text())), by);
        parts_[part].text = after;
        parts_[part].updates.add(std::move(changes), by);
    }
    refresh_parts(by);
    return Status::done();
}

// Into the file around it.
Status OpenText::edit_script(int part, const std::vector<TextDifference>& changes) {
    const auto index = static_cast<size_t>(part) - 1;
    std::string whole = file_.text();
    const aesl::ProjectText project(whole);
    const std::string& script = parts_.at(part).text;
    if (index >= project.scripts() || script_of(project, index) != script) {
        return Error{Code::Refused, name_of(part) +
                                        ": the file around the script is no project at the moment; "
                                        "fix it first"};
    }
    if (changes.size() <= kScriptChangesMax) {
        for (auto one = changes.rbegin(); one != changes.rend(); ++one) {
            whole = aesl::ProjectText(whole).replace(index, one->from, one->to, one->insert);
        }
    } else {
        const std::string after = applied(script, changes);
        const TextDifference one = difference(script, after);
        whole = project.replace(index, one.from, one.to, one.insert);
    }
    TRY(check_size(0, whole.size()));
    file_.apply(differences(file_.text(), whole));
    return Status::done();
}

Status OpenText::replace(int part, std::string_view text_after, const std::string& by) {
    const std::string after = with_line_feeds(text_after);
    const std::string before = text(part);
    return edit(part, in_units(before, differences(before, after)), by);
}

void OpenText::take(std::string_view bytes, const std::string& by) {
    FileText now = FileText::read(bytes);
    const std::string before = std::exchange(file_, std::move(now)).text();
    if (file_.text() == before) return;  // line ends, perhaps: no place moved
    updates_.add(in_units(before, differences(before, file_.text())), by);
    refresh_parts(by);
}

void OpenText::move_to(std::string path) {
    path_ = std::move(path);
    refresh_parts("server");
}

void OpenText::begin_again(uint32_t version) {
    first_version_ = std::max(version, newest_version() + 1);
    updates_ = Updates(first_version_);
    for (auto& [number, part] : parts_) part.updates = Updates(first_version_);
}

// While the file is no project, the scripts stay as they were.
void OpenText::refresh_parts(const std::string& by) {
    int count = 0;
    if (kind_of_file(path_) == "script") {
        if (!is_project(file_.text()) || !aesl::parse_project(file_.text(), path_).ok()) return;
        const aesl::ProjectText project(file_.text());
        count = static_cast<int>(project.scripts());
        for (int number = 1; number <= count; ++number) {
            refresh_part(number, script_of(project, static_cast<size_t>(number) - 1), by);
        }
    }
    // A part that comes back goes on counting its versions.
    for (auto& [number, part] : parts_) part.there = part.there && number <= count;
}

void OpenText::refresh_part(int number, std::string now, const std::string& by) {
    auto [found, is_new] = parts_.try_emplace(number);
    Part& part = found->second;
    if (is_new) part.updates = Updates(first_version_);
    part.there = true;
    if (is_new || part.text == now) {
        part.text = std::move(now);
        return;
    }
    part.updates.add(in_units(part.text, differences(part.text, now)), by);
    part.text = std::move(now);
}

}  // namespace vagus::serve
