#include "serve/edit/json_patch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json_part.hpp"
#include "plan/file.hpp"
#include "serve/edit/json_text.hpp"
#include "serve/edit/key_order.hpp"

namespace vagus::serve {

namespace {

using Wire = nlohmann::json;
using Do = JsonStep::Do;

JsonValue number_of(const Wire& wire) {
    JsonValue json;
    json.kind = wire.is_number_integer() ? JsonKind::Int : JsonKind::Float;
    json.text = wire.dump();
    return json;
}

JsonValue json_of(const Wire& wire) {
    JsonValue json;
    if (wire.is_number()) return number_of(wire);
    if (wire.is_string()) return json_string(wire.get_ref<const std::string&>());
    if (wire.is_boolean()) {
        json.kind = JsonKind::Bool;
        json.boolean = wire.get<bool>();
    } else if (wire.is_array()) {
        json.kind = JsonKind::Array;
        for (const Wire& item : wire) json.items.push_back(json_of(item));
    } else if (wire.is_object()) {
        json.kind = JsonKind::Object;
        for (const auto& [key, value] : wire.items()) {
            json.members.push_back(json_member(key, json_of(value)));
        }
    }
    return json;
}

size_t rank_of(KeyOrder order, std::string_view key) {
    return static_cast<size_t>(std::find(order.begin(), order.end(), key) - order.begin());
}

// What came over the wire has lost the order of its keys: the format's is given back.
void put_in_order(JsonValue& json, std::string_view language, std::vector<std::string>& path) {
    if (const KeyOrder order = key_order(language, path); !order.empty()) {
        std::stable_sort(json.members.begin(), json.members.end(),
                         [&](const JsonMember& a, const JsonMember& b) {
                             return rank_of(order, a.key) < rank_of(order, b.key);
                         });
    }
    for (JsonMember& member : json.members) {
        path.push_back(member.key);
        put_in_order(member.value, language, path);
        path.pop_back();
    }
    for (JsonValue& item : json.items) {
        path.emplace_back("[]");
        put_in_order(item, language, path);
        path.pop_back();
    }
}

Result<JsonValue> value_of(const Wire& wire, size_t number) {
    if (wire.contains("text")) {
        return parse_json(wire["text"].get_ref<const std::string&>(),
                          fmt::format("steps[{}].text", number));
    }
    if (wire.contains("value")) return json_of(wire["value"]);
    return Error{Code::BadInput, fmt::format("steps[{}]: the value is missing", number)};
}

class Patcher {
public:
    Patcher(JsonText& root, std::string_view language) : root_(root), language_(language) {}

    Status apply(const JsonStep& step) {
        path_.clear();
        if (step.at.empty()) return replace_all(step);
        JsonText* holder = TRY(find_holder(step.at));
        switch (step.what) {
            case Do::Set:
                return set(*holder, step);
            case Do::Remove:
                return remove(*holder, step.at.back());
            case Do::Insert:
                return insert(*holder, step);
            case Do::Move:
                return move(*holder, step);
        }
        return Status::done();
    }

private:
    static std::string name_of(const JsonStep::Key& key) {
        if (const auto* name = std::get_if<std::string>(&key)) return fmt::format("“{}”", *name);
        return fmt::format("[{}]", std::get<size_t>(key));
    }

    Status replace_all(const JsonStep& step) {
        if (step.what != Do::Set) {
            return Error{Code::BadInput, "the whole file can only be set; name a member in “at”"};
        }
        JsonValue value = step.value;
        put_in_order(value, language_, path_);
        root_ = JsonText::read(format_json(value));
        return Status::done();
    }

    Result<JsonText*> find_holder(const std::vector<JsonStep::Key>& at) {
        JsonText* holder = &root_;
        for (size_t i = 0; i + 1 < at.size(); ++i) {
            const size_t index = TRY(index_of(*holder, at[i]));
            if (index == holder->parts.size()) return not_there(at[i]);
            path_.push_back(holder->kind == JsonText::Kind::Object ? holder->parts[index].key
                                                                   : "[]");
            holder = &holder->parts[index].value;
        }
        return holder;
    }

