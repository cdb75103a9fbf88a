#include "sim/chaos_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/seconds.hpp"

namespace vagus::sim {

namespace {

constexpr double kMillisecond = 0.001;

class FaultReader {
public:
    FaultReader(const JsonValue& json, size_t number, Complaints& complaints)
        : in_(json, fmt::format("fault {}", number), complaints) {
        fault_.place = json.at;
    }

    ChaosFault read() {
        std::vector<std::string_view> words;
        for (const ChaosKind kind : chaos_kinds()) words.push_back(name_of(kind));
        const std::string word = in_.word("kind", words, Need::Required);
        if (word.empty()) return fault_;  // what else it should have, nobody knows
        fault_.kind =
            chaos_kinds()[static_cast<size_t>(std::ranges::find(words, word) - words.begin())];
        place();
        times();
        strength();
        fault_.seed = static_cast<uint64_t>(
            in_.integer("seed", {.low = 0, .high = INT64_MAX, .fallback = 1}));
        in_.finish();
        return fault_;
    }

private:
    void place() {
        if (is_of_link(fault_.kind)) {
            fault_.where = in_.text("link", Need::Required);
        } else if (fault_.kind == ChaosKind::Slow) {
            fault_.where = in_.text("computer", Need::Optional);
        } else {
            fault_.where = in_.text("node", Need::Required);
        }
        if (is_of_sensor(fault_.kind)) fault_.sensor = in_.text("sensor", Need::Required);
    }

    void times() {
        if (is_instant(fault_.kind)) {
            fault_.from = seconds("at");
            return;
        }
        fault_.from = seconds("from");
        const JsonValue* const until = in_.find("until", Need::Optional);
        if (until == nullptr) return;
        fault_.until = from_seconds(in_.number("until", {0, kChaosTimeMax, kChaosTimeMax}));
        if (*fault_.until > fault_.from || !until->is_number()) return;
        in_.complain(until->at,
                     fmt::format("\"until\" of {}: expected a time behind \"from\", {:g} s, found "
                                 "{:g}; leave \"until\" out if it lasts to the end",
                                 in_.name(), seconds_of(fault_.from), until->number));
    }

    static double seconds_of(Time at) { return static_cast<double>(at.count()) / 1e6; }

    Time seconds(std::string_view key) {
        return from_seconds(
            in_.number(key, {.low = 0, .high = kChaosTimeMax, .need = Need::Required}));
    }

    void strength() {
        switch (fault_.kind) {
            case ChaosKind::Reordered:
                fault_.by = in_.number("by", {kMillisecond, kChaosDelayMax, kChaosMixUnlessSaid});
                [[fallthrough]];
            case ChaosKind::Lost:
            case ChaosKind::Doubled:
                fault_.chance = in_.number("chance", {kMillisecond, 1, 1});
                break;
            case ChaosKind::Delayed:
            case ChaosKind::Slow:
                fault_.by = in_.number("by", {kMillisecond, kChaosDelayMax, 1, Need::Required});
                break;
            case ChaosKind::Noisy:
                fault_.by = in_.number("by", {1, kChaosNoiseMax, 1, Need::Required});
                break;
            case ChaosKind::Reset:
            case ChaosKind::Hung:
            case ChaosKind::Unplugged:
            case ChaosKind::Stuck:
            case ChaosKind::Dead:
                break;
        }
    }

    JsonObject in_;
    ChaosFault fault_;
};

std::string place_json(const ChaosFault& fault) {
    std::string text;
    if (is_of_link(fault.kind)) {
        text = ", \"link\": " + json_quote(fault.where);
    } else if (fault.kind != ChaosKind::Slow) {
        text = ", \"node\": " + json_quote(fault.where);
    } else if (!fault.where.empty()) {
        text = ", \"computer\": " + json_quote(fault.where);
    }
    if (is_of_sensor(fault.kind)) text += ", \"sensor\": " + json_quote(fault.sensor);
    return text;
}

// Without zeros at the end.
std::string time_json(Time at) {
    return fmt::format("{:.15g}", static_cast<double>(at.count()) / 1e6);
}

std::string fault_json(const ChaosFault& fault) {
    std::string text = fmt::format("{{ \"kind\": \"{}\"{}", name_of(fault.kind), place_json(fault));
    text +=
        fmt::format(", \"{}\": {}", is_instant(fault.kind) ? "at" : "from", time_json(fault.from));
    if (fault.until) text += fmt::format(", \"until\": {}", time_json(*fault.until));
    if (fault.chance < 1) text += fmt::format(", \"chance\": {:.15g}", fault.chance);
    if (fault.by > 0) text += fmt::format(", \"by\": {:.15g}", fault.by);
    if (fault.seed != 1) text += fmt::format(", \"seed\": {}", fault.seed);
    return text + " }";
}

}  // namespace

void read_chaos(const JsonValue& list, Chaos& into, Complaints& complaints) {
    if (list.kind != JsonKind::Array) {
        complaints.push_back({list.at, fmt::format("\"chaos\": expected a list of faults, found "
                                                   "{}; write it as [{{ \"kind\": \"unplugged\", "
                                                   "\"node\": \"drive\", \"from\": 3 }}]",
                                                   name_of(list.kind))});
        return;
    }
    if (list.items.size() > kChaosFaultsMax) {
        complaints.push_back({list.at, fmt::format("\"chaos\": expected at most {} faults, found "
                                                   "{}; leave some out",
                                                   kChaosFaultsMax, list.items.size())});
        return;
    }
    for (const JsonValue& one : list.items) {
        into.faults.push_back(FaultReader(one, into.faults.size() + 1, complaints).read());
    }
}

Result<Chaos> read_chaos(std::string_view text, const std::string& file) {
    const JsonValue json = TRY(parse_json(text, file));
    const JsonValue* const inside = json.kind == JsonKind::Object ? json.find("chaos") : &json;
    if (inside == nullptr) {
        return Error{Code::BadInput,
                     at_place(file, json.at,
                              "expected a list of faults, or an object with one under the key "
                              "\"chaos\", as { \"chaos\": [{ \"kind\": \"unplugged\", \"node\": "
                              "\"drive\", \"from\": 3 }] }")};
    }
    Chaos chaos{.file = file};
    Complaints complaints;
    read_chaos(*inside, chaos, complaints);
    if (!complaints.empty()) return first_complaint(complaints, file);
    return chaos;
}

std::string format_chaos(const std::vector<ChaosFault>& faults) {
    std::string text;
    for (const ChaosFault& fault : faults) {
        text += (text.empty() ? "" : ", ") + fault_json(fault);
    }
    return "[" + text + "]";
}

}  // namespace vagus::sim
