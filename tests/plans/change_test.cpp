// Hot changes of plans made at random, in virtual time (docs/plans.md, P31): accepted exactly when
// the oracle says so, told as it says, and without effect where nothing differs.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "plan/graph.hpp"
#include "run/debugger.hpp"
#include "run/virtual_time.hpp"
#include "tests/plans/change_oracle.hpp"
#include "tests/plans/random_change.hpp"
#include "tests/plans/random_plan.hpp"
#include "tests/plans/trace_rules.hpp"
#include "toolbox/core.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;
using Texts = ChangeOracle::Texts;

constexpr uint64_t kLinesMax = 1500;  // many random plans have loops that take no time
constexpr Duration kTimeMax = 2s;

uint64_t first_seed() {
    const char* seed = std::getenv("VAGUS_SEED");
    return seed ? std::strtoull(seed, nullptr, 10) : 1;
}

uint64_t long_or(uint64_t usual, uint64_t when_long) {
    return std::getenv("VAGUS_LONG") ? when_long : usual;
}

class JsonFiles final : public plan::Files {
public:
    explicit JsonFiles(const Texts& texts) : texts_(texts) {}
    Result<std::string> read(const std::string& path) const override {
        return texts_.at(path).dump(1);
    }

private:
    const Texts& texts_;
};

Texts texts_of(const RandomPlans& plans) {
    Texts texts;
    for (const auto& [path, text] : plans.texts()) texts[path] = ChangeOracle::Json::parse(text);
    return texts;
}

// A random plan that runs, and is changed now and then.
class Changed {
public:
    Changed(uint64_t seed, const run::CodeLibrary& library)
        : library_(library),
          random_(seed * 7919),
          oracle_(texts_of(RandomPlans(seed))),
          first_(graph_of(oracle_.newest())),
          rules_(*first_),
          debugger_(*first_, run::Debugger::At::Run) {}

    enum class Kind { Random, Nothing };
    void run(Kind kind, int times) {
        kind_ = kind;
        for (int i = 0; i < times; ++i) moments_.insert(1 + random_.below(200));
        run::RunOptions options;
        options.max_time = kTimeMax;
        options.debugger = &debugger_;
        options.on_trace = [this](const plan::TraceEvent& event) { see(event); };
        run::VirtualTime run(*first_, library_, options);
        running_ = &run;
        run.run();
        take_answers();
        compare_lines();
        for (const std::string& breach : rules_.finish()) complain(breach);
    }

    const std::string& trace() const { return trace_; }  // without the lines of changes
    const std::vector<std::string>& complaints() const { return complaints_; }
    int asked() const { return asked_; }
    int accepted() const { return accepted_; }

private:
    void complain(const std::string& what) {
        if (complaints_.size() < 10) complaints_.push_back(what);
    }

    std::shared_ptr<const plan::Graph> graph_of(const Texts& texts) const {
        const plan::Checked checked =
            plan::check("main.plan.json", JsonFiles(texts), library_.templates());
        return checked.ok() ? std::make_shared<const plan::Graph>(plan::make_graph(checked))
                            : nullptr;
    }

    void see(const plan::TraceEvent& event) {
        take_answers();
        rules_.see(event);
        if (std::holds_alternative<plan::PlanChanged>(event.what)) {
            lines_.push_back(event.plan + " change");
            return;
        }
        const auto* written = std::get_if<plan::VariableWritten>(&event.what);
        if (written && written->by == "change") {
            lines_.push_back(
                fmt::format("{} {} = {}", event.plan, written->variable,
                            plan::convert(written->value, plan::Type::String).value().string()));
            return;
        }
        compare_lines();
        trace_ += plan::format_trace(event) + "\n";
        oracle_.see(event);
        ++seen_;
        if (seen_ >= kLinesMax) {
            running_->abort();
        } else if (moments_.contains(seen_) && !waits_ && event.at < kTimeMax) {
            ask();
        }
    }

