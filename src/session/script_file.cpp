#include "session/script_file.hpp"

#include <algorithm>
#include <vector>

#include "base/file_format.hpp"

namespace vagus::session {
namespace {

// Some editors of Windows begin each file with it. It says nothing.
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

constexpr size_t kEmittedMax = 1000;  // names; a script has room for far fewer

bool is_word(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return std::isalnum(byte) != 0 || c == '_' || c == '.' || byte >= 0x80;
}

// Behind the comment that begins at the front of `text` (aesl-language.md 1.2).
std::string_view without_comment(std::string_view text) {
    const bool block = text.starts_with("#*");
    const size_t end = block ? text.find("*#", 2) : text.find('\n');
    if (end == std::string_view::npos) return {};
    return text.substr(end + (block ? 2 : 1));
}

std::vector<std::string> emitted_names(std::string_view source) {
    std::vector<std::string> names;
    std::string_view last;
    while (!source.empty() && names.size() < kEmittedMax) {
        if (source.front() == '#') {
            source = without_comment(source);
            continue;
        }
        const auto end = std::find_if_not(source.begin(), source.end(), is_word);
        const auto length = static_cast<size_t>(end - source.begin());
        const std::string_view word = source.substr(0, length);
        const bool named = last == "emit" || last == "_emit";
        if (named && length > 0 && std::isdigit(static_cast<unsigned char>(word[0])) == 0) {
            names.emplace_back(word);
        }
        if (length > 0) last = word;
        source.remove_prefix(std::max<size_t>(length, 1));
    }
    return names;
}

}  // namespace

Result<ScriptFile> read_script_file(std::string_view text, const std::string& path) {
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    const size_t start = text.find_first_not_of(" \t\r\n");
    if (start != std::string_view::npos && text[start] == '<') {
        auto project = TRY(aesl::parse_project(text, path));
        return ScriptFile{path, false, std::move(project)};
    }
    if (const auto other = other_format(text, FileFormat::Script)) {
        return Error{Code::BadInput, at_place(path, {1, 1}, *other)};
    }
    ScriptFile file{path, true, {}};
    file.project.scripts.emplace_back();
    file.project.scripts.back().source = std::string(text);
    return file;
}

aesl::CommonDefinitions with_emitted(const aesl::CommonDefinitions& common, std::string_view source,
                                     const aesl::Target& target) {
    aesl::CommonDefinitions wider = common;
    for (const std::string& name : emitted_names(source)) {
        const auto same = [&name](const auto& event) { return event.name == name; };
        const bool known = std::any_of(wider.events.begin(), wider.events.end(), same);
        const auto& local = target.local_events;
        if (known || std::any_of(local.begin(), local.end(), same)) continue;
        wider.events.push_back({name, std::nullopt});
    }
    return wider;
}

aesl::Options options_for(const aesl::CommonDefinitions& common, aesl::Options options) {
    const bool unsized_event =
        std::any_of(common.events.begin(), common.events.end(),
                    [](const aesl::GlobalEvent& event) { return !event.size; });
    if (unsized_event && options.dialect == aesl::Dialect::Auto) {
        options.dialect = aesl::Dialect::Year2007;
    }
    return options;
}

}  // namespace vagus::session
