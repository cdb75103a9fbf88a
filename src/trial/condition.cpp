#include "trial/condition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "trial/plan_names.hpp"

namespace vagus::trial {

namespace {

using Name = Condition::Name;

// Formulas know neither node() nor variable(): before a text is parsed, a name of our own takes the
// place of each.
class Rewriter {
public:
    explicit Rewriter(std::string_view text) : text_(text) {}

    Result<std::string> rewrite() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '"' || c == '\'') {
                copy_string(c);
            } else if (is_letter(c)) {
                TRY(word());
            } else {
                out_ += text_[at_++];
            }
        }
        return out_;
    }
    const std::map<std::string, Name>& names() const { return names_; }

private:
    static bool is_letter(char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '_';
    }

    void copy_string(char quote) {
        const size_t end = text_.find(quote, at_ + 1);
        const size_t behind = end == std::string_view::npos ? text_.size() : end + 1;
        out_ += text_.substr(at_, behind - at_);
        at_ = behind;
    }

    Status word() {
        const size_t begin = at_;
        while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
        const std::string_view word = text_.substr(begin, at_ - begin);
        const size_t behind_word = at_;
        const bool called = peek() == '(';
        if (!called || (word != "node" && word != "variable")) {
            at_ = behind_word;
            out_ += word;
            return Status::done();
        }
        ++at_;
        std::vector<std::string> texts;
        const size_t wanted = word == "node" ? 2 : 1;
        bool good = true;
        for (size_t i = 0; good && i < wanted; ++i) {
            if (i > 0) good = take(',');
            good = good && text(texts);
        }
        if (!good || !take(')')) {
            return Error{Code::BadInput,
                         word == "node"
                             ? "expected two texts, as node(\"drive\", \"token\"), behind node"
                             : "expected a text, as variable(\"angle\"), behind variable"};
        }
        Name name{.shown = std::string(text_.substr(begin, at_ - begin))};
        TRY(fill(name, word == "node", texts));
        const std::string own = fmt::format("name_{}_of_the_test", names_.size() + 1);
        names_.emplace(own, std::move(name));
        out_ += own;
        return Status::done();
    }

    static Status fill(Name& name, bool of_node, const std::vector<std::string>& texts) {
        name.of = of_node ? Name::Of::Word : Name::Of::Variable;
        name.variable = texts.back();
        if (!of_node) return Status::done();
        name.node = texts.front();
        const size_t bracket = name.variable.find('[');
        if (bracket == std::string::npos) return Status::done();
        const std::string digits = name.variable.substr(
            bracket + 1, name.variable.size() - std::min(name.variable.size(), bracket + 2));
        const auto element = decimal_number(digits);
        if (!name.variable.ends_with(']') || !element || *element > UINT16_MAX) {
            return Error{Code::BadInput,
                         fmt::format("\"{}\": expected the number of an element in brackets, as "
                                     "\"touch.sectors[2]\"",
                                     name.variable)};
        }
        name.element = static_cast<uint16_t>(*element);
        name.variable.resize(bracket);
        return Status::done();
    }

    char peek() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    bool text(std::vector<std::string>& to) {
        const char quote = peek();
        if (quote != '"' && quote != '\'') return false;
        const size_t end = text_.find(quote, at_ + 1);
        if (end == std::string_view::npos) return false;
        to.emplace_back(text_.substr(at_ + 1, end - at_ - 1));
        at_ = end + 1;
        return true;
    }

    std::string_view text_;
    size_t at_ = 0;
    std::string out_;
    std::map<std::string, Name> names_;
};

Error no_such_name(const std::string& name, const plan::GraphPlan& plan) {
    std::vector<std::string> known;
    for (const Signal& one : signals()) known.emplace_back(one.name);
    for (const plan::GraphVariable& one : plan.variables) known.push_back(one.name);
    const std::string near = nearest(name, known);
    const plan::FormulaFunction* const function = plan::find_function(name);
    const std::string advice =
        function != nullptr ? fmt::format("the function is written {}", function->form)
        : near.empty()      ? "write a variable of the plan, or a signal of `vagus test --signals`"
                            : fmt::format("did you mean {}?", near);
    return {Code::NotFound, fmt::format("there is no \"{}\" in the plan {}, and no signal of that "
                                        "name; {}",
                                        name, plan.name, advice)};
}

Status bind_variable(Name& name, const plan::GraphPlan& plan) {
    name.slot = plan::find_variable(plan, name.variable);
    if (name.slot < 0) return no_such_name(name.variable, plan);
    return Status::done();
}

