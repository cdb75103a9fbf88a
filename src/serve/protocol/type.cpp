#include "serve/protocol/type.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

// Reads one type from the front of a text.
class TypeReader {
public:
    explicit TypeReader(std::string_view text) : rest_(text) {}

    Result<Type> type(size_t depth = 0) {
        if (depth > kTypeDepthMax) return wrong("types nest too deep");
        if (take('[')) return list(Type::Kind::List, ']', depth);
        if (take('{')) return list(Type::Kind::Map, '}', depth);
        const std::string name = word();
        if (name.empty()) return wrong("expected the name of a type");
        if (std::isupper(static_cast<unsigned char>(name[0]))) {
            Type type;
            type.kind = Type::Kind::Named;
            type.name = name;
            return type;
        }
        return plain(name);
    }

    bool take(char mark) {
        skip();
        if (rest_.empty() || rest_[0] != mark) return false;
        rest_.remove_prefix(1);
        return true;
    }
    bool at_end() {
        skip();
        return rest_.empty();
    }
    std::string_view rest() const { return rest_; }
    Error wrong(const std::string& what) const {
        return {Code::BadInput, fmt::format("{} before “{}”", what, rest_)};
    }

private:
    void skip() {
        while (!rest_.empty() && rest_[0] == ' ') rest_.remove_prefix(1);
    }

    std::string word() {
        skip();
        size_t size = 0;
        while (size < rest_.size() && (std::isalnum(static_cast<unsigned char>(rest_[size])) ||
                                       rest_[size] == '_' || rest_[size] == '-')) {
            ++size;
        }
        const std::string found(rest_.substr(0, size));
        rest_.remove_prefix(size);
        return found;
    }

    Result<Type> list(Type::Kind kind, char end, size_t depth) {
        Type type;
        type.kind = kind;
        type.item = std::make_shared<const Type>(TRY(this->type(depth + 1)));
        if (!take(';')) return wrong("expected ; and the most items");
        type.size_max = static_cast<size_t>(TRY(number()));
        if (!take(end)) return wrong("expected the end of the list");
        return type;
    }

    Result<double> number() {
        skip();
        size_t size = 0;
        while (size < rest_.size() &&
               (std::isdigit(static_cast<unsigned char>(rest_[size])) || rest_[size] == '-' ||
                (rest_[size] == '.' && rest_.substr(size, 2) != ".."))) {
            ++size;
        }
        if (size == 0) return wrong("expected a number");
        const double value = std::strtod(std::string(rest_.substr(0, size)).c_str(), nullptr);
        rest_.remove_prefix(size);
        return value;
    }

    Result<Type> plain(const std::string& name) {
        Type type;
        if (name == "bool") {
            type.kind = Type::Kind::Bool;
        } else if (name == "json") {
            type.kind = Type::Kind::Any;
        } else if (name == "line" || name == "text") {
            type.kind = name == "line" ? Type::Kind::Line : Type::Kind::Text;
            if (!take('(')) return wrong("expected the most bytes");
            type.size_max = static_cast<size_t>(TRY(number()));
            if (!take(')')) return wrong("expected )");
        } else if (name == "int" || name == "number") {
            return ranged(name == "int" ? Type::Kind::Int : Type::Kind::Number);
        } else if (name == "word") {
            return choice();
        } else {
            return wrong("unknown type " + name);
        }
        return type;
    }

    Result<Type> ranged(Type::Kind kind) {
        Type type;
        type.kind = kind;
        type.low = -std::numeric_limits<double>::max();
        type.high = std::numeric_limits<double>::max();
        if (!take('(')) return type;
        type.low = TRY(number());
        if (!take('.') || !take('.')) return wrong("expected ..");
        type.high = TRY(number());
        if (!take(')')) return wrong("expected )");
        return type;
    }

    Result<Type> choice() {
        Type type;
        type.kind = Type::Kind::Word;
        if (!take('(')) return wrong("expected the words");
        do {
            type.words.push_back(word());
        } while (take('|'));
        if (!take(')')) return wrong("expected )");
        return type;
    }

    std::string_view rest_;
};

const char* name_of_kind(const Json& value) {
    switch (value.type()) {
        case Json::value_t::null:
            return "null";
        case Json::value_t::object:
            return "an object";
        case Json::value_t::array:
            return "a list";
        case Json::value_t::string:
            return "a text";
        case Json::value_t::boolean:
            return "true or false";
        case Json::value_t::number_float:
            return "a number";
        case Json::value_t::number_integer:
        case Json::value_t::number_unsigned:
            return "a whole number";
        case Json::value_t::binary:
        case Json::value_t::discarded:
            break;
    }
    return "something else";
}

std::string expected(const std::string& place, const std::string& what, const Json& found) {
    return fmt::format("{}: expected {}, found {}", place, what, name_of_kind(found));
}

