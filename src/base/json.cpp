// Reading JSON into a tree with places. The library's reader says what the tokens are and what is
// wrong; a cursor of our own walks over the same text and says where they are.
#include "base/json.hpp"

#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/json_slips.hpp"
#include "base/text.hpp"

namespace vagus {
namespace {

// A character of a number, or of true, false and null.
bool is_word(char byte) {
    return std::isalnum(static_cast<unsigned char>(byte)) != 0 || byte == '+' || byte == '-' ||
           byte == '.';
}

// Walks over the text token by token. The reader has found each token well-formed before the cursor
// comes to it.
class Cursor {
public:
    explicit Cursor(std::string_view text) : text_(text) {}

    Place place() const { return place_; }

    // Stops at the next token; commas and colons are no tokens here.
    void skip_to_token() {
        while (offset_ < text_.size() && is_between_tokens(text_[offset_])) advance_to(offset_ + 1);
    }

    // The token as written: a whole string, number or word, or one bracket.
    std::string_view take_token() {
        const size_t start = offset_;
        advance_to(token_end());
        return text_.substr(start, offset_ - start);
    }

    void advance_to(size_t offset) {
        for (; offset_ < offset && offset_ < text_.size(); ++offset_) {
            const auto byte = static_cast<unsigned char>(text_[offset_]);
            if (byte == '\n') {
                place_ = {place_.line + 1, 1};
            } else if ((byte & 0xc0u) != 0x80u) {
                ++place_.column;
            } else {
                // A continuation byte: the column counted its code point already.
            }
        }
    }

private:
    static bool is_between_tokens(char byte) {
        return std::string_view(" \t\r\n,:").find(byte) != std::string_view::npos;
    }

    size_t token_end() const {
        size_t end = offset_;
        if (text_[end] == '"') return string_end();
        while (end < text_.size() && is_word(text_[end])) ++end;
        return end == offset_ ? end + 1 : end;
    }

    size_t string_end() const {
        size_t end = offset_ + 1;
        while (end < text_.size() && text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
        return end + 1;
    }

    std::string_view text_;
    size_t offset_ = 0;
    Place place_{1, 1};
};

Place place_of(std::string_view text, size_t offset) {
    Cursor cursor(text);
    cursor.advance_to(offset);
    return cursor.place();
}

// The useful part of "[json.exception.parse_error.101] parse error at line 1, column 5: syntax
// error while parsing value - invalid literal; last read: 'nux'; expected …".
std::string reason_of(std::string_view message) {
    constexpr std::string_view kLastRead = "; last read: ";
    if (const size_t dash = message.find(" - "); dash != message.npos)
        message.remove_prefix(dash + 3);
    const size_t last_read = message.find(kLastRead);
    if (last_read == message.npos) return std::string(message);
    std::string reason(message.substr(0, last_read));
    const size_t expected = message.rfind("; expected ");
    if (expected != message.npos && expected > last_read) reason += message.substr(expected);
    return reason;
}

// Receives the reader's events in the order of the text and grows the tree.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit TreeBuilder(std::string_view text) : text_(text), cursor_(text) {}

    bool null() override {
        add(JsonKind::Null);
        return has_room();
    }

    bool boolean(bool value) override {
        add(JsonKind::Bool)->boolean = value;
        return has_room();
    }

    bool number_integer(number_integer_t value) override {
        JsonValue* json = add(JsonKind::Int);
        json->integer = value;
        json->number = static_cast<double>(value);
        return has_room();
    }

    bool number_unsigned(number_unsigned_t value) override {
        if (value > static_cast<uint64_t>(INT64_MAX)) return refuse_long_integer();
        return number_integer(static_cast<int64_t>(value));
    }

    bool number_float(number_float_t value, const string_t& written) override {
        if (written.find_first_of(".eE") == std::string::npos) return refuse_long_integer();
        add(JsonKind::Float)->number = value;
        return has_room();
    }

    bool string(string_t& value) override {
        add(JsonKind::String)->text = value;
        return has_room();
    }

    // Only the library's binary formats have such values.
    bool binary(binary_t&) override { return refuse("binary values are not part of JSON"); }

    bool start_object(std::size_t) override { return open(JsonKind::Object); }
    bool start_array(std::size_t) override { return open(JsonKind::Array); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& value) override {
        cursor_.skip_to_token();
        JsonMember member;
        member.at = cursor_.place();
        member.raw_key = cursor_.take_token();
        member.key = value;
        open_.back()->members.push_back(std::move(member));
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        if (error.id == kOutOfRange) return refuse_out_of_range(token);
        if (const auto slip = find_json_slip(text_)) {
            error_ = JsonError{place_of(text_, slip->offset), "this is not JSON: " + slip->what};
            return false;
        }
        const std::string reason = reason_of(error.what());
        error_ = JsonError{place_of_error(position, reason), "this is not JSON: " + reason};
        return false;
    }

    std::variant<JsonValue, JsonError> take_result() {
        if (error_) return std::move(*error_);
        return std::move(root_);
    }

private:
    static constexpr int kOutOfRange =
        406;  // the library's number for a number that no double holds

