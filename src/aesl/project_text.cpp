#include "aesl/project_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "aesl/xml_scan.hpp"
#include "base/text.hpp"

namespace vagus::aesl {

namespace {

// One character of a text as the reader sees it, and the bytes that it takes in the file.
struct Character {
    std::string text;
    size_t bytes = 1;
};

std::string referred(std::string_view name) {
    if (name == "lt") return "<";
    if (name == "gt") return ">";
    if (name == "amp") return "&";
    if (name == "quot") return "\"";
    if (name == "apos") return "'";
    const bool hexadecimal = name.starts_with("#x");
    name.remove_prefix(std::min<size_t>(name.size(), hexadecimal ? 2 : 1));
    uint32_t value = 0;
    std::from_chars(name.data(), name.data() + name.size(), value, hexadecimal ? 16 : 10);
    return to_utf8(static_cast<char32_t>(value));
}

Character character_at(std::string_view text, size_t offset, bool literal) {
    if (text[offset] == '\r') {
        const bool pair = text.substr(offset).starts_with("\r\n");
        return {"\n", pair ? size_t{2} : size_t{1}};
    }
    if (literal || text[offset] != '&') return {std::string(1, text[offset])};
    const size_t end = text.find(';', offset);
    if (end == text.npos) return {std::string(1, text[offset])};
    return {referred(text.substr(offset + 1, end - offset - 1)), end + 1 - offset};
}

std::string escaped(std::string_view text, std::string_view line_end) {
    std::string result;
    for (const char character : text) {
        switch (character) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\n':
                result += line_end;
                break;
            default:
                result += character;
        }
    }
    return result;
}

// In a script quotes may stay as they are.
std::string escaped_text(std::string_view text, std::string_view line_end) {
    std::string result = escaped(text, line_end);
    for (size_t at = 0; (at = result.find("&quot;", at)) != std::string::npos; ++at) {
        result.replace(at, 6, "\"");
    }
    return result;
}

std::string in_cdata(std::string_view text, std::string_view line_end) {
    std::string result;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text.substr(i).starts_with("]]>")) {
            result += "]]]]><![CDATA[>";
            i += 2;
        } else if (text[i] == '\n') {
            result += line_end;
        } else {
            result += text[i];
        }
    }
    return result;
}

bool is_blank(char character) {
    return character == ' ' || character == '\t' || character == '\n' || character == '\r';
}

}  // namespace

ProjectText::ProjectText(std::string_view text) : text_(text) {
    scan();
}

// The children of the outermost element; what they hold is passed over.
void ProjectText::scan() {
    const std::string_view text = text_;
    bool inside = false;
    for (size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
        const size_t behind = skip_opaque(text, at);
        if (behind > at || text.substr(at).starts_with("<!")) {
            at = behind > at ? behind : behind_start_tag(text, at);
            continue;
        }
        if (text.substr(at).starts_with("</")) return;  // of the outermost
        Element element;
        element.begin = at;
        element.tag_end = behind_start_tag(text, at);
        element.empty = element.tag_end >= 2 && text[element.tag_end - 2] == '/';
        const size_t name_end = text.find_first_of(" \t\r\n/>", at);
        element.name = text.substr(at + 1, name_end - at - 1);
        at = element.tag_end;
        if (!inside) {
            inside = true;
            content_begin_ = at;
            if (element.empty) return;
            continue;
        }
        element.end = element.empty ? at : element_end(at);
        at = element.end;
        if (element.name == "node") nodes_.push_back(elements_.size());
        elements_.push_back(std::move(element));
    }
}

size_t ProjectText::element_end(size_t at) const {
    const std::string_view text = text_;
    int depth = 1;
    while (depth > 0 && (at = text.find('<', at)) < text.size()) {
        const size_t behind = skip_opaque(text, at);
        if (behind > at) {
            at = behind;
            continue;
        }
        const bool closes = text.substr(at).starts_with("</");
        at = behind_start_tag(text, at);
        if (closes) --depth;
        if (!closes && text[at - 2] != '/') ++depth;
    }
    return std::min(at, text.size());
}

