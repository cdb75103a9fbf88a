// Toolboxes that a user brings: toolbox files and shared libraries. The one place that loads code.
//
//     const Status loaded = load_toolbox(library, "lamp.toolbox.json", parts, {});
//
// The Error names the file, what is wrong with it and how to fix it.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"
#include "run/code.hpp"
#include "toolbox/parts.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::toolbox {

constexpr std::string_view kLibraryEnding = ".so";  // of shared libraries

// A file NAME.toolbox.json, or a shared library (plugin.hpp) by its ending .so. The parts are
// borrowed as long as the program runs. `read_project`: see toolbox_file.hpp.
Status load_toolbox(run::CodeLibrary& library, const std::string& path, const Parts& parts,
                    const ReadProject& read_project);

// The same for the text of a file NAME.toolbox.json that was not saved.
Status load_toolbox_text(run::CodeLibrary& library, std::string_view text, const std::string& path,
                         const Parts& parts, const ReadProject& read_project);

// Whether what code declares can be a toolbox: names well-formed and not taken twice, defaults of
// their types, code for each template. The Error's sentence does not name the file.
Status check_declared(const std::string& name, const std::vector<run::Coded>& templates);

}  // namespace vagus::toolbox
