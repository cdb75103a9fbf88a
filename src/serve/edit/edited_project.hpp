// What is open, as those who edit need it. Paths are those of documents: from Files::root().
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace vagus::serve {

struct EditedProject {
    std::string plan = {}, world = {};  // empty: none
    std::string project_file = {};      // its vagus.json; empty: a file that was opened alone
    std::vector<std::string> toolboxes = {};
};

// What is told about changes of texts and files.
struct EditListeners {
    std::function<void(const std::string& path)> text_changed = [](auto&) {};
    std::function<void(const std::string& path)> saved = [](auto&) {};
    std::function<void(const std::string& from, const std::string& to)> renamed = [](auto&, auto&) {
    };
    std::function<void(const std::string& kind, const std::string& text)> say = [](auto&, auto&) {};
};

// Whose step of a text it is that we make for a client: never what a client calls itself.
std::string made_for(uint32_t member);

// "a/b" of "a/b/vagus.json"; empty for a file in the root.
std::string folder_of_path(const std::string& path);
// A path that is in a file, as a document; it may lead out ("../x").
std::string path_from(const std::string& file, const std::string& named);
// Of such a path: the folder of the project itself, which a robot of a world may name as its own.
bool is_border(const std::string& path);
// The way back: how `file` names that document.
std::string name_from(const std::string& file, const std::string& path);
// Whether `path` is the folder or is in it; the empty folder holds everything.
bool is_below(const std::string& folder, const std::string& path);

}  // namespace vagus::serve
