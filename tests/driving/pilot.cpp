#include "pilot.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/file.hpp"
#include "base/test_places.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;

constexpr Duration kAliveEvery = 100ms;

session::SimSession make(sim::WorldDefinition world, uint64_t seed) {
    session::SimOptions options;
    options.traced = true;
    options.heard = true;
    options.world.seed = seed;
    auto made = sim::World::create(std::move(world), options.world);
    EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().what);
    return session::SimSession(std::move(made.value()), options);
}

}  // namespace

std::string text_of(const std::string& script) {
    const auto text = read_file(test::examples(script));
    EXPECT_TRUE(text.ok()) << script;
    return text.value();
}

Pilot::Pilot(sim::WorldDefinition world, const std::string& script, uint64_t seed)
    : Pilot(std::move(world), test::examples(script), text_of(script), seed) {}

Pilot::Pilot(sim::WorldDefinition world, const std::string& path, const std::string& text,
             uint64_t seed)
    : session_(make(std::move(world), seed)), path_(path) {
    session_.load_for(session_.nodes().front().robot, path, text);
    EXPECT_TRUE(session_.settle());
    EXPECT_TRUE(session_.mistakes().empty());
}

void Pilot::send(const std::string& event, const std::vector<int16_t>& arguments) {
    const Status sent = session_.emit(event, arguments, now());
    EXPECT_TRUE(sent.ok()) << (sent.ok() ? "" : sent.error().what);
}

void Pilot::millisecond() {
    if (alive_ && now() % kAliveEvery == Duration::zero()) send("drive.alive", {*alive_});
    session_.step(1ms);
    for (const debug::Event& event : session_.take_heard()) {
        if (const auto* sent = std::get_if<debug::UserEvent>(&event.what))
            heard_.push_back({now(), sent->name, sent->arguments});
    }
}

void Pilot::step(Duration span) {
    for (const Time end = now() + span; now() < end;) millisecond();
}

bool Pilot::wait_for(const std::string& event, const std::vector<int16_t>& arguments,
                     Duration span) {
    const size_t before = count(event, arguments);
    for (const Time end = now() + span; now() < end;) {
        millisecond();
        if (count(event, arguments) > before) return true;
    }
    return false;
}

size_t Pilot::count(const std::string& event, const std::vector<int16_t>& arguments) const {
    return static_cast<size_t>(std::count_if(heard_.begin(), heard_.end(), [&](const Heard& each) {
        return each.event == event && each.arguments == arguments;
    }));
}

std::optional<std::vector<int16_t>> Pilot::next(const std::string& event, Duration span) {
    for (const Time end = now() + span; now() < end;) {
        const size_t before = heard_.size();
        millisecond();
        for (size_t i = before; i < heard_.size(); ++i)
            if (heard_[i].event == event) return heard_[i].arguments;
    }
    return std::nullopt;
}

size_t Pilot::count(const std::string& event) const {
    return static_cast<size_t>(std::count_if(
        heard_.begin(), heard_.end(), [&event](const Heard& each) { return each.event == event; }));
}

sim::Pose Pilot::pose() const {
    return session_.world().robots().front().pose;
}

int16_t Pilot::variable(const std::string& name, size_t index) const {
    const auto values = session_.node_variable(session_.nodes().front().robot, name);
    if (index < values.size()) return values[index];
    ADD_FAILURE() << "no variable " << name;
    return 0;
}

}  // namespace vagus
