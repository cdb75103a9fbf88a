// Any text as a toolbox file: refused with a sentence, or a toolbox whose templates can be made.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "toolbox/bus_template.hpp"
#include "toolbox/toolbox_file.hpp"

using namespace vagus;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // A project that knows some events: its checks are part of the reading.
    const toolbox::ReadProject project = [](const std::string&) {
        return Result<toolbox::ProjectEvents>(toolbox::ProjectEvents{
            {"drive.forward", 4}, {"drive.stop", 1}, {"drive.stopped", 1}, {"drive.alive", 1}});
    };
    for (const toolbox::ReadProject& read : {project, toolbox::ReadProject()}) {
        const Result<toolbox::ToolboxFile> file = toolbox::read_toolbox(text, "f.json", read);
        if (!file.ok()) {
            if (file.error().what.empty()) std::abort();
            continue;
        }
        const toolbox::Parts parts;
        run::CodeLibrary library;
        library.add(file.value().name, file.value().help, toolbox::code_of(file.value(), parts));
        for (const auto& one : library.templates().toolboxes().front().templates) {
            const bool supervisor = one.kind == plan::Kind::Supervisor;
            if (supervisor && !library.make_supervisor(one)) std::abort();
            if (!supervisor && !library.make_actor(one)) std::abort();
        }
    }
    return 0;
}