    // `position` is behind the last character read. A broken token is marked where it breaks, a
    // token that is in a wrong place where it begins.
    Place place_of_error(size_t position, const std::string& reason) {
        if (position > text_.size()) return place_of(text_, text_.size());
        size_t at = position == 0 ? 0 : position - 1;
        if (reason.starts_with("invalid") || text_.empty()) return place_of(text_, at);
        if (text_[at] == '"') {
            cursor_.skip_to_token();
            return cursor_.place();
        }
        while (at > 0 && is_word(text_[at]) && is_word(text_[at - 1])) --at;
        return place_of(text_, at);
    }

    bool refuse(std::string what) {
        cursor_.skip_to_token();
        error_ = JsonError{cursor_.place(), std::move(what)};
        return false;
    }

    bool refuse_long_integer() {
        return refuse("the whole number does not fit 64 bits; write one from " +
                      std::to_string(INT64_MIN) + " to " + std::to_string(INT64_MAX));
    }

    bool refuse_out_of_range(const std::string& written) {
        return refuse("the number " + written.substr(0, 40) +
                      " is out of range; write one between -1.7e308 and 1.7e308");
    }

    // Not one value more than allowed: false ends the reading.
    bool has_room() {
        if (values_ <= kJsonValuesMax) return true;
        return refuse("the text has more than " + std::to_string(kJsonValuesMax) +
                      " values; split it");
    }

    // Puts a value of `kind` where the next one belongs and fills what the text says about it.
    JsonValue* add(JsonKind kind) {
        ++values_;
        JsonValue* json = &root_;
        if (!open_.empty()) {
            JsonValue& parent = *open_.back();
            json = parent.kind == JsonKind::Array ? &parent.items.emplace_back()
                                                  : &parent.members.back().value;
        }
        cursor_.skip_to_token();
        json->kind = kind;
        json->at = cursor_.place();
        const std::string_view written = cursor_.take_token();
        if (kind == JsonKind::String) json->raw = written;
        if (json->is_number()) json->text = written;
        return json;
    }

    bool open(JsonKind kind) {
        if (open_.size() >= kJsonDepthMax)
            return refuse("arrays and objects are nested more than " +
                          std::to_string(kJsonDepthMax) + " deep; write the file flatter");
        open_.push_back(add(kind));
        return has_room();
    }

    bool close() {
        cursor_.skip_to_token();
        cursor_.take_token();
        open_.pop_back();
        return true;
    }

    std::string_view text_;
    Cursor cursor_;
    JsonValue root_;
    // Stays valid: a parent gets no new item while a child of it is open.
    std::vector<JsonValue*> open_;
    size_t values_ = 0;
    std::optional<JsonError> error_;
};

// What the library lets pass or would judge later than we want.
std::optional<JsonError> refuse_text(std::string_view text) {
    if (text.size() > kJsonBytesMax)
        return JsonError{{1, 1},
                         "the text is larger than " + std::to_string(kJsonBytesMax >> 20) +
                             " MB, the most that is read; split it"};
    if (text.starts_with("\xef\xbb\xbf"))
        return JsonError{{1, 1}, "the text begins with a byte order mark; save it without one"};
    if (const auto bad = malformed_utf8_at(text))
        return JsonError{place_of(text, *bad), "this byte is not UTF-8; save the file as UTF-8"};
    if (const size_t zero = text.find('\0'); zero != text.npos)
        return JsonError{place_of(text, zero), "JSON cannot contain a zero byte; remove it"};
    return std::nullopt;
}

}  // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
    for (const JsonMember& member : members)
        if (member.key == key) return &member.value;
    return nullptr;
}

std::string text_in(const JsonValue& object, std::string_view key) {
    const JsonValue* const value = object.find(key);
    return value != nullptr ? value->text : "";
}

std::string_view name_of(JsonKind kind) {
    switch (kind) {
        case JsonKind::Null:
            return "null";
        case JsonKind::Bool:
            return "true or false";
        case JsonKind::Int:
            return "a whole number";
        case JsonKind::Float:
            return "a number with a fraction";
        case JsonKind::String:
            return "a string";
        case JsonKind::Array:
            return "an array";
        case JsonKind::Object:
            return "an object";
    }
    return "";
}

std::variant<JsonValue, JsonError> read_json(std::string_view text) {
    if (auto refused = refuse_text(text)) return std::move(*refused);
    TreeBuilder builder(text);
    // The reader keeps its own stack on the heap, so that depth costs no stack of ours.
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return builder.take_result();
}

std::string at_file(std::string_view file, Place at) {
    std::string text(file);
    if (at.line > 0) text += ":" + std::to_string(at.line);
    if (at.line > 0 && at.column > 0) text += ":" + std::to_string(at.column);
    return text;
}

std::string at_place(std::string_view file, Place at, std::string_view sentence) {
    return at_file(file, at) + ": " + std::string(sentence);
}

Result<JsonValue> parse_json(std::string_view text, std::string_view file) {
    auto read = read_json(text);
    if (auto* json = std::get_if<JsonValue>(&read)) return std::move(*json);
    const JsonError& error = std::get<JsonError>(read);
    return Error{Code::BadInput, at_place(file, error.at, error.what)};
}

}  // namespace vagus