std::optional<std::string> fault_of_number(const Json& value, const Type& type,
                                           const std::string& place) {
    const bool whole = type.kind == Type::Kind::Int;
    if (whole ? !value.is_number_integer() : !value.is_number()) {
        return expected(place, whole ? "a whole number" : "a number", value);
    }
    const double number = value.get<double>();
    if (std::isfinite(number) && number >= type.low && number <= type.high) return std::nullopt;
    return fmt::format("{}: {} is out of range; expected {} to {}", place, number, type.low,
                       type.high);
}

std::optional<std::string> fault_of_text(const Json& value, const Type& type,
                                         const std::string& place) {
    if (!value.is_string()) return expected(place, "a text", value);
    const std::string& text = value.get_ref<const std::string&>();
    if (text.size() > type.size_max) {
        return fmt::format("{}: {} bytes; at most {} are allowed", place, text.size(),
                           type.size_max);
    }
    if (type.kind == Type::Kind::Text) return std::nullopt;
    for (const char letter : text) {
        if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
            return fmt::format("{}: a control character; expected one line of text", place);
        }
    }
    return std::nullopt;
}

std::optional<std::string> fault_of_word(const Json& value, const Type& type,
                                         const std::string& place) {
    if (!value.is_string()) return expected(place, "a word", value);
    const std::string& text = value.get_ref<const std::string&>();
    for (const std::string& word : type.words) {
        if (word == text) return std::nullopt;
    }
    std::vector<std::string_view> words(type.words.begin(), type.words.end());
    return fmt::format("{}: “{:.64}” is not known; expected {}", place, text, list_of(words));
}

std::optional<std::string> fault_of_items(const Json& value, const Type& type, const Types& types,
                                          const std::string& place) {
    const bool list = type.kind == Type::Kind::List;
    if (list ? !value.is_array() : !value.is_object()) {
        return expected(place, list ? "a list" : "an object", value);
    }
    if (value.size() > type.size_max) {
        return fmt::format("{}: {} items; at most {} are allowed", place, value.size(),
                           type.size_max);
    }
    size_t index = 0;
    for (const auto& [key, item] : value.items()) {
        const std::string at =
            list ? fmt::format("{}[{}]", place, index++) : fmt::format("{}.{:.64}", place, key);
        if (auto fault = fault_of(item, *type.item, types, at)) return fault;
    }
    return std::nullopt;
}

}  // namespace

Result<Type> parse_type(std::string_view text) {
    TypeReader reader(text);
    Type type = TRY(reader.type());
    if (!reader.at_end()) return reader.wrong("expected the end of the type");
    return type;
}

Result<Field> parse_field(std::string_view name, std::string_view text) {
    Field field;
    field.name = name;
    const size_t dash = text.find(" -- ");
    if (dash != std::string_view::npos) field.help = text.substr(dash + 4);
    TypeReader reader(text.substr(0, dash));
    field.type = TRY(reader.type());
    field.optional = reader.take('?');
    if (!reader.at_end()) return reader.wrong("expected the end of the type");
    return field;
}

std::optional<std::string> fault_of(const Json& value, const Type& type, const Types& types,
                                    const std::string& place) {
    switch (type.kind) {
        case Type::Kind::Any:
            return std::nullopt;
        case Type::Kind::Bool:
            if (value.is_boolean()) return std::nullopt;
            return expected(place, "true or false", value);
        case Type::Kind::Int:
        case Type::Kind::Number:
            return fault_of_number(value, type, place);
        case Type::Kind::Line:
        case Type::Kind::Text:
            return fault_of_text(value, type, place);
        case Type::Kind::Word:
            return fault_of_word(value, type, place);
        case Type::Kind::List:
        case Type::Kind::Map:
            return fault_of_items(value, type, types, place);
        case Type::Kind::Fields:
            return fault_of_fields(value, type.fields, types, place);
        case Type::Kind::Named:
            return fault_of(value, types.find(type.name)->second, types, place);
    }
    return std::nullopt;
}

std::optional<std::string> fault_of_fields(const Json& value, const std::vector<Field>& fields,
                                           const Types& types, const std::string& place) {
    if (!value.is_object()) return expected(place, "an object", value);
    std::vector<std::string> names;
    for (const Field& field : fields) {
        names.push_back(field.name);
        const auto found = value.find(field.name);
        if (found == value.end()) {
            if (field.optional) continue;
            return fmt::format("{}.{} is missing", place, field.name);
        }
        if (auto fault = fault_of(*found, field.type, types, place + "." + field.name)) {
            return fault;
        }
    }
    for (const auto& [key, item] : value.items()) {
        if (std::find(names.begin(), names.end(), key) != names.end()) continue;
        const std::string near = nearest(key, names);
        return fmt::format("{}.{:.64} is not known{}", place, key,
                           near.empty() ? "" : "; did you mean “" + near + "”?");
    }
    return std::nullopt;
}

}  // namespace vagus::serve
