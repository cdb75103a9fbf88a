// All findings of the project, always of the texts as they are: scripts are compiled at the edit,
// other files are checked shortly afterwards, one at a time, so that typing never waits. What did
// not change is not checked again.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/edit/file_checks.hpp"
#include "serve/json.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr Duration kCheckAfter = 100ms;  // of the last change
constexpr Duration kCheckWithin = 1s;    // of the first
constexpr size_t kFindingsMax = 2000;    // that pages get

class Findings {
public:
    // All borrowed. Declares the topics findings and templates.
    Findings(Desk& desk, Files& files, Scripts& scripts, const EditedProject& project);

    void text_changed(const std::string& path);
    void project_changed();
    // Everything as of now: what is due is checked first.
    std::vector<DocFinding> all();
    // What plans can be made of, and what the nodes of the project declare, both as of now.
    const Toolboxes& toolboxes();
    std::optional<session::BusNames> bus_names();
    // The files of the project, and those that it names elsewhere.
    const std::set<std::string>& files_of_project();

    void tick(Time now);
    Time next_tick() const;

private:
    struct OfScript {
        uint64_t compilation = 0;
        uint32_t version = 0;
        std::vector<DocFinding> findings;
        Json json;
    };
    struct OfFile {
        Checkup checkup;
        uint64_t toolboxes = 0, files = 0;  // generations that it is for
        Json json;
    };

    bool concerns_files(const std::string& path);
    bool is_read_by_a_check(const std::string& path) const;
    bool list_again();
    std::vector<std::string> named_in(const std::string& file);
    void find_scope();
    std::set<std::string> wanted() const;

    void refresh_scripts();
    std::vector<DocFinding> broken_files();

    void refresh_toolboxes();
    void begin_round();
    void check_next();
    void end_round();
    bool holds(const OfFile& known);
    Checkup check(const std::string& path);
    const std::string& nodes_file() const;
    void add_events_of(const std::string& file, aesl::CommonDefinitions& common);

    Json document();

    Desk& desk_;
    Files& files_;
    Scripts& scripts_;
    const EditedProject& project_;

    std::set<std::string> listed_;    // files that there are
    std::set<std::string> scope_;     // those of the project
    std::vector<std::string> named_;  // by the file that says which scripts the nodes have
    std::map<std::string, OfScript> of_scripts_;
    std::map<std::string, OfFile> of_files_;  // by the file that a check begins with
    Toolboxes toolboxes_;
    std::vector<std::string> toolbox_paths_;
    uint64_t toolboxes_generation_ = 0;
    uint64_t files_generation_ = 0;  // files came, went, or declare other names
    std::map<std::string, aesl::CommonDefinitions> common_;  // what each file declares

    // A round of checks: what is left of it, what it has checked, what that has read.
    std::deque<std::string> left_;
    std::set<std::string> done_, reached_;
    std::optional<Time> due_, due_at_last_;
    uint64_t targets_ = 0;  // generation of Scripts
    Time now_{};
};

}  // namespace vagus::serve
