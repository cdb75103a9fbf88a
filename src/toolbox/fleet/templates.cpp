#include "toolbox/fleet/templates.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "keeper/keeper.hpp"
#include "plan/value.hpp"
#include "toolbox/core_values.hpp"
#include "toolbox/fleet/talk.hpp"

namespace vagus::toolbox {

namespace {

using plan::Type;
using plan::Value;
using run::ActorContext;
using run::CodeError;

// ---- what templates share ----

Value text(std::string value) {
    return Value(std::move(value));
}

// Of an input in seconds; beyond what the keeper allows it is what it allows.
Duration lease_length(const Value& seconds) {
    return std::clamp<Duration>(duration_of(seconds.number()), keeper::kLeaseMin,
                                keeper::kLeaseMax);
}

std::string name_of(const Value& value, std::string_view what) {
    std::string name = value.string();
    if (name.empty() || name.size() > keeper::kNameMax) {
        throw CodeError(fmt::format("{}: expected 1 to {} bytes, found {}", what, keeper::kNameMax,
                                    name.size()));
    }
    return name;
}

std::string data_of(const Value& value) {
    std::string data = json_of_text(value.string());
    if (data.size() > keeper::kTextMax) {
        throw CodeError(fmt::format("a text of {} bytes is more than the {} that a keeper keeps",
                                    data.size(), keeper::kTextMax));
    }
    return data;
}

keeper::Term term_of(const Value& lease) {
    const auto term = keeper::read_term(lease.string());
    if (term) return *term;
    throw CodeError(fmt::format("\"{}\" is no lease: use the output `lease` of TakeTask or Claim",
                                lease.string()));
}

double number_in(const std::string& data) {
    const Result<double> number = plan::float_from_text(data);
    return number.ok() ? number.value() : 0;
}

// ---- tasks ----

class GiveTask final : public run::Actor {
public:
    explicit GiveTask(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        std::string id = context.in(1).string();
        // The same activation gives the same task, however often it is asked.
        if (id.empty()) id = fmt::format("{}-{}", talk.fleet().me(), context.number());
        context.out(0, text(id));
        const auto reply =
            talk.ask(keeper::Give{name_of(context.in(0), "queue"), id, data_of(context.in(2))});
        context.end(!reply ? 2 : reply->outcome == keeper::Outcome::Done ? 0 : 1);
    }

private:
    const Parts& parts_;
};

class TakeTask final : public run::Actor {
public:
    explicit TakeTask(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        const keeper::Take take{name_of(context.in(0), "queue"), lease_length(context.in(1))};
        const auto reply = talk.ask_until(take, duration_of(context.in(2).number()));
        if (!reply) return context.end(2);
        const auto* const task =
            reply->record ? std::get_if<keeper::Task>(&*reply->record) : nullptr;
        if (reply->outcome != keeper::Outcome::Done || task == nullptr) return context.end(1);
        const std::string data = text_of_json(task->data);
        context.out(0, text(task->id));
        context.out(1, text(data));
        context.out(2, Value(number_in(data)));
        context.out(3, text(keeper::text_of(task->lease.term)));
        context.end(0);
    }

private:
    const Parts& parts_;
};

class FinishTask final : public run::Actor {
public:
    explicit FinishTask(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        const auto reply = talk.ask(keeper::Finish{term_of(context.in(0)), data_of(context.in(1))});
        context.end(!reply ? 2 : reply->outcome == keeper::Outcome::Done ? 0 : 1);
    }

private:
    const Parts& parts_;
};

// ---- names ----

class Claim final : public run::Actor {
public:
    explicit Claim(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        const keeper::ClaimName claim{name_of(context.in(0), "name"), lease_length(context.in(1))};
        const auto reply = talk.ask_until(claim, duration_of(context.in(2).number()));
        if (!reply) return context.end(2);
        const auto* const claimed =
            reply->record ? std::get_if<keeper::Claim>(&*reply->record) : nullptr;
        if (reply->outcome != keeper::Outcome::Done || claimed == nullptr) return context.end(1);
        context.out(0, text(keeper::text_of(claimed->lease.term)));
        context.end(0);
    }

private:
    const Parts& parts_;
};

class Release final : public run::Actor {
public:
    explicit Release(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        context.end(talk.ask(keeper::Release{term_of(context.in(0))}) ? 0 : 1);
    }

private:
    const Parts& parts_;
};

// By this robot's clock, from when the question was sent.
class LeaseLost final : public run::Supervisor {
public:
    explicit LeaseLost(const Parts& parts) : parts_(parts) {}
    std::optional<plan::Given> check(const run::Check& check) override {
        if (check.in[0].string().empty()) return std::nullopt;
        if (fleet_of(parts_).holds(term_of(check.in[0]))) return std::nullopt;
        return plan::Given{};
    }

private:
    const Parts& parts_;
};

// ---- values ----

class ReadShared final : public run::Actor {
public:
    explicit ReadShared(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        const auto shared = fleet_of(parts_).shared(name_of(context.in(0), "key"));
        if (!shared) return context.end(1);
        const std::string value = text_of_json(shared->value);
        context.out(0, text(value));
        context.out(1, Value(number_in(value)));
        context.out(2, text(keeper::text_of(shared->version)));
        context.end(0);
    }

private:
    const Parts& parts_;
};

class WriteShared final : public run::Actor {
public:
    explicit WriteShared(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        keeper::Write write{name_of(context.in(0), "key"), {}, data_of(context.in(1))};
        if (!context.in(2).string().empty()) write.seen = term_of(context.in(2));
        const auto reply = talk.ask(write);
        const auto* const shared =
            reply && reply->record ? std::get_if<keeper::Shared>(&*reply->record) : nullptr;
        if (shared != nullptr) context.out(0, text(keeper::text_of(shared->version)));
        context.end(!reply ? 2 : reply->outcome == keeper::Outcome::Done ? 0 : 1);
    }

private:
    const Parts& parts_;
};

// ---- robots ----

class RobotsOnline final : public run::Actor {
public:
    explicit RobotsOnline(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Fleet& fleet = fleet_of(parts_);
        const std::vector<std::string> online = fleet.online();
        std::string names;
        for (const std::string& one : online) names += (names.empty() ? "" : " ") + one;
        const auto me = std::find(online.begin(), online.end(), fleet.me());
        const auto place = me == online.end() ? 0 : me - online.begin() + 1;
        context.out(0, Value(static_cast<int64_t>(online.size())));
        context.out(1, text(names));
        context.out(2, text(fleet.me()));
        context.out(3, Value(static_cast<int64_t>(place)));
    }

private:
    const Parts& parts_;
};

// A count of all that have come, kept by the keeper: the first N are the first meeting.
class WaitForRobots final : public run::Actor {
public:
    explicit WaitForRobots(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        Talk talk(context, parts_);
        const std::string key = "meeting." + name_of(context.in(1), "meeting");
        const int64_t robots = context.in(0).integer();
        if (robots < 1) {
            throw CodeError(fmt::format("robots: expected 1 or more, found {}", robots));
        }
        const auto came = come(talk, key);
        if (!came) return context.end(2);
        const int64_t all = ((*came - 1) / robots + 1) * robots;
        const bool met = talk.wait_until([&] { return count(talk, key) >= all; },
                                         duration_of(context.in(2).number()));
        context.end(met ? 0 : 1);
    }

private:
    static int64_t count(Talk& talk, const std::string& key) {
        const auto shared = talk.fleet().shared(key);
        return shared ? static_cast<int64_t>(number_in(text_of_json(shared->value))) : 0;
    }

