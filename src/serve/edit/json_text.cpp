#include "serve/edit/json_text.hpp"

#include <algorithm>

namespace vagus::serve {

namespace {

using Part = JsonText::Part;

constexpr std::string_view kBlanks = " \t\r\n";

// Over a text that is known to be JSON, whose depth is limited (base/json.hpp).
class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    JsonText value() {
        const char first = peek();
        if (first == '{' || first == '[') return container(first == '{');
        JsonText scalar;
        scalar.raw = first == '"' ? string() : word();
        return scalar;
    }
    std::string blanks() {
        const size_t end = std::min(text_.find_first_not_of(kBlanks, at_), text_.size());
        return take(end);
    }

private:
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    std::string take(size_t end) {
        std::string taken(text_.substr(at_, end - at_));
        at_ = end;
        return taken;
    }
    std::string word() {
        return take(std::min(text_.find_first_of(" \t\r\n,]}", at_), text_.size()));
    }
    std::string string() {
        size_t end = at_ + 1;
        while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
        return take(std::min(end + 1, text_.size()));
    }

    JsonText container(bool object) {
        JsonText found;
        found.kind = object ? JsonText::Kind::Object : JsonText::Kind::Array;
        ++at_;
        std::string before = blanks();
        while (at_ < text_.size() && peek() != '}' && peek() != ']') {
            found.parts.push_back(part(object, std::move(before)));
            if (peek() != ',') break;
            ++at_;
            before = blanks();
        }
        found.tail = std::move(before);
        if (!found.parts.empty()) {
            found.tail = std::exchange(found.parts.back().after, "");
        }
        ++at_;
        return found;
    }

    Part part(bool object, std::string before) {
        Part part;
        part.before = std::move(before);
        if (object) {
            part.raw_key = string();
            const auto key = read_json(part.raw_key);
            if (const auto* json = std::get_if<JsonValue>(&key)) part.key = json->text;
            const size_t colon = text_.find(':', at_);
            const size_t end = text_.find_first_not_of(kBlanks, colon + 1);
            part.between = take(std::min(end, text_.size()));
        }
        part.value = value();
        part.after = blanks();
        return part;
    }

    std::string_view text_;
    size_t at_ = 0;
};

// The blanks before the part behind another, by those before the other.
std::string like(const std::string& before) {
    return before.find('\n') == before.npos ? " " : before;
}

}  // namespace

JsonText JsonText::read(std::string_view text) {
    Reader reader(text);
    reader.blanks();
    return reader.value();
}

std::string JsonText::text() const {
    std::string text;
    write_to(text);
    return text;
}

void JsonText::write_to(std::string& text) const {
    if (kind == Kind::Scalar) {
        text += raw;
        return;
    }
    text += kind == Kind::Object ? '{' : '[';
    for (size_t i = 0; i < parts.size(); ++i) {
        const Part& part = parts[i];
        text += part.before;
        text += part.raw_key;
        text += part.between;
        part.value.write_to(text);
        text += part.after;
        if (i + 1 < parts.size()) text += ',';
    }
    text += tail;
    text += kind == Kind::Object ? '}' : ']';
}

Part* JsonText::find(std::string_view key) {
    const auto found =
        std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.key == key; });
    return kind == Kind::Object && found != parts.end() ? &*found : nullptr;
}

bool JsonText::is_open() const {
    return !parts.empty() && parts.front().before.find('\n') != std::string::npos;
}

Part JsonText::take(size_t index) {
    Part taken = std::move(parts[index]);
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(index));
    // The first place keeps its blanks.
    if (index == 0 && !parts.empty()) parts.front().before = taken.before;
    if (parts.empty()) tail.clear();
    return taken;
}

void JsonText::insert(size_t index, Part part, size_t depth) {
    part.after.clear();
    if (parts.empty()) {
        const bool open = kind == Kind::Object && depth <= 1;
        part.before =
            open ? "\n" + std::string(depth * 2 + 2, ' ') : (kind == Kind::Object ? " " : "");
        tail = open ? "\n" + std::string(depth * 2, ' ') : part.before;
    } else if (index == 0) {
        part.before = parts.front().before;
        parts.front().before = parts.size() > 1 ? parts[1].before : like(part.before);
    } else if (index < parts.size()) {
        part.before = parts[index].before;
    } else {
        part.before = parts.size() > 1 ? parts.back().before : like(parts.front().before);
    }
    parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(index), std::move(part));
}

}  // namespace vagus::serve
