// Messages from bytes that nobody has checked. The reader remembers its first failure and then
// reads nothing more, so there is one check at the end instead of one after each field.
//
//     SetPace pace;
//     Reader reader("pace", bytes);
//     SetPace::layout(reader, pace);
//     if (const auto fault = reader.finish()) return *fault;
//     // "pace.speed: expected a number, found a text"
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "serve/talk/writer.hpp"

namespace vagus::serve::talk {

constexpr int kJsonDepthMax = 64;              // of documents
constexpr size_t kItemsMax = size_t{1} << 20;  // of a list, a table

class Reader {
public:
    // Both are borrowed; `name` is what the message is called.
    Reader(std::string_view name, std::string_view bytes) : bytes_(bytes), place_(name) {}

    // One field of a layout.
    template <typename T>
    void operator()(std::string_view name, T& value) {
        const size_t outside = place_.size();
        place_.append(".").append(name);
        if (take_field(name)) take(value);
        if (!fault_) place_.resize(outside);
    }
    // What was wrong: a sentence that begins with the place. Nothing: it was read to its end.
    std::optional<std::string> finish();

    void take(bool& value);
    void take(int16_t& value);
    void take(double& value);  // finite
    void take(std::string& text);
    void take(Bytes& bytes);
    void take(Document& document);
    void take(DocumentList& list);
    void take(BusFrame& frame);
    void take(plan::Value& value);
    void take(nlohmann::json& json) { take_json(json, 0); }

    template <typename T>
    requires std::is_integral_v<T>
    void take(T& value) {
        constexpr auto kMax = static_cast<uint64_t>(std::numeric_limits<T>::max());
        static_assert(std::is_unsigned_v<T>, "no message has a field that can be below 0");
        value = static_cast<T>(take_count(kMax));
    }
    template <typename T>
    requires std::is_enum_v<T>
    void take(T& value) { value = static_cast<T>(take_word(Words<T>::kAll)); }
    template <typename T>
    void take(std::optional<T>& value) {
        if (take_nothing()) return value.reset();
        take(value.emplace());
    }
    template <typename T>
    void take(std::vector<T>& list) {
        const size_t count = take_items(Kind::List);
        for (size_t i = 0; i < count && !fault_; ++i) take_at(i, list.emplace_back());
    }
    void take(std::set<std::string>& list);
    template <typename T>
    void take(std::map<std::string, T>& table) {
        const size_t count = take_items(Kind::Table);
        for (size_t i = 0; i < count && !fault_; ++i) {
            std::string name;
            take_at(i, name);
            if (!fault_) take_at(i, table[name]);
        }
    }
    template <Layered T>
    void take(T& value) {
        if (expect(Kind::Parts)) T::layout(*this, value);
    }

private:
    template <typename T>
    void take_at(size_t index, T& value) {
        const size_t outside = place_.size();
        place_.append("[").append(std::to_string(index)).append("]");
        take(value);
        if (!fault_) place_.resize(outside);
    }
    template <typename T>
    T take_raw() {
        T value{};
        const std::string_view taken = take_some(sizeof value);
        if (!fault_) std::memcpy(&value, taken.data(), sizeof value);
        return value;
    }
    bool take_field(std::string_view name);
    bool take_nothing();
    bool expect(Kind kind);
    bool fail(std::string_view expected, std::string_view found);
    uint64_t take_count(uint64_t most);
    size_t take_word(std::span<const std::string_view> words);
    size_t take_items(Kind kind);
    void take_json(nlohmann::json& json, int depth);
    template <typename T>
    void take_as(nlohmann::json& json);
    void take_json_list(nlohmann::json& json, int depth);
    void take_json_table(nlohmann::json& json, int depth);
    // Empty once something has failed.
    std::string_view take_some(size_t size);
    std::string_view next_kind() const;

    std::string_view bytes_;
    std::string place_;
    std::optional<std::string> fault_;
};

}  // namespace vagus::serve::talk