std::vector<ProjectText::Piece> ProjectText::pieces(const Element& node) const {
    constexpr std::string_view kCdata = "<![CDATA[";
    const std::string_view text = text_;
    std::vector<Piece> found;
    size_t at = node.tag_end;
    while (!node.empty && at < node.end) {
        if (text[at] != '<') {
            const size_t end = std::min(text.find('<', at), node.end);
            found.push_back({at, end, false});
            at = end;
        } else if (text.substr(at).starts_with(kCdata)) {
            const size_t end = skip_opaque(text, at);
            found.push_back({at + kCdata.size(), end - 3, true});
            at = end;
        } else if (const size_t behind = skip_opaque(text, at); behind > at) {
            at = behind;
        } else if (text.substr(at).starts_with("</")) {
            break;
        } else {
            const size_t behind_tag = behind_start_tag(text, at);
            at = text[behind_tag - 2] == '/' ? behind_tag : element_end(behind_tag);
        }
    }
    if (found.empty()) found.push_back({node.tag_end, node.tag_end, false});
    return found;
}

std::string ProjectText::script(size_t index) const {
    std::string source;
    for (const Piece& piece : pieces(elements_[nodes_[index]])) {
        for (size_t at = piece.begin; at < piece.end;) {
            const Character character = character_at(text_, at, piece.literal);
            source += character.text;
            at += character.bytes;
        }
    }
    return source;
}

std::string ProjectText::replace(size_t index, size_t from, size_t to,
                                 std::string_view insert) const {
    const Element& node = elements_[nodes_[index]];
    const std::vector<Piece> all = pieces(node);
    std::string changed = text_.substr(0, all.front().begin);
    size_t copied = all.front().begin;  // of the file
    size_t seen = 0;                    // of the script
    bool inserted = false;
    const auto put = [&](bool literal) {
        if (!inserted)
            changed += literal ? in_cdata(insert, line_end()) : escaped_text(insert, line_end());
        inserted = true;
    };
    for (const Piece& piece : all) {
        changed += text_.substr(copied, piece.begin - copied);
        for (size_t at = piece.begin; at < piece.end;) {
            const Character character = character_at(text_, at, piece.literal);
            if (seen >= from) put(piece.literal);
            if (seen < from || seen >= to) changed += text_.substr(at, character.bytes);
            at += character.bytes;
            seen += character.text.size();
        }
        copied = piece.end;
        const bool last = &piece == &all.back();
        if (seen >= from && (last || seen > from)) put(piece.literal);
    }
    changed += text_.substr(copied);
    if (!node.empty || insert.empty()) return changed;
    // <node name="a"/> becomes <node name="a">…</node>.
    changed.insert(node.tag_end + (changed.size() - text_.size()), "</node>");
    changed.erase(node.tag_end - 2, 1);
    return changed;
}

std::string ProjectText::attribute(const Element& element, std::string_view key) const {
    const std::string_view tag =
        std::string_view(text_).substr(element.begin, element.tag_end - element.begin);
    for (size_t at = tag.find(key); at != tag.npos; at = tag.find(key, at + 1)) {
        size_t behind = at + key.size();
        while (behind < tag.size() && is_blank(tag[behind])) ++behind;
        if (!is_blank(tag[at - 1]) || behind >= tag.size() || tag[behind] != '=') continue;
        const size_t open = tag.find_first_of("\"'", behind);
        const size_t close = open == tag.npos ? open : tag.find(tag[open], open + 1);
        if (close == tag.npos) return {};
        std::string value;
        for (size_t i = open + 1; i < close;) {
            const Character character = character_at(tag, i, false);
            value += character.text;
            i += character.bytes;
        }
        return value;
    }
    return {};
}