    // Which one it is, from 1; nothing: no keeper answers. Two that come at once see each other's
    // version, and one counts again.
    static std::optional<int64_t> come(Talk& talk, const std::string& key) {
        std::optional<keeper::Shared> seen = talk.fleet().shared(key);
        while (true) {
            const int64_t next =
                seen ? static_cast<int64_t>(number_in(text_of_json(seen->value))) + 1 : 1;
            keeper::Write write{key, {}, json_of_text(std::to_string(next))};
            if (seen) write.seen = seen->version;
            const auto reply = talk.ask(write);
            if (!reply) return std::nullopt;
            if (reply->outcome == keeper::Outcome::Done) return next;
            if (reply->outcome == keeper::Outcome::Refused) throw CodeError(reply->why);
            const auto* const now =
                reply->record ? std::get_if<keeper::Shared>(&*reply->record) : nullptr;
            if (now != nullptr) seen = *now;
        }
    }

    const Parts& parts_;
};

// ---- events ----

class Tell final : public run::Actor {
public:
    explicit Tell(const Parts& parts) : parts_(parts) {}
    void run(ActorContext& context) override {
        fleet_of(parts_).tell(name_of(context.in(0), "name"), words_of(context.in(1).string()));
    }

private:
    const Parts& parts_;
};

class OnFleetEvent final : public run::Supervisor {
public:
    explicit OnFleetEvent(const Parts& parts) : parts_(parts) {}
    void started(const std::vector<Value>&, run::SupervisorContext&) override {
        (void)fleet_of(parts_);
    }
    std::optional<plan::Given> check(const run::Check& check) override {
        const std::string prefix = fleet_event(check.in[0].string(), "");
        if (!check.event->name.starts_with(prefix)) return std::nullopt;
        const std::string from = check.event->name.substr(prefix.size());
        const std::string& wanted = check.in[1].string();
        if (!wanted.empty() && wanted != from) return std::nullopt;
        plan::Given given{.outcome = 0, .outputs = {}};
        given.outputs.emplace_back(text(from));
        for (size_t i = 0; i < run::kEventArgumentsMax; ++i) {
            const auto& words = check.event->arguments;
            given.outputs.emplace_back(Value(int64_t{i < words.size() ? words[i] : int16_t{0}}));
        }
        return given;
    }

private:
    const Parts& parts_;
};

// ---- declarations ----

plan::Input input(std::string name, Type type, std::string help, std::optional<Value> fallback = {},
                  std::string unit = "") {
    return {.name = std::move(name),
            .type = type,
            .fallback = std::move(fallback),
            .unit = std::move(unit),
            .help = std::move(help)};
}

plan::OutputDeclaration output(std::string name, Type type, std::string help) {
    return {.name = std::move(name), .type = type, .help = std::move(help)};
}

plan::Input lease_input() {
    return input("lease", Type::String, "the output `lease` of TakeTask or Claim");
}

plan::Input length_input(double seconds) {
    return input("seconds", Type::Float,
                 "how long the lease is, 1 to 60; it is renewed while the robot lives",
                 Value(seconds), "s");
}

plan::Input patience_input(double seconds, std::string help) {
    return input("wait", Type::Float, std::move(help), Value(seconds), "s");
}

constexpr std::string_view kNoKeeper = "no keeper has answered for 30 seconds";

template <typename Code>
run::Coded actor(plan::Template declared, const Parts& parts) {
    declared.needs_fleet = true;
    return {std::move(declared), [&parts] { return std::make_unique<Code>(parts); }, {}};
}

template <typename Code>
run::Coded supervisor(plan::Template declared, const Parts& parts) {
    declared.kind = plan::Kind::Supervisor;
    declared.needs_fleet = true;
    return {std::move(declared), {}, [&parts] { return std::make_unique<Code>(parts); }};
}

void add_tasks(std::vector<run::Coded>& all, const Parts& parts) {
    all.push_back(actor<GiveTask>(
        {.name = "GiveTask",
         .help = "Gives a task to the fleet: exactly one robot at a time has it, until it is "
                 "finished.",
         .icon = "M4 6h10v12H4zM14 12h7M18 9l3 3l-3 3",
         .inputs = {input("queue", Type::String, "where robots look for it"),
                    input("task", Type::String,
                          "its name: given twice it is there once; empty: one is made", text("")),
                    input("data", Type::String, "what the robot needs to know", text(""))},
         .outputs = {output("task", Type::String, "its name")},
         .outcomes = {{"Given", "the keeper keeps it"},
                      {"Refused", "the keeper has no room for it"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
    all.push_back(actor<TakeTask>(
        {.name = "TakeTask",
         .help = "Takes the oldest task of a queue. It is this robot's as long as its lease: watch "
                 "that with LeaseLost, and drop the task when it is lost.",
         .icon = "M10 6h10v12H10zM3 12h7M7 9l3 3l-3 3",
         .inputs = {input("queue", Type::String, "where to look"), length_input(30),
                    patience_input(10, "how long it waits for one")},
         .outputs = {output("task", Type::String, "its name"),
                     output("data", Type::String, "what its giver said"),
                     output("number", Type::Float, "the same as a number; 0 if it is none"),
                     output("lease", Type::String, "for FinishTask and LeaseLost")},
         .outcomes = {{"Taken", "it is this robot's"},
                      {"NoTask", "none was waiting"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
    all.push_back(actor<FinishTask>(
        {.name = "FinishTask",
         .help = "Says that a task is done.",
         .icon = "M4 6h10v12H4zM13 12l4 4l5-8",
         .inputs = {lease_input(), input("result", Type::String, "for whoever gave it", text(""))},
         .outcomes = {{"Finished", "it is done"},
                      {"Lost", "the lease was over: another robot may have the task"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
}

void add_names(std::vector<run::Coded>& all, const Parts& parts) {
    all.push_back(actor<Claim>(
        {.name = "Claim",
         .help = "Claims a name, as that of an aisle, which one robot has at a time. Who has no "
                 "lease does not enter.",
         .icon = "M6 21V4h11l-3 4l3 4H6",
         .inputs = {input("name", Type::String, "what is claimed"), length_input(10),
                    patience_input(60, "how long it waits until it is free")},
         .outputs = {output("lease", Type::String, "for Release and LeaseLost")},
         .outcomes = {{"Claimed", "it is this robot's"},
                      {"NotFree", "another robot had it all the time"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
    all.push_back(actor<Release>(
        {.name = "Release",
         .help = "Gives back what was claimed, or a task undone.",
         .icon = "M6 21V4h11l-3 4l3 4H6M3 3l18 18",
         .inputs = {lease_input()},
         .outcomes = {{"Released", "others can have it"},
                      {"NoKeeper", std::string(kNoKeeper) + "; the lease ends by itself"}}},
        parts));
    all.push_back(supervisor<LeaseLost>(
        {.name = "LeaseLost",
         .help = "Raises its event when a lease has ended without this robot's doing: it drops the "
                 "task, or leaves.",
         .icon = "M12 3a9 9 0 1 0 0 18a9 9 0 0 0 0-18M12 7v5l3 2M4 4l16 16",
         .inputs = {lease_input()},
         .outcomes = {{"LeaseLost", "by this robot's own clock"}},
         .period_ms = 100},
        parts));
}

void add_values(std::vector<run::Coded>& all, const Parts& parts) {
    all.push_back(actor<ReadShared>(
        {.name = "ReadShared",
         .help = "Reads a value that all robots share.",
         .icon = "M4 5h16v14H4zM8 10h8M8 14h5",
         .inputs = {input("key", Type::String, "its name")},
         .outputs = {output("value", Type::String, "as it was written last"),
                     output("number", Type::Float, "the same as a number; 0 if it is none"),
                     output("version", Type::String, "for WriteShared")},
         .outcomes = {{"Read", "there is one"}, {"Nothing", "nobody has written it"}}},
        parts));
    all.push_back(actor<WriteShared>(
        {.name = "WriteShared",
         .help = "Writes a value that all robots share, unless another was faster.",
         .icon = "M4 5h16v14H4zM8 15l8-8",
         .inputs = {input("key", Type::String, "its name"),
                    input("value", Type::String, "what it will be"),
                    input("version", Type::String, "that ReadShared gave; empty: it is a new one",
                          text(""))},
         .outputs = {output("version", Type::String, "as it is now")},
         .outcomes = {{"Written", "all will read it"},
                      {"Changed", "another robot has written it: read it again"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
}

void add_robots(std::vector<run::Coded>& all, const Parts& parts) {
    all.push_back(actor<RobotsOnline>(
        {.name = "RobotsOnline",
         .help = "Which robots of the fleet are online.",
         .icon = "M5 10h6v6H5zM13 10h6v6h-6zM8 10V7M16 10V7",
         .outputs = {output("count", Type::Int, "how many, this one among them"),
                     output("names", Type::String, "with spaces between"),
                     output("me", Type::String, "the name of this robot"),
                     output("place", Type::Int, "of this robot among them, from 1")},
         .outcomes = {{"Done", "as the fleet told it last"}}},
        parts));
    all.push_back(actor<WaitForRobots>(
        {.name = "WaitForRobots",
         .help = "Waits until so many robots have come to the same meeting.",
         .icon = "M4 14h5v5H4zM15 14h5v5h-5zM6 14l6-8l6 8",
         .inputs = {input("robots", Type::Int, "how many, this one among them"),
                    input("meeting", Type::String, "its name", text("start")),
                    patience_input(60, "how long it waits for the others")},
         .outcomes = {{"Met", "all are there"},
                      {"TimeOver", "not all have come"},
                      {"NoKeeper", std::string(kNoKeeper)}}},
        parts));
}

void add_events(std::vector<run::Coded>& all, const Parts& parts) {
    all.push_back(actor<Tell>(
        {.name = "Tell",
         .help = "Tells all who watch the robot the value of a variable of its plan.",
         .icon = "M4 12a8 8 0 0 1 8-8M4 12h3M8 12a4 4 0 0 1 4-4M12 12h8",
         .inputs = {input("name", Type::String, "of the variable"),
                    input("values", Type::String, "up to eight whole numbers, as \"1 2 3\"")},
         .outcomes = {{"Told", "it is on its way"}}},
        parts));
    std::vector<plan::OutputDeclaration> outputs = {
        output("from", Type::String, "the robot that said it")};
    for (size_t i = 0; i < run::kEventArgumentsMax; ++i) {
        outputs.push_back(output(fmt::format("arg{}", i), Type::Int,
                                 "an argument of the event, 0 if it has fewer"));
    }
    all.push_back(supervisor<OnFleetEvent>(
        {.name = "OnFleetEvent",
         .help = "Raises its event when another robot says this one, which the project hears.",
         .icon = "M12 3v6M12 9l-4 4h8zM5 20h14",
         .inputs = {input("event", Type::String, "its name"),
                    input("from", Type::String, "the robot; empty: any", text(""))},
         .outputs = std::move(outputs),
         .outcomes = {{"FleetEvent", "it has come"}},
         .period_ms = 0},
        parts));
}

}  // namespace

void add_fleet(run::CodeLibrary& library, const Parts& parts) {
    std::vector<run::Coded> all;
    add_tasks(all, parts);
    add_names(all, parts);
    add_values(all, parts);
    add_robots(all, parts);
    add_events(all, parts);
    library.add("fleet", "Many robots: tasks that exactly one has, names, values that all share.",
                std::move(all));
}

}  // namespace vagus::toolbox