Status bind_signal(const Name& name, const plan::GraphPlan& plan, bool has_world) {
    if (plan::find_variable(plan, name.shown) >= 0) {
        return Error{Code::BadInput,
                     fmt::format("\"{0}\" is a signal, and a variable of the plan {1} too; write "
                                 "variable(\"{0}\") for that one, or rename it",
                                 name.shown, plan.name)};
    }
    if (name.signal->of_world && !has_world) {
        return Error{
            Code::Refused,
            fmt::format("\"{}\" is of a robot in a world; give the test a \"world\"", name.shown)};
    }
    return Status::done();
}

plan::Type type_of(const Name& name, const plan::GraphPlan& plan) {
    if (name.of == Name::Of::Signal) return name.signal->type;
    if (name.of == Name::Of::Word) return plan::Type::Int;
    return plan.variables[static_cast<size_t>(name.slot)].type;
}

// ---- texts that signals are compared with ----

bool is_one_of(std::string_view name, const std::vector<std::string>& names) {
    return std::ranges::find(names, name) != names.end();
}

// The signal has the actor's name alone, whatever plan it is in.
Status check_actor(const std::string& text, const plan::Graph& graph) {
    const std::vector<std::string> actors = actors_of(graph);
    if (is_one_of(text, actors)) return Status::done();
    const std::string last = text.substr(text.rfind('/') + 1);
    return Error{Code::NotFound, fmt::format("the plan has no actor \"{}\"; {}", text,
                                             known_instead(last, actors))};
}

Status check_event(const std::string& text, const plan::Graph& graph) {
    const std::vector<std::string> events = events_of(graph);
    if (is_one_of(text, events)) return Status::done();
    const std::string what =
        is_one_of(text, states_of(graph))
            ? fmt::format("\"{}\" is a state of an actor, not an event of a supervisor", text)
            : fmt::format("no supervisor of the plan raises \"{}\"", text);
    return Error{Code::NotFound, what + "; " + known_instead(text, events)};
}

}  // namespace

Result<Condition> Condition::parse(std::string_view text) {
    Rewriter rewriter(text);
    const std::string rewritten = TRY(rewriter.rewrite());
    // Its own sentence counts bytes in the text that it was given.
    Result<plan::Formula> formula = plan::parse_formula(rewritten);
    if (!formula.ok()) return formula.error();
    Condition made(std::string(text), std::move(formula.value()));
    for (const std::string& name : made.formula_.names()) {
        const auto own = rewriter.names().find(name);
        made.names_.push_back(
            own != rewriter.names().end() ? own->second : Name{.shown = name, .variable = name});
    }
    return made;
}

// '' is between two actors, or no event.
Status Condition::check_texts(const plan::Graph& graph) const {
    for (const auto& [name, text] : formula_.compared_texts()) {
        const Signal* const signal = names_[name].signal;
        if (signal == nullptr || text.empty()) continue;
        if (signal->id == SignalId::Actor) TRY(check_actor(text, graph));
        if (signal->id == SignalId::Event) TRY(check_event(text, graph));
    }
    return Status::done();
}

Status Condition::bind(const plan::Graph& graph, bool has_world) {
    const plan::GraphPlan& plan = graph.plans.front();
    std::vector<plan::Type> types;
    for (Name& name : names_) {
        if (name.of == Name::Of::Unknown) {
            name.signal = find_signal(name.variable);
            name.of = name.signal != nullptr ? Name::Of::Signal : Name::Of::Variable;
        }
        if (name.of == Name::Of::Signal) TRY(bind_signal(name, plan, has_world));
        if (name.of == Name::Of::Variable) TRY(bind_variable(name, plan));
        if (name.of == Name::Of::Word && !has_world) {
            return Error{Code::Refused, fmt::format("{} is of a robot in a world; give the test a "
                                                    "\"world\"",
                                                    name.shown)};
        }
        types.push_back(type_of(name, plan));
    }
    (void)TRY(formula_.type(types));
    return check_texts(graph);
}

bool Condition::uses(SignalId signal) const {
    return std::ranges::any_of(names_, [signal](const Name& name) {
        return name.signal != nullptr && name.signal->id == signal;
    });
}

Result<bool> Condition::holds(std::span<const plan::Value> values) const {
    const plan::Value value = TRY(formula_.evaluate(values));
    const plan::Value truth = TRY(plan::convert(value, plan::Type::Bool));
    return truth.boolean();
}

}  // namespace vagus::trial
