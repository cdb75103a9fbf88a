// Values of variables for pages: only what somebody looks at is asked from the bus.
#include <algorithm>
#include <cstring>

#include "serve/target/target.hpp"

#include "serve/bytes.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

// The words of some ranges of a node, sent when they differ from what was sent.
struct Target::VariableWatch final : BinaryWatch {
    VariableWatch(Target& its_target, const Json& of) : target(its_target), node(of["node"]) {
        for (const Json& range : of["ranges"]) {
            if (!range.is_array() || range.size() != 2 || !range[0].is_number_unsigned() ||
                !range[1].is_number_unsigned()) {
                continue;
            }
            const uint64_t first = range[0], count = range[1];
            if (count <= kCountMax && first + count <= 0x10000) {
                ranges.emplace_back(static_cast<uint16_t>(first), static_cast<uint16_t>(count));
            }
        }
    }

    std::optional<std::pair<double, std::string>> next() override {
        const auto values = target.values_.find(node);
        if (values == target.values_.end()) return std::nullopt;
        std::string payload;
        for (const auto& [first, count] : ranges) {
            std::string words;
            bool known = count > 0;
            for (uint32_t address = first; known && address < uint32_t{first} + count; ++address) {
                const auto value = values->second.find(static_cast<uint16_t>(address));
                known = value != values->second.end();
                if (known) append(words, value->second);
            }
            if (!known || sent[first] == words) continue;
            sent[first] = words;
            append(payload, first);
            append(payload, count);
            payload += words;
        }
        if (payload.empty()) return std::nullopt;
        return std::pair(target.hints_.time(), payload);
    }

    static constexpr uint64_t kCountMax = 4096;
    Target& target;
    const uint16_t node;
    std::vector<std::pair<uint16_t, uint16_t>> ranges;
    std::map<uint16_t, std::string> sent;
};

// Every value of some words that was seen since the last frame.
struct Target::SampleWatch final : BinaryWatch {
    SampleWatch(Target& its_target, const Json& of) : target(its_target), words(words_of(of)) {
        seen.resize(words.size());
    }

    static std::vector<std::pair<uint16_t, uint16_t>> words_of(const Json& of) {
        std::vector<std::pair<uint16_t, uint16_t>> words;
        for (const Json& word : of["words"]) {
            const bool good = word.is_array() && word.size() == 2 && word[0].is_number_unsigned() &&
                              word[1].is_number_unsigned() && word[0] < 0xffff && word[1] <= 0xffff;
            // Indices of the payload count all that were asked for.
            words.emplace_back(good ? word[0].get<uint16_t>() : uint16_t{0xffff},
                               good ? word[1].get<uint16_t>() : uint16_t{0xffff});
        }
        return words;
    }

    std::optional<std::pair<double, std::string>> next() override {
        std::string payload;
        size_t room = kSamplesAtOnce;
        for (size_t i = 0; i < words.size(); ++i) {
            const auto found = target.samples_.find(words[i]);
            if (found == target.samples_.end()) continue;
            const Samples& samples = found->second;
            const uint64_t first = samples.end - samples.kept.size();
            // A run that began again counts on: its times do not.
            for (seen[i] = std::max(seen[i], first); seen[i] < samples.end && room > 0; --room) {
                const Sample& sample = samples.kept[seen[i]++ - first];
                append(payload, sample.t);
                append(payload, static_cast<uint16_t>(i));
                append(payload, sample.value);
            }
        }
        if (payload.empty()) return std::nullopt;
        return std::pair(target.hints_.time(), payload);
    }

    Target& target;
    const std::vector<std::pair<uint16_t, uint16_t>> words;
    std::vector<uint64_t> seen;  // numbers of the next ones
};

void Target::declare_watches() {
    desk_.topics().binary(
        "variables", [this](const Json& of) { return std::make_unique<VariableWatch>(*this, of); });
    desk_.topics().binary(
        "samples", [this](const Json& of) { return std::make_unique<SampleWatch>(*this, of); });
}

