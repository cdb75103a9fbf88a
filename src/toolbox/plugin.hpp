// A toolbox of your own as a shared library, for `--toolbox FILE.so`.
//
//     // lamp.cpp, built as a MODULE library that links Vagus::toolbox
//     #include <vagus/toolbox/plugin.hpp>
//
//     static vagus::toolbox::Plugin make(const vagus::toolbox::Parts&) {
//         return {.name = "lamp", .help = "Lamps.", .templates = …};          // run/code.hpp
//     }
//     VAGUS_TOOLBOX(make)
//
// The library must have been built with the same version of Vagus as the program that loads it;
// that is checked. It stays loaded until the program ends.
#pragma once

#include <string>
#include <vector>

#include "run/code.hpp"
#include "toolbox/parts.hpp"
#include "toolbox/version.hpp"

namespace vagus::toolbox {

struct Plugin {
    std::string name;
    std::string help = {};
    std::vector<run::Coded> templates = {};
};

// What both sides must have in common: the version, and the sizes of what passes between them.
struct PluginVersion {
    const char* version = kVersion;
    size_t sizes[4] = {sizeof(plan::Template), sizeof(run::Coded), sizeof(run::ActorContext),
                       sizeof(Plugin)};
};

// Names of the two functions that VAGUS_TOOLBOX defines.
inline constexpr const char* kPluginVersionFunction = "vagus_toolbox_version";
inline constexpr const char* kPluginMakeFunction = "vagus_toolbox_make";
using PluginVersionFunction = void (*)(PluginVersion& version);
using PluginMakeFunction = void (*)(Plugin& plugin, const Parts& parts);

}  // namespace vagus::toolbox

// `make`: a function that takes const Parts& (borrowed as long as the program runs) and gives a
// Plugin. What it throws is told by the program that loads the library.
#define VAGUS_TOOLBOX(make)                                                       \
    extern "C" __attribute__((visibility("default"))) void vagus_toolbox_version( \
        vagus::toolbox::PluginVersion& version) {                                 \
        version = vagus::toolbox::PluginVersion();                                \
    }                                                                             \
    extern "C" __attribute__((visibility("default"))) void vagus_toolbox_make(    \
        vagus::toolbox::Plugin& plugin, const vagus::toolbox::Parts& parts) {     \
        plugin = make(parts);                                                     \
    }
