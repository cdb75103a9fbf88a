// For tests of P31: a machine with a plan that runs in it, driven by hand, and new versions of it.
#pragma once

#include <fmt/format.h>

#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plan/check.hpp"
#include "plan/machine.hpp"

namespace vagus::plan {

using namespace std::chrono_literals;
using Texts = std::map<std::string, std::string>;  // by path

class ChangeTexts final : public Files {
public:
    explicit ChangeTexts(Texts texts) : texts_(std::move(texts)) {}
    Result<std::string> read(const std::string& path) const override {
        const auto found = texts_.find(path);
        if (found == texts_.end()) return Error{Code::NotFound, "there is no " + path};
        return found->second;
    }

private:
    Texts texts_;
};

inline const Library& change_library() {
    static const Library kLibrary = [] {
        const Input speed{.name = "speed", .type = Type::Int, .fallback = Value(int64_t{0})};
        const Input limit{.name = "limit", .type = Type::Int, .fallback = Value(int64_t{0})};
        Toolbox core{.name = "core"};
        core.templates = {{.name = "Drive",
                           .inputs = {speed, limit},
                           .outputs = {{.name = "way", .type = Type::Int}},
                           .outcomes = {{.name = "Done"}}},
                          {.name = "Turn",
                           .inputs = {speed, limit},
                           .outputs = {{.name = "way", .type = Type::Int}},
                           .outcomes = {{.name = "Done"}}},
                          {.name = "See",
                           .kind = Kind::Supervisor,
                           .inputs = {limit},
                           .outputs = {{.name = "what", .type = Type::Int}},
                           .outcomes = {{.name = "Seen"}}},
                          {.name = "Hear",
                           .kind = Kind::Supervisor,
                           .inputs = {limit},
                           .outputs = {{.name = "what", .type = Type::Int}},
                           .outcomes = {{.name = "Seen"}}}};
        Library made;
        made.add(std::move(core));
        return made;
    }();
    return kLibrary;
}

// A text with one place changed, which it must have.
inline std::string with(std::string text, const std::string& here, const std::string& instead) {
    const size_t at = text.find(here);
    if (at == std::string::npos) throw std::invalid_argument("not in the text: " + here);
    return text.replace(at, here.size(), instead);
}

// A plan that runs in a machine, driven by hand. Code stops at once unless it lingers.
class Running {
public:
    explicit Running(Texts texts) : texts_(std::move(texts)), first_(graph_of(texts_)) {
        machine_.emplace(*first_);
        machine_->start({}, 0ms);
        follow();
        trace_.clear();
    }
    explicit Running(const std::string& main) : Running(Texts{{"main.plan.json", main}}) {}

    // These files have these texts now. Gives the reasons against it.
    std::vector<std::string> change(const Texts& texts) {
        Texts next = texts_;
        NewVersion version;
        for (const auto& [path, text] : texts) {
            next[path] = text;
            version.files.push_back(path);
        }
        version.graph = graph_of(next);
        auto reasons = machine_->change(version, now_);
        if (reasons.empty()) texts_ = next;
        follow();
        return reasons;
    }
    std::vector<std::string> change(const std::string& main) {
        return change(Texts{{"main.plan.json", main}});
    }

    void begin() {
        machine_->begin(machine_->activation_at(innermost()), now_);
        follow();
    }
    void end(int64_t way = 0) {
        machine_->end(machine_->activation_at(innermost()), {0, {Value(way)}}, now_);
        follow();
    }
    void raise(const std::string& supervisor, std::optional<int64_t> what = {}) {
        Given given{0, {}};
        if (what) given.outputs.emplace_back(Value(*what));
        machine_->raise(watches_.at(supervisor), given, now_);
        follow();
    }
    void end_sub_plan() {
        machine_->end_sub_plan(machine_->activation_at(innermost()), now_);
        follow();
    }
    void stopped() {
        machine_->stopped(machine_->activation_at(innermost()), now_);
        follow();
    }
    void let_linger() { lingers_ = true; }

    Machine& machine() { return *machine_; }
    bool watches(const std::string& supervisor) const { return watches_.contains(supervisor); }
    std::string limit_of(const std::string& supervisor) {
        return text_of(machine_->read_inputs(watches_.at(supervisor)).value().front());
    }
    std::string value(const std::string& name, int level = 0) const {
        const int slot = find_variable(machine_->plan_at(level), name);
        return slot < 0 ? "gone" : text_of(machine_->variable(level, slot));
    }
    // Since it was asked last: "PLAN kind what".
    std::vector<std::string> trace() { return std::exchange(trace_, {}); }

private:
    static std::string text_of(const Value& value) {
        return convert(value, Type::String).value().string();
    }
    static std::shared_ptr<const Graph> graph_of(const Texts& texts) {
        const std::string first =
            texts.contains("main.plan.json") ? "main.plan.json" : "o.plan.json";
        const Checked checked = check(first, ChangeTexts(texts), change_library());
        if (!checked.ok()) throw std::invalid_argument(format_findings_json(checked.findings));
        return std::make_shared<const Graph>(make_graph(checked));
    }
    int innermost() const { return machine_->depth() - 1; }

    void follow() {
        for (bool more = true; more;) {
            more = false;
            for (const Command& command : machine_->take_commands()) {
                more = true;
                if (const auto* start = std::get_if<StartWatch>(&command)) {
                    watches_[start->supervisor->name] = start->watch;
                } else if (const auto* stop = std::get_if<StopWatch>(&command)) {
                    std::erase_if(watches_,
                                  [stop](const auto& one) { return one.second == stop->watch; });
                } else if (const auto* code = std::get_if<StopCode>(&command)) {
                    if (!lingers_) machine_->stopped(code->activation, now_);
                }
            }
        }
        for (const TraceEvent& event : machine_->take_trace()) trace_.push_back(line_of(event));
    }

    // What of a line this test is about.
    static std::string line_of(const TraceEvent& event) {
        const std::string line = format_trace(event);
        std::string text = event.plan;
        for (const char* key :
             {"kind", "actor", "supervisor", "variable", "value", "by", "in", "target", "result"}) {
            const std::string name = fmt::format("\"{}\":", key);
            const size_t at = line.find(name);
            if (at == std::string::npos) continue;
            size_t end = at + name.size();
            const char last = line[end] == '{' ? '}' : ',';
            while (end < line.size() && line[end] != last && (last == '}' || line[end] != '}'))
                ++end;
            std::string part = line.substr(at + name.size(), end - at - name.size());
            std::erase_if(part, [](char c) { return c == '"' || c == '{'; });
            text += " " + part;
        }
        return text;
    }

    Texts texts_;
    std::shared_ptr<const Graph> first_;
    std::optional<Machine> machine_;
    std::map<std::string, WatchId> watches_;
    std::vector<std::string> trace_;
    Time now_{10ms};
    bool lingers_ = false;
};

}  // namespace vagus::plan
