// What there was at a moment of a run: `moment()` of why.hpp.
#include <fmt/format.h>

#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

bool is_within(Time at, Time after, Time by) {
    return at > after && at <= by;
}

constexpr std::string_view kDraw = "math.rand";

}  // namespace

Result<Chain> moment(const mcap::Reader& reader, Time after, Time by, const std::string& robot) {
    const std::unique_ptr<Rerun> rerun = TRY(Rerun::open(reader, {.until = by}));
    Causes causes(*rerun);
    std::optional<Chain> found;
    // At its instant, before the run is ended for it.
    rerun->each_instant([&](Time now) {
        if (now >= by && !found) found = Walk(causes).moment(after, by, robot);
    });
    NullTape tape;
    (void)TRY(rerun->run(tape));
    return found ? std::move(*found) : Walk(causes).moment(after, by, robot);
}

Chain Walk::moment(Time after, Time by, const std::string& robot) {
    const size_t first = all_.bus_of(robot).value_or(0);
    const auto each_bus = [&](const auto& tell) {
        on_bus(first, tell);
        for (size_t i = 0; i < all_.buses(); ++i) {
            if (i != first) on_bus(i, tell);
        }
    };
    on_bus(first, [&] { active_actors(after); });
    each_bus([&] { draws(after, by); });
    each_bus([&] { decisions(after, by); });
    happened(after, by);
    each_bus([&] { handlers(after, by); });
    if (chain_.size() > kMomentMax) chain_.resize(kMomentMax);
    return chain_;
}

// A link without those that it followed from.
template <typename Tell>
void Walk::tell_alone(const Tell& tell) {
    const size_t place = chain_.size();
    if (place >= kMomentMax) return;
    tell();
    if (chain_.size() > place + 1) chain_.resize(place + 1);
}

// The outermost first: those that have begun and neither ended nor were interrupted.
void Walk::active_actors(Time after) {
    std::vector<size_t> active;
    const auto ends = [&](uint64_t activation) {
        std::erase_if(active, [&](size_t one) {
            return what<plan::ActorStarted>(one)->activation == activation;
        });
    };
    for (size_t i = 0; i < lines().size() && lines()[i].event.at <= after; ++i) {
        if (what<plan::ActorStarted>(i) != nullptr) active.push_back(i);
        if (const auto* const ended = what<plan::ActorEnded>(i)) ends(ended->activation);
        if (const auto* const broken = what<plan::ActorInterrupted>(i)) ends(broken->activation);
    }
    for (const size_t one : active) {
        const std::string_view actor = what<plan::ActorStarted>(one)->actor;
        add_element(lines()[one].event.at, fmt::format("the actor {} began, and was active", actor),
                    lines()[one].event.plan, actor);
    }
}

// What scripts drew.
void Walk::draws(Time after, Time by) {
    for (uint32_t number = 1; const BusCauses::Call* const one = bus_->call(number); ++number) {
        if (!is_within(one->deed.at, after, by)) continue;
        const aesl::Target* const target = session()->target(one->node.id);
        const bool known = target != nullptr && one->native < target->natives.size();
        if (!known || target->natives[one->native].name != kDraw) continue;
        tell_alone([&] { call(number); });
    }
}

void Walk::decisions(Time after, Time by) {
    for (size_t i = 0; i < lines().size(); ++i) {
        if (is_within(lines()[i].event.at, after, by)) tell_alone([&] { line(i); });
    }
}

void Walk::happened(Time after, Time by) {
    const auto& happenings = all_.happenings().all();
    for (uint32_t i = 0; i < happenings.size(); ++i) {
        if (is_within(happenings[i].at, after, by)) tell_alone([&] { happening(i + 1); });
    }
}

void Walk::handlers(Time after, Time by) {
    for (uint32_t number = 1; const BusCauses::HandlerRun* const one = bus_->run(number);
         ++number) {
        if (is_within(one->at, after, by)) tell_alone([&] { run(number); });
    }
}

}  // namespace vagus::record
