// Reading projects: pugixml makes the tree; this file finds the places, and refuses what pugixml
// lets pass but other tools would not read.
#include "aesl/project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <pugixml.hpp>

#include "aesl/node_file.hpp"
#include "aesl/unicode.hpp"
#include "aesl/xml_scan.hpp"
#include "base/json.hpp"
#include "base/text.hpp"

namespace vagus::aesl {
namespace {

constexpr size_t kUuidLength = 36;
constexpr std::string_view kFixMarkup =
    "in a script write &lt; for < and &amp; for &, or put the script into <![CDATA[ … ]]>";

// A mistake: where in the text, and the sentence.
struct Mistake {
    size_t offset;
    std::string what;
};

Place place_at(std::string_view text, size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    return {static_cast<int>(lines) + 1,
            static_cast<int>(count_code_points(before.substr(line_start))) + 1};
}

bool is_xml_character(char32_t value) {
    if (value < 0x20) return value == '\t' || value == '\n' || value == '\r';
    return value != 0xfffe && value != 0xffff && value <= 0x10ffff &&
           (value < 0xd800 || value > 0xdfff);
}

// Whether `name`, the part between & and ;, is one of XML's five words or names an allowed
// character by its number.
bool is_reference(std::string_view name) {
    constexpr std::string_view kWords[] = {"lt", "gt", "amp", "quot", "apos"};
    if (!name.starts_with('#'))
        return std::find(std::begin(kWords), std::end(kWords), name) != std::end(kWords);
    name.remove_prefix(1);
    const bool is_hexadecimal = name.starts_with('x');
    if (is_hexadecimal) name.remove_prefix(1);
    uint32_t value = 0;
    const auto [end, error] =
        std::from_chars(name.data(), name.data() + name.size(), value, is_hexadecimal ? 16 : 10);
    return error == std::errc() && end == name.data() + name.size() && !name.empty() &&
           is_xml_character(value);
}

std::optional<Mistake> refuse_reference(std::string_view text, size_t offset) {
    constexpr size_t kNameMax = 16;
    const size_t end = text.substr(0, offset + kNameMax).find(';', offset);
    if (end != text.npos && is_reference(text.substr(offset + 1, end - offset - 1)))
        return std::nullopt;
    return Mistake{offset,
                   fmt::format("this & begins no character that XML knows; {}", kFixMarkup)};
}

// Behind the tag, or the text up to the next tag, that begins at `offset`.
size_t piece_end(std::string_view text, size_t offset) {
    if (text[offset] == '<') return behind_start_tag(text, offset);
    return std::min(text.find('<', offset), text.size());
}

// Whether the < at `offset` is followed by what a tag begins with.
bool begins_tag(std::string_view text, size_t offset) {
    if (offset + 1 >= text.size()) return false;
    const auto next = static_cast<unsigned char>(text[offset + 1]);
    return std::isalpha(next) != 0 || next >= 0x80 ||
           std::string_view("/!_:").find(text[offset + 1]) != std::string_view::npos;
}

// A tag or a piece of text: its references, and no < but the first.
std::optional<Mistake> refuse_piece(std::string_view text, size_t start, size_t end) {
    const bool is_doctype = text.substr(start).starts_with("<!");
    const std::string_view piece = text.substr(start, end - start);
    if (piece[0] == '<' && (piece.find('<', 1) != piece.npos || !begins_tag(text, start)))
        return Mistake{start, fmt::format("this < begins no whole tag; {}", kFixMarkup)};
    for (size_t offset = start; offset < end; ++offset) {
        if (text[offset] == '&') {
            if (auto mistake = refuse_reference(text, offset)) return mistake;
        }
        if (text[offset] == '[' && is_doctype)
            return Mistake{offset,
                           "a DOCTYPE with declarations is not read; write "
                           "<!DOCTYPE aesl-source>"};
    }
    return std::nullopt;
}

// What the reader would let pass: bytes and characters that XML does not allow, a bare &.
std::optional<Mistake> refuse_text(std::string_view text) {
    if (text.size() > kProjectBytesMax)
        return Mistake{0, fmt::format("the file is larger than {} MB, the most that is read; "
                                      "split the project",
                                      kProjectBytesMax >> 20)};
    if (const auto bad = malformed_utf8_at(text))
        return Mistake{*bad, "this byte is not UTF-8; save the file as UTF-8"};
    const auto control = std::find_if(text.begin(), text.end(), [](char character) {
        return !is_xml_character(static_cast<uint8_t>(character));
    });
    if (control != text.end())
        return Mistake{static_cast<size_t>(control - text.begin()),
                       "XML cannot contain a control character; remove it"};
    for (size_t offset = 0; offset < text.size();) {
        const size_t behind = skip_opaque(text, offset);
        const size_t end = behind > offset ? behind : piece_end(text, offset);
        if (behind == offset) {
            if (auto mistake = refuse_piece(text, offset, end)) return mistake;
        }
        offset = end;
    }
    return std::nullopt;
}

std::string_view name_of(pugi::xml_node node) {
    return node.name();
}

// Offset of the < of an element.
size_t offset_of(pugi::xml_node element) {
    return static_cast<size_t>(std::max<ptrdiff_t>(element.offset_debug(), 1)) - 1;
}

// "the event "ping"", "the second constant" …: what sentences call an element.
std::string called(pugi::xml_node element) {
    const std::string_view name = element.attribute("name").value();
    if (name.empty()) return fmt::format("a <{}>", name_of(element));
    return fmt::format("the <{}> {}", name_of(element), json_quote(name));
}

std::string as_xml(pugi::xml_node element) {
    struct Collector : pugi::xml_writer {
        void write(const void* bytes, size_t size) override {
            text.append(static_cast<const char*>(bytes), size);
        }
        std::string text;
    } collector;
    element.print(collector, "", pugi::format_raw, pugi::encoding_utf8);
    // A carriage return came from a reference; the library would write it so that it is read as a
    // line feed.
    std::string xml;
    for (const char character : collector.text)
        xml += character == '\r' ? std::string("&#13;") : std::string(1, character);
    return xml;
}

bool is_uuid(std::string_view text) {
    if (text.starts_with('{') && text.ends_with('}')) text = text.substr(1, text.size() - 2);
    const auto is_part = [](char character) {
        return character == '-' || std::isxdigit(static_cast<unsigned char>(character)) != 0;
    };
    return text.size() == kUuidLength && std::all_of(text.begin(), text.end(), is_part);
}

bool is_blank(std::string_view text) {
    return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

bool is_text(pugi::xml_node node) {
    return node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata;
}

struct NumberRange {
    int64_t low;
    int64_t high;
};

// Walks over the tree; the first mistake stops it.
class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    void read(const pugi::xml_document& document) {
        check_depth(document);
        const pugi::xml_node root = document.document_element();
        if (!root) {
            mistake_ = Mistake{0, "the file has no element; a project is a <network>"};
            return;
        }
        check_document(document, root);
        for (const pugi::xml_node child : root.children())
            if (!mistake_) read_child(child);
    }

    Project take_project() { return std::move(project_); }
    const std::optional<Mistake>& mistake() const { return mistake_; }

private:
    void refuse(pugi::xml_node element, std::string what) {
        if (!mistake_) mistake_ = Mistake{offset_of(element), std::move(what)};
    }

    void check_depth(const pugi::xml_document& document) {
        struct Walker : pugi::xml_tree_walker {
            bool for_each(pugi::xml_node& node) override {
                if (static_cast<size_t>(depth()) < kProjectDepthMax) return true;
                too_deep = node;
                return false;
            }
            pugi::xml_node too_deep;
        } walker;
        const_cast<pugi::xml_document&>(document).traverse(walker);  // it only reads
        if (walker.too_deep)
            refuse(walker.too_deep, fmt::format("elements are nested more than {} deep; write the "
                                                "file flatter",
                                                kProjectDepthMax));
    }

    void check_document(const pugi::xml_document& document, pugi::xml_node root) {
        if (name_of(root) != "network")
            refuse(root,
                   fmt::format("the file holds a <{}>; a project is a <network>", name_of(root)));
        for (const pugi::xml_node child : document.children()) {
            if (child.type() == pugi::node_element && child != root)
                refuse(child, fmt::format("a second outermost element, <{}>; move it into the "
                                          "<network> or remove it",
                                          name_of(child)));
            if (is_text(child) && !is_blank(child.value()))
                refuse(root, "there is text outside of the <network>; remove it");
        }
    }

    void read_child(pugi::xml_node child) {
        if (is_text(child)) {
            if (!is_blank(child.value()))
                refuse(child.parent(),
                       "the <network> has text outside of its elements; move it "
                       "into a <node> or remove it");
        } else if (child.type() != pugi::node_element) {
            return;  // a comment
        } else if (name_of(child) == "event") {
            read_event(child);
        } else if (name_of(child) == "constant") {
            read_constant(child);
        } else if (name_of(child) == "keywords") {
            project_.keywords = child.attribute("flag").value();
        } else if (name_of(child) == "node") {
            read_script(child);
        } else {
            project_.others += as_xml(child) + "\n";
        }
    }

    std::string read_name(pugi::xml_node element) {
        const std::string name = element.attribute("name").value();
        if (name.empty())
            refuse(element, fmt::format("{} has no name; add name=\"…\"", called(element)));
        if (name.size() > kNameBytesMax)
            refuse(element, fmt::format("a <{}> has a name of {} bytes; use at most {}",
                                        name_of(element), name.size(), kNameBytesMax));
        return name;
    }

    int64_t read_number(pugi::xml_node element, const char* key, NumberRange range) {
        const std::string_view written = element.attribute(key).value();
        const bool has_plus = written.starts_with('+');
        int64_t value = 0;
        const auto [end, error] =
            std::from_chars(written.data(), written.data() + written.size(), value);
        const bool is_number = error == std::errc() && end == written.data() + written.size();
        if (is_number && !has_plus && value >= range.low && value <= range.high) return value;
        refuse(element, fmt::format("\"{}\" of {} is {}; write a whole number from {} to {}", key,
                                    called(element), json_quote(written.substr(0, 40)), range.low,
                                    range.high));
        return 0;
    }

    void read_event(pugi::xml_node element) {
        GlobalEvent event{read_name(element), std::nullopt};
        if (element.attribute("size")) {
            const NumberRange range{0, static_cast<int64_t>(kEventWordsMax)};
            event.size = static_cast<uint16_t>(read_number(element, "size", range));
        }
        project_.common.events.push_back(std::move(event));
    }

    void read_constant(pugi::xml_node element) {
        Constant constant{read_name(element), 0};
        if (!element.attribute("value"))
            refuse(element, fmt::format("{} has no value; add value=\"…\"", called(element)));
        constant.value =
            static_cast<int32_t>(read_number(element, "value", {INT32_MIN, INT32_MAX}));
        project_.common.constants.push_back(std::move(constant));
    }

    void read_script(pugi::xml_node element) {
        Script script;
        script.node = read_name(element);
        const std::string_view id = element.attribute("nodeId").value();
        if (is_uuid(id)) {
            script.uuid = id;
        } else if (element.attribute("nodeId")) {
            script.node_id = static_cast<uint16_t>(read_number(element, "nodeId", {0, UINT16_MAX}));
        } else {
            script.node_id = 0;
        }
        for (const pugi::xml_node child : element.children()) {
            if (child.type() == pugi::node_element) script.plugins += as_xml(child);
            if (is_text(child)) script.source += child.value();
        }
        script.first_line = line_of(behind_start_tag(text_, offset_of(element)));
        project_.scripts.push_back(std::move(script));
    }

    // The scripts come in the order of the text, so each line feed is counted once.
    int line_of(size_t offset) {
        const std::string_view between = text_.substr(counted_, offset - counted_);
        line_ += static_cast<int>(std::count(between.begin(), between.end(), '\n'));
        counted_ = offset;
        return line_;
    }

    std::string_view text_;
    size_t counted_ = 0;  // line feeds before this offset are in `line_`
    int line_ = 1;
    Project project_;
    std::optional<Mistake> mistake_;
};

std::optional<Mistake> load(pugi::xml_document& document, std::string_view text) {
    if (auto mistake = refuse_text(text)) return mistake;
    // White space stays as it is written: it belongs to the scripts. Text outside of the outermost
    // element is kept so that it can be refused.
    const unsigned options = pugi::parse_cdata | pugi::parse_escapes | pugi::parse_eol |
                             pugi::parse_ws_pcdata | pugi::parse_fragment |
                             pugi::parse_wconv_attribute;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
    if (parsed) return std::nullopt;
    const auto offset = static_cast<size_t>(std::max<ptrdiff_t>(parsed.offset, 0));
    const std::string what = fmt::format("this is not XML: {}", parsed.description());
    return Mistake{std::min(offset, text.size()), fmt::format("{}; {}", what, kFixMarkup)};
}

}  // namespace

Result<Project> parse_project(std::string_view xml, std::string_view file) {
    std::string_view text = xml;
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    pugi::xml_document document;
    std::optional<Mistake> mistake = load(document, text);
    Reader reader(text);
    if (!mistake) {
        reader.read(document);
        mistake = reader.mistake();
    }
    if (!mistake) return reader.take_project();
    return Error{Code::BadInput, at_place(file, place_at(text, mistake->offset), mistake->what)};
}

namespace {

// The first script of that name for which `fits` is true; -1 if there is none.
template <typename Fits>
int first_script(const Project& project, std::string_view name, const Fits& fits) {
    for (size_t i = 0; i < project.scripts.size(); ++i) {
        if (project.scripts[i].node == name && fits(i)) return static_cast<int>(i);
    }
    return -1;
}

}  // namespace

std::vector<int> scripts_for(const Project& project, std::span<const NodeName> nodes) {
    std::vector<bool> used(project.scripts.size());
    std::vector<int> found;
    for (const NodeName& node : nodes) {
        found.push_back(first_script(project, node.name, [&](size_t i) {
            return project.scripts[i].node_id == node.id && !used[i];
        }));
        if (found.back() >= 0) used[static_cast<size_t>(found.back())] = true;
    }
    for (size_t n = 0; n < nodes.size(); ++n) {
        if (found[n] >= 0) continue;
        found[n] = first_script(project, nodes[n].name, [&](size_t i) { return !used[i]; });
        if (found[n] >= 0) {
            used[static_cast<size_t>(found[n])] = true;
        } else {
            found[n] = first_script(project, nodes[n].name, [](size_t) { return true; });
        }
    }
    return found;
}

}  // namespace vagus::aesl
