// A template of one's own from the palette: template.new. The toolbox file, the script of the node,
// its events and vagus.json are changed together, or nothing is.
#pragma once

#include <map>
#include <string>

#include "serve/edit/edited_project.hpp"
#include "serve/edit/findings.hpp"
#include "serve/edit/own_template.hpp"
#include "serve/project/files.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

class TemplateDesk {
public:
    // All borrowed.
    TemplateDesk(Desk& desk, Files& files, Scripts& scripts, Findings& findings,
                 const EditedProject& project, const EditListeners& listeners, std::string epoch);

private:
    // All new texts by their paths, before any of them is written.
    struct Change {
        std::map<std::string, std::string> texts;
        std::string new_file;  // one of them; empty: every file is there already
        std::string toolbox;
        int line = 0;  // of the script, where its author goes on
    };
    void make(const Call& call);
    Status check_name(const OwnTemplate& of);
    Result<Change> change_of(const ScriptPart& part, const OwnTemplate& of);
    Status add_script(const ScriptPart& part, const OwnTemplate& of, Change& change);
    Status add_to_toolbox(const std::string& script_file, const OwnTemplate& of, Change& change);
    Status make_toolbox(const std::string& script_file, const OwnTemplate& of, Change& change);
    Status list_toolbox(Change& change);
    Status write(const Change& change, const std::string& by);
    std::string toolbox_for(const std::string& script_file);

    Files& files_;
    Scripts& scripts_;
    Findings& findings_;
    const EditedProject& project_;
    const EditListeners& listeners_;
    const std::string epoch_;
};

}  // namespace vagus::serve
