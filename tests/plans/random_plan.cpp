#include "tests/plans/random_plan.hpp"

#include <fmt/format.h>

#include "base/rng.hpp"
#include "plan/formula.hpp"

namespace vagus {

namespace {

class Maker {
public:
    Maker(uint64_t seed, int sub_plans) : random_(seed), sub_plans_(sub_plans) {}

    std::string plan(const std::string& name, int depth) {
        actors_ = 2 + static_cast<int>(random_.below(5));
        supervisors_ = 0;
        depth_ = depth;
        std::string text = fmt::format(
            "{{\n  \"format\": \"vagus-plan/1\",\n  \"name\": \"{}\",\n  \"configuration\": {{\n"
            "    \"n\": {{ \"type\": \"int\", \"initial\": 0, \"access\": \"{}\" }},\n"
            "    \"f\": {{ \"type\": \"float\", \"initial\": 0.5 }},\n"
            "    \"b\": {{ \"type\": \"bool\", \"initial\": false }},\n"
            "    \"s\": {{ \"type\": \"string\", \"initial\": \"7\" }}\n  }},\n",
            name, depth == 0 ? "out" : "inout");
        text += fmt::format("  \"start\": {{ \"actor\": \"a0\", \"supervisors\": {{{}}} }},\n",
                            supervisors(2));
        text += "  \"actors\": {\n";
        for (int i = 0; i < actors_; ++i) {
            text += fmt::format("    \"a{}\": {}{}\n", i, actor(), i + 1 < actors_ ? "," : "");
        }
        return text + "  }\n}\n";
    }

private:
    uint64_t below(uint64_t bound) { return random_.below(bound); }

    // Whole milliseconds, often equal, so that many things fall due at one instant.
    std::string seconds() {
        constexpr double kTimes[] = {0, 0.001, 0.01, 0.02, 0.02, 0.05, 0.1, 0.3};
        return fmt::format("{}", kTimes[below(8)]);
    }

    // ---- formulas: of each type, with all operators and functions; some fail at run time ----

    template <size_t N>
    std::string one_of(const char* const (&words)[N]) {
        return words[below(N)];
    }

    std::string number(int depth) {
        if (depth == 0) {
            constexpr const char* kNumbers[] = {"n", "f", "b", "0", "1", "2.5", "7", "'3'"};
            return one_of(kNumbers);
        }
        const std::string a = number(depth - 1);
        switch (below(6)) {
            case 0:
                return fmt::format("({} {} {})", a, "+-*"[below(3)], number(depth - 1));
            case 1:
                return fmt::format("({} % (1 + abs({})))", a, number(depth - 1));
            case 2:
                return fmt::format("if({}, {}, {})", condition(depth - 1), a, number(depth - 1));
            case 3: {
                constexpr const char* kFolds[] = {"min", "max"};
                return fmt::format("{}({}, {}, {})", one_of(kFolds), a, number(depth - 1),
                                   number(0));
            }
            case 4:
                return fmt::format("clamp({}, -9, {})", a, number(0));
            default: {
                constexpr const char* kFunctions[] = {"abs",  "sign", "floor", "ceil", "round",
                                                      "sqrt", "sin",  "cos",   "tan",  "-"};
                return fmt::format("{}({})", one_of(kFunctions), a);
            }
        }
    }

    std::string condition(int depth) {
        if (depth == 0) return below(2) == 0 ? "b" : "n";
        constexpr const char* kCompare[] = {"==", "!=", "<", "<=", ">", ">="};
        constexpr const char* kJoin[] = {"and", "or"};
        switch (below(4)) {
            case 0:
                return fmt::format("({} {} {})", condition(depth - 1), one_of(kJoin),
                                   condition(depth - 1));
            case 1:
                return fmt::format("(not {})", condition(depth - 1));
            case 2:
                return fmt::format("(s & {} {} s)", number(0), one_of(kCompare));
            default:
                return fmt::format("({} {} {})", number(depth - 1), one_of(kCompare),
                                   number(depth - 1));
        }
    }

    // With a variable in it: a constant one that fails is an error of the plan (P11).
    std::string formula() { return with_variable(below(2) == 0 ? number(2) : condition(2)); }

    static std::string with_variable(std::string text) {
        return plan::parse_formula(text).value().names().empty() ? "n" : text;
    }

    std::string target(bool event) {
        const uint64_t pick = below(10);
        if (pick == 0) return "@terminate";
        if (event && pick < 4) return "@ignore";
        return fmt::format("a{}", below(static_cast<uint64_t>(actors_)));
    }

