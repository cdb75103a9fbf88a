// A file with scripts as a person names it: an `.aesl` project (XML), or the plain text of one
// script. A plain script has nowhere to declare events, so `emit NAME` declares NAME: numbered in
// the order of appearance, behind those that the world's projects declare, with any number of
// arguments.
#pragma once

#include <string>
#include <string_view>

#include "aesl/compile.hpp"
#include "aesl/project.hpp"
#include "base/result.hpp"

namespace vagus::session {

struct ScriptFile {
    std::string path;
    bool plain = false;     // one script for any node; else the project names its nodes
    aesl::Project project;  // of a plain script: without events and constants, one script
};

// The Error is that of parse_project(); a plain text is always accepted here. A byte-order mark at
// the start is skipped.
Result<ScriptFile> read_script_file(std::string_view text, const std::string& path);

// `common` and the names that the plain script emits and that are neither in it nor local events.
aesl::CommonDefinitions with_emitted(const aesl::CommonDefinitions& common, std::string_view source,
                                     const aesl::Target& target);

// An event of unknown size may be emitted with any arguments in the dialect of 2007 only, which
// otherwise takes every modern script: it is chosen where the names need it and nothing else is
// asked for.
aesl::Options options_for(const aesl::CommonDefinitions& common, aesl::Options options);

}  // namespace vagus::session
