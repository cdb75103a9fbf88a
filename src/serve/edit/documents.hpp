// Texts as pages edit them: doc.open, doc.edit, doc.patch, doc.save and what belongs to them, and
// the topics doc and files. A version counts within an epoch, a life of this server. An edit of
// another version is not done: its answer says what is missing, and the page edits again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr Duration kListEvery = 2s;  // files that come and go outside of the studio

class Documents {
public:
    // All borrowed. `epoch`: as hello tells it.
    Documents(Desk& desk, Files& files, const EditListeners& listeners, std::string epoch);

    void text_changed(const std::string& path);
    // Another project is open.
    void project_changed();

    // Paths that are new on the disk, or gone from it.
    std::vector<std::string> tick(Time now);
    Time next_tick() const { return next_list_; }

private:
    void declare_commands();
    void open(const Call& call);
    void edit(const Call& call);
    void pull(const Call& call);
    void disk(const Call& call);
    void keep(const Call& call);
    void answer_missing(const Call& call, const std::string& doc) const;
    bool is_behind(const Call& call, const std::string& doc) const;
    void patch(const Call& call);
    void save(const Call& call);
    void save_all(const Call& call);
    void done_on_disk(const Call& call, Json out);
    void answer_version(const Call& call, const Status& status);
    Json doc_document(const Json& of);
    Json files_document();
    std::map<std::string, uintmax_t> sizes() const;

    Desk& desk_;
    Files& files_;
    const EditListeners& listeners_;
    const std::string epoch_;
    std::map<std::string, bool> unsaved_;  // as the topic files has it
    std::map<std::string, uintmax_t> sizes_;
    Time next_list_{};
};

}  // namespace vagus::serve
