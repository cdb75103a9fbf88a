// The scripts of a project, compiled as they are typed: which there are, for which node, what the
// compiler says of them, and what editors ask across all of them.
//
//     Scripts scripts(files, target_of);
//     scripts.changed("carbot/carbot.aesl");
//     for (const ScriptPart& part : scripts.parts()) show(*scripts.compiled(part.doc));
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/mentions.hpp"
#include "aesl/target.hpp"
#include "base/result.hpp"
#include "serve/project/files.hpp"
#include "serve/script/assist.hpp"

namespace vagus::serve {

// A script with the node that it is for.
struct ScriptPart {
    std::string doc;  // PATH#N, or PATH for a file that is one script
    std::string file;
    std::string node;      // its name; empty: any
    uint16_t node_id = 0;  // preferred; 0: none
    friend bool operator==(const ScriptPart&, const ScriptPart&) = default;
};

struct CompiledScript {
    uint64_t number = 0;   // of the compilation: another for each
    uint32_t version = 0;  // of the document
    std::string source;
    aesl::Target target;
    aesl::CommonDefinitions common;
    aesl::Compilation result;

    ScriptView view() const { return {source, target, common}; }
};

// A file of scripts that cannot be read.
struct BrokenFile {
    std::string file;
    std::string sentence;  // "FILE:LINE:COLUMN: …"
};

// A place in a document where a name is.
struct Spot {
    std::string doc;
    aesl::Position at, end;
};

class Scripts {
public:
    // What a node of that name and number is; called again after targets_changed().
    using TargetOf = std::function<aesl::Target(const std::string& name, uint16_t id)>;
    Scripts(Files& files, TargetOf target_of);

    // Another project is open, or none.
    void reread();
    // Files that the project names: they come first, and nodes get their scripts before any other.
    void prefer(std::vector<std::string> files);
    // A file was changed, made, renamed or removed.
    void changed(const std::string& path);
    // Other nodes are there.
    void targets_changed();
    // Counts what may give every script another compilation: targets, projects.
    uint64_t generation() const { return generation_; }

    // By file, those that the project names first, in the order of each.
    const std::vector<ScriptPart>& parts() const { return parts_; }
    std::vector<BrokenFile> broken() const;
    bool is_broken(const std::string& file) const;
    // As the text is now; nullptr if there is no such script.
    const CompiledScript* compiled(const std::string& doc);
    // Events and constants of a file.
    const aesl::CommonDefinitions* common(const std::string& file) const;
    // The script for a node: by its name and, if there are several, by what the project names and
    // its number.
    const ScriptPart* for_node(const std::string& name, uint16_t id) const;

    // The lines of a file that are those of each of its scripts, in their order.
    struct LinesOf {
        std::string doc;
        int first = 1, last = 1;  // of the file
    };
    std::vector<LinesOf> lines_in(const std::string& file) const;

    // ---- across scripts ----
    // The name at a place, and every place where the same thing is meant: in this script, or for
    // what the project owns in all scripts of its file.
    struct Found {
        std::string name;
        aesl::MentionKind kind = aesl::MentionKind::Variable;
        Owner owner = Owner::Script;
        std::vector<Spot> spots;
    };
    std::optional<Found> references(const std::string& doc, aesl::Position at);
    std::vector<Spot> definition(const std::string& doc, aesl::Position at);
    // Gives the thing at a place another name, everywhere; how many places it had.
    Result<size_t> rename(const std::string& doc, aesl::Position at, const std::string& to,
                          const std::string& by);

    // Events and constants of a file. `element` is "event" or "constant".
    Status add(const std::string& file, const std::string& element, const std::string& name,
               int32_t value, const std::string& by);
    Result<size_t> change(const std::string& file, const std::string& element,
                          const std::string& name, const std::string& to, int32_t value,
                          const std::string& by);
    Status remove(const std::string& file, const std::string& element, const std::string& name,
                  const std::string& by);
    Status move(const std::string& file, const std::string& element, const std::string& name,
                size_t to, const std::string& by);

private:
    // What was read last without a mistake, and the mistake there is now.
    struct ScriptsOfFile {
        aesl::CommonDefinitions common;
        bool plain = false;
        std::vector<ScriptPart> parts;
        std::string mistake;
    };

    void read_all();
    void read_file(const std::string& path);
    void collect_parts();
    size_t place_of(const std::string& file) const;
    Status replace_mentions(const std::string& doc, const std::string& name, aesl::MentionKind kind,
                            const std::string& to, const std::string& by, size_t& places);
    Result<std::string> project_text(const std::string& file);
    Status check_new_name(const std::string& file, const std::string& name);

    Files& files_;
    TargetOf target_of_;
    std::vector<std::string> preferred_;
    std::vector<ScriptPart> parts_;
    std::map<std::string, ScriptsOfFile> script_files_;
    std::map<std::string, CompiledScript> compiled_;
    uint64_t compilations_ = 0;
    uint64_t generation_ = 0;
};

}  // namespace vagus::serve
