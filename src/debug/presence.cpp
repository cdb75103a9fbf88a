#include "debug/presence.hpp"

#include <algorithm>
#include <utility>

namespace vagus::debug {
namespace {

// So many hosts may ask at once. Answers that were lost hide later ones for as long: not more.
constexpr int kDueMax = 8;
constexpr int kSurplusRounds = 2;

}  // namespace

void Presences::asked(Time now) {
    ++round_;
    doubtful_ = false;
    questions_.push_back(now);
    if (questions_.size() > kDueMax) questions_.pop_front();
    for (auto& [id, presence] : nodes_) presence.due = std::min(presence.due + 1, kDueMax);
}

bool Presences::answered(NodeId id, Time now) {
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
        return false;
    }
    if (presence.certain || presence.round == round_) return false;
    presence.round = round_;
    presence.certain = ++presence.surplus >= kSurplusRounds;
    doubtful_ = doubtful_ || !presence.certain;
    return presence.certain;
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
