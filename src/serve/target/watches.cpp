// Values of variables for pages: only what somebody looks at is asked from the bus.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "serve/target/target.hpp"

#include "serve/bytes.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

// The words of some ranges of a node, sent when they differ from what was sent.
struct Target::VariableWatch final : BinaryWatch {
    VariableWatch(Target& its_target, const Json& of)
        : target(its_target), node(of["node"]), ranges(ranges_of(of)) {}

    static WordRanges ranges_of(const Json& of) {
        WordRanges ranges;
        for (const Json& range : of["ranges"]) {
            if (!range.is_array() || range.size() != 2 || !range[0].is_number_unsigned() ||
                !range[1].is_number_unsigned()) {
                continue;
            }
            const uint64_t first = range[0], count = range[1];
            if (count <= kAddresses && first <= kAddresses - count) {
                ranges.push_back(
                    {static_cast<uint32_t>(first), static_cast<uint32_t>(first + count)});
            }
        }
        return merged(std::move(ranges));
    }

    static std::optional<Problem> fault_of(const Json& of) {
        const size_t words = words_in(ranges_of(of));
        if (words <= kWatchedWordsMax) return std::nullopt;
        return Problem{"limit",
                       fmt::format("variables: {} words are asked for; one subscription has at "
                                   "most {}: ask for those that are looked at",
                                   words, kWatchedWordsMax),
                       "in.of.ranges"};
    }

    std::optional<std::pair<double, std::string>> next() override {
        const auto values = target.values_.find(node);
        if (values == target.values_.end()) return std::nullopt;
        std::string payload;
        for (const WordRange& range : ranges) {
            const std::string words = words_of(values->second, range);
            if (words.empty() || sent[range.first] == words) continue;
            sent[range.first] = words;
            append(payload, static_cast<uint16_t>(range.first));
            append(payload, static_cast<uint16_t>(range.count()));
            payload += words;
        }
        if (payload.empty()) return std::nullopt;
        return std::pair(target.hints_.time(), payload);
    }

    // Empty if one of them is not known.
    static std::string words_of(const std::map<uint16_t, int16_t>& values, const WordRange& range) {
        std::string words;
        auto value = values.lower_bound(static_cast<uint16_t>(range.first));
        for (uint32_t address = range.first; address < range.end; ++address, ++value) {
            if (value == values.end() || value->first != address) return {};
            append(words, value->second);
        }
        return words;
    }

    static constexpr uint64_t kAddresses = 0x10000;
    Target& target;
    const uint16_t node;
    const WordRanges ranges;
    std::map<uint32_t, std::string> sent;
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
        "variables", [this](const Json& of) { return std::make_unique<VariableWatch>(*this, of); },
        [](const Json& of) { return VariableWatch::fault_of(of); });
    desk_.topics().binary(
        "samples", [this](const Json& of) { return std::make_unique<SampleWatch>(*this, of); });
}

// What pages look at is another only when a page asks for something else.
void Target::put_watched_together() {
    if (wanted_of_ == desk_.topics().subscriptions()) return;
    wanted_of_ = desk_.topics().subscriptions();
    ++watched_made_;
    wanted_.clear();
    for (const Json& of : desk_.topics().subjects("variables")) {
        const WordRanges ranges = VariableWatch::ranges_of(of);
        WordRanges& all = wanted_[of["node"].get<uint16_t>()];
        all.insert(all.end(), ranges.begin(), ranges.end());
    }
    std::set<std::pair<uint16_t, uint16_t>> plotted;
    for (const Json& of : desk_.topics().subjects("samples")) {
        for (const auto& word : SampleWatch::words_of(of)) {
            wanted_[word.first].push_back({word.second, uint32_t{word.second} + 1});
            plotted.insert(word);
        }
    }
    for (auto& [node, ranges] : wanted_) ranges = merged(std::move(ranges));
    for (const auto& word : plotted) begin_samples(word);
    std::erase_if(samples_, [&](const auto& entry) { return !plotted.contains(entry.first); });
}

// What is watched already is told again only when it changes: a plot begins with what it is now.
void Target::begin_samples(const std::pair<uint16_t, uint16_t>& word) {
    const auto [samples, is_new] = samples_.try_emplace(word);
    if (!is_new) return;
    const auto node = values_.find(word.first);
    if (node == values_.end()) return;
    const auto value = node->second.find(word.second);
    if (value == node->second.end()) return;
    samples->second.kept.push_back({time(), value->second});
    ++samples->second.end;
}

// Asks for the variables that pages show now, and no longer for those that they do not.
void Target::watch_what_is_shown() {
    put_watched_together();
    for (const uint16_t node : live_nodes()) {
        const auto wanted = wanted_.find(node);
        const bool nothing = wanted == wanted_.end() && told_variables_.empty();
        if (nothing && watched_[node].empty()) continue;
        std::set<std::string> names;
        const debug::NodeView* view = network_->node(node);
        for (const auto& [name, place] : variables_of(*view)) {
            const bool shown = wanted != wanted_.end() &&
                               has_some(wanted->second, place.first, place.first + place.second);
            if (!shown && !is_told(view->name, name)) continue;
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

bool Target::is_told(const std::string& node, const std::string& variable) const {
    return std::find(told_variables_.begin(), told_variables_.end(),
                     fleet::Tells{node, variable}) != told_variables_.end();
}

void Target::tell_unwatched(uint16_t node, const debug::NodeView& view, const std::string& name) {
    const auto places = variables_of(view);
    const auto place = places.find(name);
    if (place == places.end()) return;
    told_.unwatched(time(), node, static_cast<uint16_t>(place->second.first),
                    static_cast<uint16_t>(place->second.second));
}

void Target::tell_words() const {
    for (const auto& [node, values] : values_) {
        for (auto one = values.begin(); one != values.end();) {
            const uint16_t first = one->first;
            std::vector<int16_t> words;
            for (; one != values.end() && one->first == first + words.size(); ++one) {
                words.push_back(one->second);
            }
            told_.words(time(), node, first, words);
        }
    }
}

// Names with address and size: the node's, then the script's.
std::map<std::string, std::pair<uint32_t, uint32_t>> Target::variables_of(
    const debug::NodeView& view) {
    std::map<std::string, std::pair<uint32_t, uint32_t>> found;
    uint32_t address = 0;
    for (const aesl::NamedVariable& variable : view.target->variables) {
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
    const fleet::Tells variable{view->name, changed.name};
    if (is_told(variable.node, variable.name)) tells_.variable(variable, changed.values);
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
