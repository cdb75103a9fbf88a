// Searching and replacing in all texts of the project, as they are edited: text.search and
// text.replace. The script of a node is a text of its own; what is around it in its file is
// found in the file.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "serve/edit/pattern.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr size_t kSearchStepsMax = 20'000'000;    // about a second
constexpr size_t kSearchBytesMax = 64u << 20;     // of texts
constexpr size_t kSearchLineBytesMax = 1u << 16;  // longer lines are passed over
constexpr size_t kSpotsMax = 5000;

class Search {
public:
    // All borrowed.
    Search(Desk& desk, Files& files, Scripts& scripts, std::string epoch);

private:
    // A text to look through, and which of its lines belong to other documents.
    struct Text {
        std::string doc, text;
        std::vector<std::pair<size_t, size_t>> without = {};  // lines from, to
    };
    struct Found {
        size_t line = 0, line_begin = 0;  // from 1; its first byte
        std::string_view line_text;
        Pattern::Match match;
    };
    // What is left of the work that one command may do.
    struct Budget {
        size_t steps = kSearchStepsMax, bytes = kSearchBytesMax;
    };

    std::vector<Text> texts(Budget& budget, bool& more);
    void add_texts_of(const FileInfo& file, std::vector<Text>& texts);
    // False: stop.
    using See = std::function<bool(const Found&)>;
    static bool each_match(const Pattern& pattern, const Text& text, Budget& budget,
                           const See& see);
    static std::optional<Pattern> pattern_of(const Call& call, std::string& why);
    void search(const Call& call);
    void replace(const Call& call);
    std::vector<TextChange> changes_of(const Call& call, const Pattern& pattern, const Text& text,
                                       Budget& budget) const;

    Files& files_;
    Scripts& scripts_;
    const std::string epoch_;
};

}  // namespace vagus::serve
