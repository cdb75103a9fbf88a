// Writing projects in the layout of the classic tools.
#include <fmt/format.h>

#include <optional>

#include "aesl/project.hpp"

namespace vagus::aesl {
namespace {

// Text between tags. Of the three marks > needs no escape but in "]]>".
std::string escaped_text(std::string_view text) {
    std::string escaped;
    for (const char character : text) {
        switch (character) {
            case '<':
                escaped += "&lt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '\r':
                escaped += "&#13;";
                break;  // else it would be read as a line feed
            case '>':
                escaped += escaped.ends_with("]]") ? "&gt;" : ">";
                break;
            default:
                escaped += character;
        }
    }
    return escaped;
}

std::string escaped_attribute(std::string_view text) {
    std::string escaped;
    for (const char character : text) {
        switch (character) {
            case '<':
                escaped += "&lt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\t':
            case '\n':
            case '\r':
                escaped += fmt::format("&#{};", static_cast<int>(character));
                break;
            default:
                escaped += character;
        }
    }
    return escaped;
}

// A comment cannot hold "--" nor end in "-".
std::string in_comment(std::string_view text) {
    std::string safe;
    for (const char character : text) {
        if (character == '-' && safe.ends_with('-')) safe += ' ';
        safe += character;
    }
    return safe.ends_with('-') ? safe + ' ' : safe;
}

// `<event size="1" name="turning"/>`, on a line of its own; without the number where there is none.
std::string element(std::string_view kind, std::string_view key, std::optional<int32_t> number,
                    std::string_view name) {
    const std::string attribute = number ? fmt::format("{}=\"{}\" ", key, *number) : "";
    return fmt::format("<{} {}name=\"{}\"/>\n", kind, attribute, escaped_attribute(name));
}

std::string script_lines(const Script& script) {
    const std::string id = script.uuid.empty() ? std::to_string(script.node_id) : script.uuid;
    return fmt::format("<!--node {}-->\n<node nodeId=\"{}\" name=\"{}\">{}{}</node>\n",
                       in_comment(script.node), escaped_attribute(id),
                       escaped_attribute(script.node), escaped_text(script.source), script.plugins);
}

}  // namespace

std::string format_project(const Project& project) {
    constexpr std::string_view kGap = "\n\n";
    std::string xml = "<!DOCTYPE aesl-source>\n<network>\n";
    xml += fmt::format("{}<!--list of global events-->\n", kGap);
    for (const GlobalEvent& event : project.common.events)
        xml += element("event", "size", event.size, event.name);
    xml += fmt::format("{}<!--list of constants-->\n", kGap);
    for (const Constant& constant : project.common.constants)
        xml += element("constant", "value", constant.value, constant.name);
    if (!project.keywords.empty())
        xml += fmt::format("{}<!--show keywords state-->\n<keywords flag=\"{}\"/>\n", kGap,
                           escaped_attribute(project.keywords));
    for (const Script& script : project.scripts) xml += std::string(kGap) + script_lines(script);
    if (!project.others.empty()) xml += std::string(kGap) + project.others;
    return xml + std::string(kGap) + "</network>\n";
}

}  // namespace vagus::aesl
