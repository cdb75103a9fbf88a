// One file while it is edited, without its disk: its text, the scripts in it (those of
// an .aesl, documents of their own), and the last steps of each. A change of a script is a change
// of the file and the other way round; each sees it as a step of its own.
//
//     OpenText text("carbot/carbot.aesl", bytes, 1);
//     text.edit(2, {{0, 3, "var"}}, "a1b2");   // in the script of the second node
//     text.updates(0).version();               // the file is a version further, too
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "serve/project/line_ends.hpp"
#include "serve/project/updates.hpp"

namespace vagus::serve {

constexpr size_t kTextBytesMax = 2u << 20;

// What a name of a file says: "plan" for NAME.plan.json.
std::string kind_of_file(std::string_view path);

class OpenText {
public:
    OpenText() = default;
    OpenText(std::string path, std::string_view bytes, uint32_t first_version);

    // ---- part 0 is the file, N the script of the Nth node ----
    bool has(int part) const {
        return part == 0 || (parts_.contains(part) && parts_.at(part).there);
    }
    size_t scripts() const;
    // has(part)
    const std::string& text(int part) const;
    const Updates& updates(int part) const;
    std::string language(int part) const;  // as in the protocol: aesl, aesl-file, plan, …

    std::string_view ends() const { return file_.ends(); }
    std::string bytes() const { return file_.bytes(); }  // as they are saved
    uint32_t newest_version() const;                     // of the file and its scripts

    // Changes count in the text as it is; nothing is changed if one of them cannot be made.
    Status edit(int part, std::vector<TextChange> changes, const std::string& by);
    // The text becomes that one, in as few changes as it takes.
    Status replace(int part, std::string_view text, const std::string& by);
    // The file becomes those bytes, with their line ends.
    void take(std::string_view bytes, const std::string& by);
    void move_to(std::string path);
    // Nothing leads from any version before to this one.
    void begin_again(uint32_t version);

private:
    struct Part {
        bool there = false;
        std::string text;
        Updates updates;
    };

    Status check_size(int part, size_t bytes) const;
    std::string name_of(int part) const;
    Status edit_script(int part, const std::vector<TextDifference>& changes);
    void refresh_parts(const std::string& by);
    void refresh_part(int number, std::string now, const std::string& by);

    std::string path_;
    FileText file_;
    Updates updates_;
    uint32_t first_version_ = 1;
    std::map<int, Part> parts_;
};

}  // namespace vagus::serve