std::vector<const ProjectText::Element*> ProjectText::definitions(std::string_view name) const {
    std::vector<const Element*> found;
    for (const Element& element : elements_) {
        if (element.name == name) found.push_back(&element);
    }
    return found;
}

const ProjectText::Element* ProjectText::find(std::string_view element,
                                              std::string_view name) const {
    for (const Element* one : definitions(element)) {
        if (attribute(*one, "name") == name) return one;
    }
    return nullptr;
}

std::string ProjectText::line_end() const {
    return text_.find("\r\n") == std::string::npos ? "\n" : "\r\n";
}

std::string ProjectText::written(const Definition& definition) const {
    const std::string name = escaped(definition.name, " ");
    return definition.element == "event"
               ? fmt::format("<event size=\"{}\" name=\"{}\"/>", definition.value, name)
               : fmt::format("<constant value=\"{}\" name=\"{}\"/>", definition.value, name);
}

// Behind the last of its kind and in its indentation, or as the first thing of the file.
std::string ProjectText::add(const Definition& definition) const {
    const auto there = definitions(definition.element);
    std::string changed = text_;
    if (there.empty()) {
        const auto events = definitions("event");
        const size_t at = events.empty() ? content_begin_ : events.back()->end;
        return changed.insert(at, line_end() + "    " + written(definition));
    }
    size_t line = there.back()->begin;
    while (line > 0 && (text_[line - 1] == ' ' || text_[line - 1] == '\t')) --line;
    const std::string indent = text_.substr(line, there.back()->begin - line);
    return changed.insert(there.back()->end, line_end() + indent + written(definition));
}

std::string ProjectText::add_script(std::string_view node, uint16_t node_id) const {
    std::string changed = text_;
    size_t at = content_begin_;
    if (!elements_.empty()) at = elements_.back().end;
    const std::string end = line_end();
    return changed.insert(at, end + end + end +
                                  fmt::format("<node nodeId=\"{}\" name=\"{}\"><![CDATA[]]></node>",
                                              node_id, escaped(node, " ")));
}

// The element, and its line if nothing else is on it.
std::string ProjectText::without(const Element& element) const {
    size_t begin = element.begin, end = element.end;
    while (begin > 0 && (text_[begin - 1] == ' ' || text_[begin - 1] == '\t')) --begin;
    while (end < text_.size() && (text_[end] == ' ' || text_[end] == '\t' || text_[end] == '\r')) {
        ++end;
    }
    const bool alone =
        begin > 0 && text_[begin - 1] == '\n' && end < text_.size() && text_[end] == '\n';
    return alone ? text_.substr(0, begin) + text_.substr(end + 1)
                 : text_.substr(0, element.begin) + text_.substr(element.end);
}

std::optional<std::string> ProjectText::remove(std::string_view element,
                                               std::string_view name) const {
    const Element* found = find(element, name);
    if (!found) return std::nullopt;
    return without(*found);
}

std::optional<std::string> ProjectText::change(std::string_view element, std::string_view name,
                                               const Definition& to) const {
    const Element* found = find(element, name);
    if (!found) return std::nullopt;
    return text_.substr(0, found->begin) + written(to) + text_.substr(found->end);
}

// The lines stay; what the definitions say goes round.
std::optional<std::string> ProjectText::move(std::string_view element, std::string_view name,
                                             size_t to) const {
    const auto all = definitions(element);
    const Element* found = find(element, name);
    if (!found) return std::nullopt;
    std::vector<const Element*> order = all;
    order.erase(std::find(order.begin(), order.end(), found));
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(std::min(to, order.size())), found);
    std::string changed;
    size_t copied = 0;
    for (size_t i = 0; i < all.size(); ++i) {
        changed += text_.substr(copied, all[i]->begin - copied);
        changed += text_.substr(order[i]->begin, order[i]->end - order[i]->begin);
        copied = all[i]->end;
    }
    return changed + text_.substr(copied);
}

}  // namespace vagus::aesl