    std::string supervisor() {
        switch (below(4)) {
            case 0:
                return fmt::format(R"("template": "Timeout", "in": {{ "seconds": {} }}, )"
                                   R"("events": {{ "Timeout": "{}" }})",
                                   seconds(), target(true));
            case 1:
                return fmt::format(
                    R"("template": "Every", "period_ms": {}, "in": {{ "seconds": {} }}, )"
                    R"("out": {{ "count": "n" }}, "events": {{ "Tick": "{}" }})",
                    1 + below(30), seconds(), target(true));
            case 2:
                return fmt::format(R"("template": "Watch", "in": {{ "left": "{}", "op": "'>'", )"
                                   R"("right": {} }}, "events": {{ "True": "{}" }})",
                                   below(2) == 0 ? "n" : with_variable(number(1)), below(6),
                                   target(true));
            default:
                return fmt::format(R"("template": "OnEvent", "in": {{ "event": "'e{}'" }}, )"
                                   R"("out": {{ "arg0": "f" }}, "events": {{ "Received": "{}" }})",
                                   below(2), target(true));
        }
    }

    std::string supervisors(uint64_t most) {
        std::string list;
        for (uint64_t i = below(most + 1); i > 0; --i) {
            list += fmt::format("{} \"s{}\": {{ {} }}", list.empty() ? "" : ",", supervisors_++,
                                supervisor());
        }
        return list;
    }

    std::string timed(const std::string& body, const std::string& states) {
        return fmt::format("{{ {}, \"states\": {{ {} }}, \"supervisors\": {{{}}} }}", body, states,
                           supervisors(3));
    }

    std::string actor() {
        const std::string next = target(false);
        switch (below(depth_ < sub_plans_ ? 9 : 8)) {
            case 0:
            case 1:
                return timed(
                    fmt::format(R"("template": "Wait", "in": {{ "seconds": {} }})", seconds()),
                    fmt::format(R"("Done": "{}")", next));
            case 2:
                return timed(
                    fmt::format(
                        R"("template": "Stubborn", "in": {{ "seconds": {}, "linger": {} }})",
                        seconds(), seconds()),
                    fmt::format(R"("Done": "{}")", next));
            case 3:
                return timed(
                    fmt::format(R"("template": "Send", "in": {{ "event": "'e{}'", "args": "n" }})",
                                below(2)),
                    fmt::format(R"("Sent": "{}")", next));
            case 4:
                return timed(R"("template": "Log", "in": { "text": "n & f & b & s" })",
                             fmt::format(R"("Done": "{}")", next));
            case 5:
                return fmt::format(
                    R"({{ "template": "Assign", "in": {{ "value": "{}" }}, )"
                    R"("out": {{ "result": "{}" }}, "states": {{ "Done": "{}" }} }})",
                    below(2) == 0 ? fmt::format("n + {}", below(3)) : formula(), "nfbs"[below(4)],
                    next);
            case 6:
                return fmt::format(
                    R"({{ "template": "Compare", "in": {{ "left": "n", "op": "'<'", )"
                    R"("right": {} }}, "states": {{ "True": "{}", "False": "{}" }} }})",
                    below(9), next, target(false));
            case 7:
                return fmt::format(
                    R"({{ "template": "Random", "in": {{ "low": "0 - n", "high": {} }}, )"
                    R"("out": {{ "value": "n" }}, "states": {{ "Done": "{}" }} }})",
                    below(9), next);
            default:
                return timed(fmt::format(R"("plan": "sub{}.plan.json", "in": {{ "n": "n" }}, )"
                                         R"("out": {{ "n": "n" }})",
                                         depth_ + 1),
                             fmt::format(R"("OK": "{}", "Interrupted": "{}", "Error": "{}")", next,
                                         target(false), target(false)));
        }
    }

    SplitMix64 random_;
    int sub_plans_;
    int actors_ = 0;
    int supervisors_ = 0;
    int depth_ = 0;
};

}  // namespace

RandomPlans::RandomPlans(uint64_t seed) {
    constexpr int kSubPlans = 2;
    Maker maker(seed, kSubPlans);
    texts_["main.plan.json"] = maker.plan("Main", 0);
    for (int depth = 1; depth <= kSubPlans; ++depth) {
        texts_[fmt::format("sub{}.plan.json", depth)] =
            maker.plan(fmt::format("Sub{}", depth), depth);
    }
}

Result<std::string> RandomPlans::read(const std::string& path) const {
    const auto found = texts_.find(path);
    if (found == texts_.end()) return Error{Code::NotFound, "there is no " + path};
    return found->second;
}

}  // namespace vagus
