#include "debug/presence.hpp"

#include <algorithm>
#include <utility>

#include "base/rng.hpp"

namespace vagus::debug {
namespace {

// So many hosts may ask at once. Answers that were lost hide later ones for as long: not more.
constexpr int kDueMax = 8;
constexpr uint16_t kProbeWordsMax = 8;

}  // namespace

void Presences::asked(Time now) {
    questions_.push_back(now);
    if (questions_.size() > kDueMax) questions_.pop_front();
    for (auto& [id, presence] : nodes_) presence.due = std::min(presence.due + 1, kDueMax);
}

void Presences::answered(NodeId id, Time now) {
    const auto [known, is_new] = nodes_.try_emplace(id);
    Presence& presence = known->second;
    if (is_new) {
        const auto recent = std::count_if(questions_.begin(), questions_.end(), [now](Time asked) {
            return now - asked < kAnswersWithin;
        });
        // Of a question that came before we listened, perhaps.
        presence.due = std::max(1, static_cast<int>(recent));
    }
    if (presence.due > 0) {
        --presence.due;
        return;
    }
    presence.doubted = !presence.certain;
}

bool Presences::doubtful() const {
    return std::any_of(nodes_.begin(), nodes_.end(),
                       [](const auto& node) { return node.second.doubted; });
}

void Presences::drop_doubts() {
    for (auto& [id, presence] : nodes_) presence.doubted = false;
}

bool Presences::doubts(NodeId id) const {
    const auto known = nodes_.find(id);
    return known != nodes_.end() && known->second.doubted;
}

Probes Presences::settle(NodeId id, uint16_t words, Time now) {
    Presence& presence = nodes_[id];
    presence.doubted = false;
    // Another host, or this command a moment ago, must not ask the same.
    SplitMix64 random(static_cast<uint64_t>(now.count()) * 31 + ++probed_);
    for (size_t i = 0; i < presence.probes.size(); i++) {
        Probe& probe = presence.probes[i];
        const uint16_t most = std::min(words, kProbeWordsMax);
        do {
            probe.count = static_cast<uint16_t>(1 + random.below(most));
            probe.start = static_cast<uint16_t>(random.below(words - probe.count + 1u));
        } while (i > 0 && probe == presence.probes[0]);
    }
    presence.answers = {};
    return presence.probes;
}

bool Presences::told(NodeId id, const Probe& range) {
    const auto known = nodes_.find(id);
    if (known == nodes_.end() || known->second.certain) return false;
    Presence& presence = known->second;
    for (size_t i = 0; i < presence.probes.size(); i++) {
        if (range.count > 0 && presence.probes[i] == range) ++presence.answers[i];
    }
    const auto& answers = presence.answers;
    presence.certain = std::all_of(answers.begin(), answers.end(), [](int n) { return n > 1; });
    return presence.certain;
}

bool Presences::waits() const {
    return std::any_of(nodes_.begin(), nodes_.end(), [](const auto& node) {
        const Presence& presence = node.second;
        const bool asked = presence.probes[0].count > 0;
        return asked && (presence.answers[0] == 0 || presence.answers[1] == 0);
    });
}

std::string Presences::named(NodeId id, const std::string& name, Time now) {
    Presence& presence = nodes_[id];
    const std::string before = std::exchange(presence.name, name);
    const bool close = now - std::exchange(presence.named_at, now) < kNamesWithin;
    if (presence.certain || before.empty() || before == name || !close) return "";
    presence.certain = true;
    return before;
}

}  // namespace vagus::debug
