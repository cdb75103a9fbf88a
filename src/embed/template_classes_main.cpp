// Writes the classes of the built-in toolboxes' templates into a folder: a step of the build.
#include <cstdio>
#include <filesystem>

#include "base/file.hpp"
#include "plan/generate_classes.hpp"
#include "toolbox/builtin.hpp"

int main(int count, char** arguments) {
    if (count != 2) {
        std::fputs("usage: template_classes FOLDER\n", stderr);
        return 2;
    }
    const vagus::toolbox::Parts parts;
    vagus::run::CodeLibrary library;
    vagus::toolbox::add_builtin(library, parts);
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    for (const vagus::plan::Toolbox& toolbox : library.templates().toolboxes()) {
        const auto path = folder / (vagus::plan::cpp_namespace(toolbox) + ".hpp");
        const auto written =
            vagus::write_file(path.string(), vagus::plan::generate_toolbox_header(toolbox));
        if (written.ok()) continue;
        std::fprintf(stderr, "template_classes: %s\n", written.error().what.c_str());
        return 1;
    }
}
