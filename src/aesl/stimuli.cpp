#include "aesl/stimuli.hpp"

#include "base/json.hpp"
#include "base/json_object.hpp"

namespace vagus::aesl {

namespace {

int16_t read_word(const JsonValue& json, JsonObject& owner) {
    if (json.kind == JsonKind::Int && json.integer >= INT16_MIN && json.integer <= INT16_MAX) {
        return static_cast<int16_t>(json.integer);
    }
    owner.complain(json.at, owner.name() + ": a word is a whole number from -32768 to 32767, but " +
                                (json.is_number() ? json.text : std::string(name_of(json.kind))) +
                                " was found: write such a number");
    return 0;
}

std::vector<int16_t> read_words(const std::vector<JsonValue>& items, JsonObject& owner) {
    std::vector<int16_t> words;
    for (const JsonValue& item : items) words.push_back(read_word(item, owner));
    return words;
}

std::vector<Assignment> read_assignments(const JsonValue* set, JsonObject& owner) {
    std::vector<Assignment> assignments;
    if (set == nullptr) return assignments;
    for (const JsonMember& member : set->members) {
        if (member.value.kind == JsonKind::Array) {
            assignments.push_back({member.key, read_words(member.value.items, owner)});
            continue;
        }
        owner.complain(member.value.at,
                       owner.name() + ": the words of " + member.key + " are a list, but " +
                           std::string(name_of(member.value.kind)) + " was found: write [1, 2]");
    }
    return assignments;
}

Stimulus read_stimulus(const JsonValue& json, size_t number, Complaints& complaints) {
    JsonObject object(json, "stimulus " + std::to_string(number), complaints);
    Stimulus stimulus;
    stimulus.set = read_assignments(object.find("set", JsonKind::Object, Need::Optional), object);
    stimulus.event = object.text("event", Need::Optional);
    stimulus.arguments = read_words(object.items("args", Need::Optional), object);
    if (const JsonValue* source = object.find("source", Need::Optional)) {
        stimulus.source = read_word(*source, object);
    }
    if (stimulus.event.empty() && json.find("set") == nullptr) {
        object.complain(json.at, object.name() + ": it has neither `event` nor `set`: add one");
    }
    object.finish();
    return stimulus;
}

}  // namespace

Result<std::vector<Stimulus>> parse_stimuli(std::string_view text, std::string_view file) {
    const JsonValue json = TRY(parse_json(text, file));
    Complaints complaints;
    JsonObject object(json, "the file", complaints);
    std::vector<Stimulus> stimuli;
    const std::vector<JsonValue>& items = object.items("stimuli", Need::Optional);
    if (items.size() > kStimuliMax) {
        object.complain(json.at, "the file: at most " + std::to_string(kStimuliMax) +
                                     " stimuli, but there are " + std::to_string(items.size()) +
                                     ": split it");
    }
    for (const JsonValue& item : items) {
        if (stimuli.size() == kStimuliMax) break;
        stimuli.push_back(read_stimulus(item, stimuli.size() + 1, complaints));
    }
    // The other parts of an expected file say what came of a run.
    for (const char* key : {"bytecode", "lines", "memory", "events_emitted", "runtime_error",
                            "error", "about", "quirk"}) {
        (void)object.find(key, Need::Optional);
    }
    object.finish();
    if (!complaints.empty()) return first_complaint(complaints, file);
    return stimuli;
}

}  // namespace vagus::aesl
