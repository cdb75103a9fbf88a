// Messages as bytes. Each value says of which kind it is, each field its name, so that a reader can
// say what is wrong with bytes that are none. Both ends are the same program on the same computer:
// numbers are written as the machine has them.
//
//     Writer writer;
//     SetPace::layout(writer, pace);
//     send(writer.take());
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "plan/value.hpp"
#include "serve/bytes.hpp"
#include "serve/talk/values.hpp"

namespace vagus::serve::talk {

// The byte before each value.
enum class Kind : char {
    Nothing = 'n',
    Bool = 'b',
    Count = 'c',   // a whole number from 0 on
    Whole = 'w',   // a whole number
    Number = 'f',  // any
    Text = 't',    // UTF-8
    Bytes = 'y',
    List = 'l',
    Table = 'm',  // values by name
    Parts = 'p',  // a struct
};

// A struct with a list of its fields.
struct AnyField {
    void operator()(std::string_view, const auto&) {}
};
template <typename T>
concept Layered = requires(AnyField each, T value) {
    T::layout(each, value);
};

class Writer {
public:
    // One field of a layout.
    template <typename T>
    void operator()(std::string_view name, const T& value) {
        put_size(name.size());
        bytes_.append(name);
        put(value);
    }
    std::string take() { return std::exchange(bytes_, {}); }

    void put_nothing() { put_kind(Kind::Nothing); }
    void put(bool value);
    void put(double value);
    // What is not UTF-8, as a name of a file may be, goes as U+FFFD: pages could not be told it.
    void put(const std::string& text);
    void put(const Bytes& bytes);
    void put(const Document& document) { put(document.json); }
    void put(const DocumentList& list) { put(list.json); }
    void put(const BusFrame& frame);
    void put(const plan::Value& value);
    void put(const nlohmann::json& json);

    template <typename T>
    requires std::is_integral_v<T>
    void put(T value) {
        put_kind(std::is_signed_v<T> ? Kind::Whole : Kind::Count);
        append(bytes_, static_cast<uint64_t>(value));
    }
    template <typename T>
    requires std::is_enum_v<T>
    void put(T value) { put(std::string(word_of(value))); }
    template <typename T>
    void put(const std::optional<T>& value) {
        value ? put(*value) : put_nothing();
    }
    template <typename T>
    void put(const std::vector<T>& list) {
        put_list(list);
    }
    void put(const std::set<std::string>& list) { put_list(list); }
    template <typename T>
    void put(const std::map<std::string, T>& table) {
        put_kind(Kind::Table);
        put_size(table.size());
        for (const auto& [name, value] : table) {
            put(name);
            put(value);
        }
    }
    template <Layered T>
    void put(const T& value) {
        put_kind(Kind::Parts);
        T::layout(*this, value);
    }

private:
    void put_kind(Kind kind) { bytes_.push_back(static_cast<char>(kind)); }
    void put_size(size_t size);
    template <typename List>
    void put_list(const List& list) {
        put_kind(Kind::List);
        put_size(list.size());
        for (const auto& one : list) put(one);
    }

    std::string bytes_;
};

}  // namespace vagus::serve::talk
