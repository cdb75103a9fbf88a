// Files of the project: file.new, file.rename, file.delete, file.bytes. What names a file follows
// when it moves.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "serve/edit/edited_project.hpp"
#include "serve/edit/free_node.hpp"
#include "serve/edit/json_patch.hpp"
#include "serve/edit/templates.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr size_t kBytesMax = 4u << 20;  // of file.bytes: less than a page may leave unread

class FileDesk {
public:
    // All borrowed.
    FileDesk(Desk& desk, Files& files, Scripts& scripts, const EditedProject& project,
             const EditListeners& listeners, std::string epoch);

private:
    // A file that names others, with what it must be told.
    struct Follower {
        std::string path;  // after the renaming
        std::vector<JsonStep> steps;
    };

    void make(const Call& call);
    Status make_file(const std::string& path, const std::string& kind);
    Status make_script(const std::string& path);
    Status make_script_for(const std::vector<WorldNode>& nodes, const std::string& path,
                           const std::function<std::string(const NewNode&)>& text);
    bool can_be_named(const NewNode& node) const;
    Status give_to_robot(size_t robot, const std::string& path);
    Status make_first(const std::string& key, const std::string& named, const std::string& path,
                      const std::string& content);
    Status make_toolbox(const std::string& path);
    Status add_toolbox_to(const ScriptPart& part, const NewNode& node, const std::string& path);
    Status list_in_project(const std::string& key, const std::string& path);
    std::vector<WorldNode> nodes_of_project() const;
    void rename(const Call& call);
    std::vector<Follower> followers(const std::string& from, const std::string& to);
    Status follow(const Follower& follower, const std::string& by);
    void remove(const Call& call);
    void bytes(const Call& call);

    Files& files_;
    Scripts& scripts_;
    const EditedProject& project_;
    const EditListeners& listeners_;
    const std::string epoch_;
};

}  // namespace vagus::serve
