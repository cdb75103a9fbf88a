#include "toolbox/builtin.hpp"

#include <cassert>
#include <iterator>
#include <utility>
#include <vector>

#include "toolbox/bus_template.hpp"
#include "toolbox/carbot/templates.hpp"
#include "toolbox/core.hpp"
#include "toolbox/fleet/templates.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::toolbox {

namespace {

// Files of the build: a test reads them, so they have no errors here.
ToolboxFile read_builtin(std::string_view text) {
    Result<ToolboxFile> file = read_toolbox(text, "built-in", {});
    assert(file.ok());
    return std::move(file.value());
}

void append(std::vector<run::Coded>& to, std::vector<run::Coded> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

SafeStop read_robots() {
    const Result<JsonValue> json = parse_json(kRobotsText, "built-in");
    assert(json.ok());
    Complaints complaints;
    JsonObject in(json.value(), "the file", complaints);
    SafeStop safe = read_safe_stop(in, complaints);
    in.finish();
    assert(complaints.empty());
    return safe;
}

}  // namespace

void add_builtin(run::CodeLibrary& library, const Parts& parts) {
    add_core(library);
    add_drive(library, parts);
    add_carbot(library, parts);
    add_fleet(library, parts);
}

bool is_builtin(std::string_view toolbox) {
    return toolbox == "core" || toolbox == "drive" || toolbox == "carbot" || toolbox == "fleet";
}

void add_drive(run::CodeLibrary& library, const Parts& parts) {
    const ToolboxFile file = read_builtin(kDriveText);
    library.add(file.name, file.help, code_of(file, parts));
}

void add_carbot(run::CodeLibrary& library, const Parts& parts) {
    const ToolboxFile file = read_builtin(kCarbotText);
    std::vector<run::Coded> all = code_of(read_builtin(kDriveText), parts);
    append(all, carbot_templates(parts));
    append(all, code_of(file, parts));
    library.add(file.name, file.help, std::move(all));
}

SafeStop builtin_safe_stop() {
    SafeStop safe = read_robots();
    overlay(safe, read_builtin(kDriveText).safe_stop);
    overlay(safe, read_builtin(kCarbotText).safe_stop);
    return safe;
}

}  // namespace vagus::toolbox