    static Error not_there(const JsonStep::Key& key) {
        return {Code::NotFound, fmt::format("there is no {} in the file; it may have changed "
                                            "meanwhile",
                                            name_of(key))};
    }

    // Its number among the parts; their count if there is none of that key.
    static Result<size_t> index_of(JsonText& holder, const JsonStep::Key& key) {
        if (const auto* name = std::get_if<std::string>(&key)) {
            if (holder.kind != JsonText::Kind::Object) {
                return Error{Code::BadInput, name_of(key) + " is a key, but is not in an object"};
            }
            const JsonText::Part* part = holder.find(*name);
            return part ? static_cast<size_t>(part - holder.parts.data()) : holder.parts.size();
        }
        if (holder.kind != JsonText::Kind::Array) {
            return Error{Code::BadInput, name_of(key) + " is an index, but is not in a list"};
        }
        const size_t index = std::get<size_t>(key);
        if (index > holder.parts.size()) return not_there(key);
        return index;
    }

    // The text of a new value as it is in that holder, with its key.
    JsonText value_text(const JsonText& holder, const JsonStep& step) {
        JsonValue value = step.value;
        path_.push_back(std::holds_alternative<std::string>(step.at.back())
                            ? std::get<std::string>(step.at.back())
                            : "[]");
        put_in_order(value, language_, path_);
        const bool open = holder.parts.empty() ? path_.size() <= 2 : holder.is_open();
        if (!open) return JsonText::read(format_json_line(value));
        const std::string prefix =
            holder.kind == JsonText::Kind::Object ? json_quote(path_.back()) + ": " : "";
        std::string text = format_json_part(value, path_.size(), prefix, ",");
        text = text.substr(prefix.size(), text.size() - prefix.size() - 1);
        if (!holder.parts.empty()) text = moved_in(text, holder.parts.front().before);
        return JsonText::read(text);
    }

    // Lines of a value that is written for its depth, below what the file has before its members.
    std::string moved_in(const std::string& text, const std::string& before) const {
        const std::string written = "\n" + std::string(path_.size() * 2, ' ');
        const size_t line = before.rfind('\n');
        const bool returns = line > 0 && before[line - 1] == '\r';
        const std::string wanted = (returns ? "\r" : "") + before.substr(line);
        std::string moved;
        for (size_t at = 0; at < text.size();) {
            const size_t next = std::min(text.find(written, at), text.size());
            moved += text.substr(at, next - at);
            if (next < text.size()) moved += wanted;
            at = next + written.size();
        }
        return moved;
    }

    Status set(JsonText& holder, const JsonStep& step) {
        const size_t index = TRY(index_of(holder, step.at.back()));
        const size_t depth = path_.size();
        if (index < holder.parts.size()) {
            holder.parts[index].value = value_text(holder, step);
            return Status::done();
        }
        if (holder.kind == JsonText::Kind::Array) return not_there(step.at.back());
        return add(holder, place_for(holder, std::get<std::string>(step.at.back())), step, depth);
    }

    Status insert(JsonText& holder, const JsonStep& step) {
        const size_t index = TRY(index_of(holder, step.at.back()));
        if (holder.kind == JsonText::Kind::Array) return add(holder, index, step, path_.size());
        if (index < holder.parts.size()) {
            return Error{Code::Refused, fmt::format("there is {} already; set it instead",
                                                    name_of(step.at.back()))};
        }
        return add(holder, place_for(holder, std::get<std::string>(step.at.back())), step,
                   path_.size());
    }

    // Before the first member that the format has behind it.
    size_t place_for(const JsonText& holder, const std::string& key) const {
        const KeyOrder order = key_order(language_, path_);
        const size_t rank = rank_of(order, key);
        size_t place = 0;
        while (place < holder.parts.size() && rank_of(order, holder.parts[place].key) <= rank) {
            ++place;
        }
        return order.empty() ? holder.parts.size() : place;
    }

    Status add(JsonText& holder, size_t index, const JsonStep& step, size_t depth) {
        JsonText::Part part;
        if (holder.kind == JsonText::Kind::Object) {
            part.key = std::get<std::string>(step.at.back());
            part.raw_key = json_quote(part.key);
            part.between = ": ";
        }
        part.value = value_text(holder, step);
        holder.insert(index, std::move(part), depth);
        return Status::done();
    }