// Asks for the variables that pages show now, and no longer for those that they do not.
void Target::watch_what_is_shown() {
    std::map<uint16_t, std::set<uint16_t>> wanted;  // by node: addresses
    for (const Json& of : desk_.topics().subjects("variables")) {
        const VariableWatch watch(*this, of);
        for (const auto& [first, count] : watch.ranges) {
            for (uint32_t address = first; address < uint32_t{first} + count; ++address) {
                wanted[watch.node].insert(static_cast<uint16_t>(address));
            }
        }
    }
    std::set<std::pair<uint16_t, uint16_t>> plotted;
    for (const Json& of : desk_.topics().subjects("samples")) {
        for (const auto& word : SampleWatch::words_of(of)) {
            wanted[word.first].insert(word.second);
            plotted.insert(word);
        }
    }
    for (const auto& word : plotted) samples_[word];
    std::erase_if(samples_, [&](const auto& entry) { return !plotted.contains(entry.first); });
    for (const uint16_t node : live_nodes()) {
        if (wanted[node].empty() && watched_[node].empty()) continue;
        std::set<std::string> names;
        const debug::NodeView* view = network_->node(node);
        for (const auto& [name, place] : variables_of(*view)) {
            const auto first = wanted[node].lower_bound(static_cast<uint16_t>(place.first));
            const bool shown = first != wanted[node].end() && *first < place.first + place.second;
            if (!shown) continue;
            names.insert(name);
            if (watched_[node].contains(name)) continue;
            const auto range = network_->variable(node, name);
            if (range.ok()) (void)network_->watch(node, range.value(), kWatchedEvery).ok();
        }
        for (const std::string& name : watched_[node]) {
            if (names.contains(name)) continue;
            network_->unwatch(node, name);
            tell_unwatched(node, *view, name);
        }
        // Drop stale values.
        if (names.empty()) values_.erase(node);
        watched_[node] = std::move(names);
    }
}

void Target::tell_unwatched(uint16_t node, const debug::NodeView& view, const std::string& name) {
    const auto places = variables_of(view);
    const auto place = places.find(name);
    if (place == places.end()) return;
    told_.unwatched(time(), node, static_cast<uint16_t>(place->second.first),
                    static_cast<uint16_t>(place->second.second));
}

// Names with address and size: the node's, then the script's.
std::map<std::string, std::pair<uint32_t, uint32_t>> Target::variables_of(
    const debug::NodeView& view) {
    std::map<std::string, std::pair<uint32_t, uint32_t>> found;
    uint32_t address = 0;
    for (const aesl::NamedVariable& variable : view.target.variables) {
        found.emplace(variable.name, std::pair(address, uint32_t{variable.size}));
        address += variable.size;
    }
    if (!view.program) return found;
    for (const aesl::VariablePlace& place : view.program->variables) {
        found.emplace(place.name, std::pair(uint32_t{place.address}, uint32_t{place.size}));
    }
    return found;
}

void Target::hear(const debug::Event& event, const debug::VariableChanged& changed) {
    const debug::NodeView* view = network_->node(event.node);
    const auto places = variables_of(*view);
    const auto place = places.find(changed.name);
    if (place == places.end()) return;
    auto address = static_cast<uint16_t>(place->second.first);
    // An answer that was under way when nobody watched any more is not told.
    if (watched_[event.node].contains(changed.name)) {
        told_.words(time(), event.node, address, changed.values);
    }
    for (const int16_t value : changed.values) {
        values_[event.node][address] = value;
        const auto samples = samples_.find({event.node, address});
        if (samples != samples_.end()) {
            samples->second.kept.push_back({time(), value});
            ++samples->second.end;
            if (samples->second.kept.size() > kSamplesKept) samples->second.kept.pop_front();
        }
        ++address;
    }
}

}  // namespace vagus::serve
