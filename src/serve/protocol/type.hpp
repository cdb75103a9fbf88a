// The types of the studio's protocol: the little language in which protocol.json says what a field
// may hold, and the check of a message against it.
//
//     line(64)          text without control characters, at most 64 bytes
//     text(4096)        any text        int(0..9)   number   number(0..1)   bool   json
//     word(run|pause)   one of these    [Doc; 10]   at most 10 of a type    {int(0..9); 5} by name
//     Place             a type of the list           any of them with ? may be missing
#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kTypeDepthMax = 32;  // of types inside each other, and of values

struct Field;

struct Type {
    enum class Kind { Bool, Int, Number, Line, Text, Word, Any, List, Map, Fields, Named };
    Kind kind = Kind::Any;
    double low = 0, high = 0;          // Int, Number
    size_t size_max = 0;               // Line, Text: bytes; List, Map: items
    std::vector<std::string> words;    // Word
    std::string name;                  // Named
    std::shared_ptr<const Type> item;  // List, Map; owners: all copies of this type
    std::vector<Field> fields;         // Fields
};

struct Field {
    std::string name;
    Type type;
    bool optional = false;
    std::string help;
};

using Types = std::map<std::string, Type, std::less<>>;

// One type, without help: "[Doc; 10]".
Result<Type> parse_type(std::string_view text);
// The value of a field in protocol.json: "Doc? -- where it is shown".
Result<Field> parse_field(std::string_view name, std::string_view text);

// What is wrong with a value: a sentence that begins with the place, "in.changes[3].from: …".
std::optional<std::string> fault_of(const nlohmann::json& value, const Type& type,
                                    const Types& types, const std::string& place);
// The same for an object with these fields; no others are allowed. A field that has nothing to say
// is left out: null is a value of json only.
std::optional<std::string> fault_of_fields(const nlohmann::json& value,
                                           const std::vector<Field>& fields, const Types& types,
                                           const std::string& place);

}  // namespace vagus::serve