    static Status remove(JsonText& holder, const JsonStep::Key& key) {
        const size_t index = TRY(index_of(holder, key));
        if (index == holder.parts.size()) return not_there(key);
        holder.take(index);
        return Status::done();
    }

    Status move(JsonText& holder, const JsonStep& step) {
        const size_t index = TRY(index_of(holder, step.at.back()));
        if (index == holder.parts.size()) return not_there(step.at.back());
        if (step.to >= holder.parts.size()) {
            return Error{Code::BadInput,
                         fmt::format("{} cannot move to {}: there are only {}",
                                     name_of(step.at.back()), step.to, holder.parts.size())};
        }
        const std::string tail = holder.tail;
        JsonText::Part part = holder.take(index);
        if (holder.parts.empty()) {
            const std::string before = part.before;
            holder.insert(0, std::move(part), path_.size());
            holder.parts.front().before = before;
        } else {
            holder.insert(step.to, std::move(part), path_.size());
        }
        holder.tail = tail;
        return Status::done();
    }

    JsonText& root_;
    std::string_view language_;
    std::vector<std::string> path_;  // of the holder; "[]" for indices
};

// The blanks around the whole stay, too.
std::string with_rim(std::string_view before, std::string text) {
    constexpr std::string_view kBlanks = " \t\r\n";
    const size_t first = std::min(before.find_first_not_of(kBlanks), before.size());
    const size_t last = before.find_last_not_of(kBlanks);
    const std::string_view tail = last == before.npos ? "\n" : before.substr(last + 1);
    return std::string(before.substr(0, first)) + text + std::string(tail);
}

// As its writer saves it.
std::string saved_form(std::string_view text, const JsonValue& json, const PatchedFile& file) {
    if (file.language == "plan") {
        if (auto saved = plan::format_plan(text, file.path); saved.ok()) return saved.value();
    }
    return format_json(json);
}

}  // namespace

Result<std::vector<JsonStep>> read_steps(const Wire& steps) {
    static constexpr std::pair<std::string_view, Do> kActs[] = {
        {"set", Do::Set}, {"remove", Do::Remove}, {"insert", Do::Insert}, {"move", Do::Move}};
    std::vector<JsonStep> read;
    for (const Wire& wire : steps) {
        JsonStep step;
        for (const auto& [word, act] : kActs) {
            if (wire["do"] == word) step.what = act;
        }
        for (const Wire& key : wire["at"]) {
            if (key.is_string()) {
                step.at.emplace_back(key.get<std::string>());
            } else if (key.is_number_unsigned() || (key.is_number_integer() && key >= 0)) {
                step.at.emplace_back(key.get<size_t>());
            } else {
                return Error{Code::BadInput,
                             fmt::format("steps[{}].at: expected keys and indices, found {}",
                                         read.size(), key.dump().substr(0, 40))};
            }
        }
        const bool valued = step.what == Do::Set || step.what == Do::Insert;
        if (valued) step.value = TRY(value_of(wire, read.size()));
        if (step.what == Do::Move && !wire.contains("to")) {
            return Error{Code::BadInput, fmt::format("steps[{}]: “to” is missing", read.size())};
        }
        if (step.what == Do::Move) step.to = wire["to"].get<size_t>();
        read.push_back(std::move(step));
    }
    return read;
}

Result<std::string> patched(std::string_view text, const PatchedFile& file,
                            const std::vector<JsonStep>& steps) {
    const JsonValue before = TRY(parse_json(text, file.path));
    const bool saved = saved_form(text, before, file) == text;
    const bool plain = format_json(before) == text;
    JsonText tree = JsonText::read(text);
    Patcher patcher(tree, file.language);
    for (size_t i = 0; i < steps.size(); ++i) {
        const Status done = patcher.apply(steps[i]);
        if (!done.ok()) {
            return Error{done.error().code, fmt::format("steps[{}]: {}", i, done.error().what)};
        }
    }
    std::string after = with_rim(text, tree.text());
    // What is too deep, too long or no text is found here.
    const JsonValue json = TRY(parse_json(after, file.path));
    if (saved) return saved_form(after, json, file);
    return plain ? format_json(json) : after;
}

}  // namespace vagus::serve