    // What is posted now is taken at the end of this decision.
    void ask() {
        next_ = oracle_.newest();
        changed_ = kind_ == Kind::Random ? change_at_random(next_, random_) : some_file();
        auto graph = graph_of(next_);
        if (!graph) {  // it has check errors: nobody hands it in
            ++asked_;
            return;
        }
        graphs_.push_back(graph);
        waits_ = true;
        ASSERT_TRUE(debugger_.post(run::TakeVersion{{graph, {changed_}}}).ok());
    }

    std::string some_file() {
        auto file = oracle_.newest().begin();
        std::advance(file, static_cast<std::ptrdiff_t>(random_.below(oracle_.newest().size())));
        return file->first;
    }

    void take_answers() {
        while (const auto report = debugger_.wait_report(0ms)) {
            const auto* answer = std::get_if<run::Answer>(&*report);
            if (answer) judge(std::get<run::Change>(answer->reply.value()).reasons);
        }
    }

    void judge(const std::vector<std::string>& reasons) {
        waits_ = false;
        ++asked_;
        const bool accepts = oracle_.accepts(next_);
        if (accepts != reasons.empty()) {
            complain(fmt::format("{} after {} lines: the oracle says {}; reasons: {}\n{}", changed_,
                                 seen_, accepts ? "accepted" : "refused", fmt::join(reasons, "; "),
                                 next_[changed_].dump(1)));
        }
        if (!reasons.empty()) return;
        ++accepted_;
        expected_ = oracle_.accept(next_, changed_);
        lines_.clear();
    }

    void compare_lines() {
        if (lines_ != expected_) {
            complain(fmt::format("expected: {}; found: {}", fmt::join(expected_, ", "),
                                 fmt::join(lines_, ", ")));
        }
        lines_ = expected_ = {};
    }

    const run::CodeLibrary& library_;
    SplitMix64 random_;
    ChangeOracle oracle_;
    std::shared_ptr<const plan::Graph> first_;
    TraceRules rules_;
    run::Debugger debugger_;
    run::VirtualTime* running_ = nullptr;
    std::vector<std::shared_ptr<const plan::Graph>> graphs_;
    Kind kind_ = Kind::Random;
    std::set<uint64_t> moments_;  // numbers of lines
    uint64_t seen_ = 0;
    bool waits_ = false;  // for an answer; none comes when the plan has ended
    Texts next_;
    std::string changed_;
    std::vector<std::string> lines_, expected_;
    std::string trace_;
    std::vector<std::string> complaints_;
    int asked_ = 0, accepted_ = 0;
};

TEST(RandomChanges, AreAcceptedExactlyWhenP31SaysSoAndToldAsItSays) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const uint64_t first = first_seed();
    std::cout << "seeds from " << first << "\n";
    uint64_t asked = 0, accepted = 0, seed = first;
    for (; asked < long_or(1000, 20'000); ++seed) {
        Changed changed(seed, library);
        changed.run(Changed::Kind::Random, 6);
        ASSERT_EQ(changed.complaints(), std::vector<std::string>()) << "seed " << seed;
        asked += static_cast<uint64_t>(changed.asked());
        accepted += static_cast<uint64_t>(changed.accepted());
    }
    std::cout << asked << " changes of " << seed - first << " plans, " << accepted << " accepted\n";
    // Neither answer is rare.
    EXPECT_GT(accepted, asked / 5);
    EXPECT_LT(accepted, asked - asked / 5);
}

TEST(RandomChanges, OneThatChangesNothingLeavesTheTraceAsItIsWithoutIt) {
    run::CodeLibrary library;
    toolbox::add_core(library);
    const uint64_t first = first_seed();
    std::cout << "seeds from " << first << "\n";
    for (uint64_t seed = first; seed < first + long_or(60, 3'000); ++seed) {
        Changed without(seed, library), with(seed, library);
        without.run(Changed::Kind::Nothing, 0);
        with.run(Changed::Kind::Nothing, 5);
        ASSERT_EQ(with.complaints(), std::vector<std::string>()) << "seed " << seed;
        ASSERT_EQ(with.accepted(), with.asked()) << "seed " << seed;
        ASSERT_EQ(with.trace(), without.trace()) << "seed " << seed;
    }
}

}  // namespace
}  // namespace vagus
