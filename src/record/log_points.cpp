#include "record/log_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "debug/lines.hpp"

namespace vagus::record {

namespace {

constexpr std::string_view kForms =
    "NODE:LINE, as drive:42, or @ACTOR.enter, @ACTOR.leave or @SUPERVISOR.raise of the plan";
constexpr std::string_view kFormsOfRobot =
    ", of each robot that has it, or of one as r4/drive:42 or r4/@ACTOR.enter";

Error refuse(Code code, const LogWish& wish, std::string_view sentence) {
    return {code, fmt::format("--log {}: {}", wish.where, sentence)};
}

// At commas that are in no brackets and no quotes.
std::vector<std::string> parts_of(std::string_view text) {
    std::vector<std::string> parts;
    int depth = 0;
    char quote = 0;
    size_t first = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quote != 0) {
            if (c == quote) quote = 0;
        } else if (c == '"' || c == '\'') {
            quote = c;
        } else if (c == '(' || c == '[') {
            ++depth;
        } else if (c == ')' || c == ']') {
            --depth;
        } else if (c == ',' && depth <= 0) {
            parts.emplace_back(trimmed(text.substr(first, i - first)));
            first = i + 1;
        }
    }
    parts.emplace_back(trimmed(text.substr(first)));
    return parts;
}

Result<std::vector<std::string>> values_of(const LogWish& wish) {
    std::vector<std::string> values = parts_of(wish.values);
    if (std::find(values.begin(), values.end(), "") != values.end()) {
        return refuse(Code::BadInput, wish,
                      fmt::format("expected values with commas between them, as \"token, "
                                  "patience\"; found \"{}\"",
                                  wish.values));
    }
    if (values.size() <= kLogValuesMax) return values;
    return refuse(
        Code::Limit, wish,
        fmt::format("shows {} values; at most {} are possible", values.size(), kLogValuesMax));
}

// ---- values of nodes ----

std::string listed(std::span<const int16_t> words, size_t most) {
    std::string text = "[";
    for (size_t i = 0; i < words.size() && i < most; ++i) {
        text += fmt::format("{}{}", i > 0 ? ", " : "", words[i]);
    }
    if (words.size() > most) text += fmt::format(", … {} more", words.size() - most);
    return text + "]";
}

LoggedValue logged(const std::string& name, const Result<std::string>& value) {
    if (value.ok()) return {name, value.value(), value.value()};
    const std::string& why = value.error().what;
    return {name, "none (" + why + ")", fmt::format(R"({{"error":{}}})", json_quote(why))};
}

std::span<const int16_t> words_of(std::span<const int16_t> memory,
                                  const aesl::VariablePlace& place) {
    if (memory.size() < size_t{place.address} + place.size) return {};
    return memory.subspan(place.address, place.size);
}

Result<std::string> value_of(const debug::Condition& expression, std::span<const int16_t> memory) {
    std::vector<std::vector<int16_t>> values;
    for (const aesl::VariablePlace& place : expression.variables()) {
        const auto words = words_of(memory, place);
        values.emplace_back(words.begin(), words.end());
    }
    return std::to_string(TRY(expression.value(values)));
}

// Of a variable of a node.
bool is_name(std::string_view text) {
    const auto in_name = [](char c) {
        return c == '_' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
               (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
    };
    const bool digit = !text.empty() && text[0] >= '0' && text[0] <= '9';
    return !digit && std::all_of(text.begin(), text.end(), in_name);
}

// ---- elements of plans ----

std::string json_of(const plan::Value& value) {
    if (value.type() == plan::Type::Object) return "null";
    const std::string text = plan::text_of(value).value();
    return value.type() == plan::Type::String ? json_quote(text) : text;
}

std::vector<std::string> actors_of(const plan::GraphPlan& plan) {
    std::vector<std::string> names;
    for (const plan::GraphActor& actor : plan.actors) names.push_back(actor.name);
    return names;
}

std::vector<std::string> supervisors_of(const plan::GraphPlan& plan) {
    std::vector<std::string> names;
    for (const plan::GraphSupervisor& one : plan.globals) names.push_back(one.name);
    for (const plan::GraphActor& actor : plan.actors) {
        for (const plan::GraphSupervisor& one : actor.supervisors) names.push_back(one.name);
    }
    return names;
}

}  // namespace

// ---- setting them ----

LogPoints::LogPoints(std::vector<Bus> buses, Told told)
    : buses_(std::move(buses)), told_(std::move(told)) {
    for (size_t i = 0; i < buses_.size(); ++i) {
        const Bus& bus = buses_[i];
        variables_.emplace_back();
        if (bus.graph != nullptr) variables_.back().emplace(*bus.graph);
        if (bus.robot.empty()) continue;
        if (bus_of_robot_.size() <= bus.number) bus_of_robot_.resize(bus.number + 1u);
        bus_of_robot_[bus.number] = i;
    }
    if (world_session() == nullptr) return;
    // All others are on the common one.
    bus_of_robot_.resize(world_session()->world().definition().robots.size() + 1);
}

Result<std::unique_ptr<LogPoints>> LogPoints::set(const std::vector<LogWish>& wishes,
                                                  std::vector<Bus> buses, Told told) {
    if (wishes.size() > kLogPointsMax) {
        return Error{Code::Limit, fmt::format("there are {} log points; at most {} are possible",
                                              wishes.size(), kLogPointsMax)};
    }
    // make_unique cannot reach the constructor.
    std::unique_ptr<LogPoints> made(new LogPoints(std::move(buses), std::move(told)));
    for (size_t i = 0; i < wishes.size(); ++i) {
        made->wishes_.push_back(wishes[i].where);
        TRY(made->add(i, wishes[i]));
    }
    made->hits_.resize(wishes.size());
    if (made->settled()) TRY(made->check());
    made->watching_ = !made->of_nodes_.empty();
    if (made->watching_) made->world_session()->world().watch(made.get());
    return made;
}

LogPoints::~LogPoints() {
    if (watching_) world_session()->world().watch(nullptr);
}

Status LogPoints::add(size_t number, const LogWish& wish) {
    const bool of_robot = is_fleet() && wish.where.find("/@") != std::string::npos;
    if (wish.where.starts_with('@') || of_robot) return add_element(number, wish);
    const size_t colon = wish.where.rfind(':');
    auto values = TRY(values_of(wish));
    OfNode made{.number = number, .wish = wish, .node = {}, .line = 0, .values = std::move(values)};
    int line = 0;
    if (colon != std::string::npos) {
        const std::string digits = wish.where.substr(colon + 1);
        const bool is_number = !digits.empty() && digits.size() <= 7 &&
                               digits.find_first_not_of("0123456789") == std::string::npos;
        if (is_number) line = std::stoi(digits);
    }
    if (line == 0) {
        return refuse(Code::BadInput, wish,
                      fmt::format("expected {}{}; found \"{}\"", kForms,
                                  is_fleet() ? kFormsOfRobot : "", wish.where));
    }
    if (world_session() == nullptr) {
        return refuse(
            Code::NotFound, wish,
            "no node of this run can be run again, for it is of a plan alone or of a real bus");
    }
    made.node = wish.where.substr(0, colon);
    made.line = line;
    of_nodes_.push_back(std::move(made));
    return Status::done();
}

// In a fleet "r4/@takeTask.enter"; without a robot that of each whose plan has it.
Status LogPoints::add_element(size_t number, const LogWish& wish) {
    const size_t at = wish.where.starts_with('@') ? 0 : wish.where.find("/@") + 1;
    const std::string robot = wish.where.substr(0, at == 0 ? 0 : at - 1);
    const std::string_view place = std::string_view(wish.where).substr(at);
    TRY(check_robot(wish, robot));
    std::optional<Error> missing;
    bool found = false;
    for (size_t i = 0; i < buses_.size(); ++i) {
        const bool asked = robot.empty() || buses_[i].robot == robot;
        if (!asked || buses_[i].graph == nullptr) continue;
        auto made = element(wish, place, i);
        if (made.ok()) {
            found = true;
            made.value().number = number;
            of_elements_.push_back(std::make_unique<OfElement>(std::move(made.value())));
        } else if (!missing) {
            missing = made.error();
        }
    }
    if (found) return Status::done();
    if (missing) return *missing;
    if (!robot.empty()) return refuse(Code::NotFound, wish, robot + " has no plan");
    return refuse(Code::NotFound, wish,
                  is_fleet() ? "no robot of this run has a plan"
                             : "the run is of a world alone: it has no plan");
}

Status LogPoints::check_robot(const LogWish& wish, const std::string& robot) const {
    if (robot.empty() || world_session()->world().find_robot(robot)) return Status::done();
    return refuse(Code::NotFound, wish,
                  sim::no_robot(world_session()->world().definition(), robot, ""));
}

// `place`: "@takeTask.enter", "@Pick/takeTask.enter".
Result<LogPoints::OfElement> LogPoints::element(const LogWish& wish, std::string_view place,
                                                size_t bus) const {
    const size_t dot = place.rfind('.');
    const std::string_view word = dot == std::string_view::npos ? "" : place.substr(dot + 1);
    if (word != "enter" && word != "leave" && word != "raise") {
        return refuse(Code::BadInput, wish,
                      fmt::format("expected {}{}; found \"{}\"", kForms,
                                  is_fleet() ? kFormsOfRobot : "", wish.where));
    }
    OfElement made;
    made.wish = wish;
    made.bus = bus;
    const std::string& robot = buses_[bus].robot;
    made.where = robot.empty() ? wish.where : fmt::format("{}/{}", robot, place);
    made.when = word == "enter" ? When::Enter : word == "leave" ? When::Leave : When::Raise;
    made.element = place.substr(1, dot - 1);
    const size_t slash = made.element.rfind('/');
    const bool named = slash != std::string::npos;
    const std::string of_plan = named ? made.element.substr(0, slash) : "";
    if (named) made.element = made.element.substr(slash + 1);
    const plan::GraphPlan* const plan = TRY(plan_with(made, of_plan));
    made.plan = plan->file;
    for (const std::string& text : TRY(values_of(wish))) {
        made.values.emplace_back(text, TRY(formula(wish, text, *plan)));
    }
    return made;
}

Result<const plan::GraphPlan*> LogPoints::plan_with(const OfElement& point,
                                                    const std::string& of_plan) const {
    const std::string& name = point.element;
    const bool supervisor = point.when == When::Raise;
    const plan::GraphPlan* found = nullptr;
    bool plan_there = of_plan.empty();
    std::vector<std::string> known;
    std::vector<std::string> plans;
    for (const plan::GraphPlan& plan : buses_[point.bus].graph->plans) {
        plans.push_back(plan.name);
        if (!of_plan.empty() && plan.name != of_plan && plan.file != of_plan) continue;
        plan_there = true;
        const auto names = supervisor ? supervisors_of(plan) : actors_of(plan);
        known.insert(known.end(), names.begin(), names.end());
        if (std::find(names.begin(), names.end(), name) == names.end()) continue;
        if (found != nullptr) {
            return refuse(Code::BadInput, point.wish,
                          fmt::format("the plans {} and {} both have a {}; say which, as @{}/{}",
                                      found->name, plan.name, name, found->name,
                                      point.wish.where.substr(point.wish.where.find('@') + 1)));
        }
        found = &plan;
    }
    if (found != nullptr) return found;
    if (!plan_there) {
        return refuse(
            Code::NotFound, point.wish,
            fmt::format("there is no plan \"{}\"; {}", of_plan, known_instead(of_plan, plans)));
    }
    return refuse(Code::NotFound, point.wish,
                  fmt::format("the plan has no {} \"{}\"; {}", supervisor ? "supervisor" : "actor",
                              name, known_instead(name, known)));
}

Result<run::Expression> LogPoints::formula(const LogWish& wish, const std::string& text,
                                           const plan::GraphPlan& plan) {
    if (plan::is_variable_name(text) && plan::find_variable(plan, text) < 0) {
        std::vector<std::string> known;
        for (const plan::GraphVariable& one : plan.variables) known.push_back(one.name);
        return refuse(Code::NotFound, wish,
                      fmt::format("the plan {} has no variable \"{}\"; {}", plan.name, text,
                                  known_instead(text, known)));
    }
    auto expression = run::Expression::parse(text, plan);
    if (expression.ok()) return expression;
    return refuse(expression.error().code, wish,
                  fmt::format("\"{}\": {}", text, expression.error().what));
}

std::string LogPoints::label_of(const Bus& bus, const session::NodeState& node) const {
    const auto& robots = world_session()->world().definition().robots;
    return robots.size() == 1 && bus.robot.empty()
               ? node.name
               : robots[node.robot.number - 1].name + "/" + node.name;
}

bool LogPoints::settled() const {
    return std::all_of(buses_.begin(), buses_.end(), [](const Bus& bus) {
        return bus.session == nullptr || bus.session->settled();
    });
}

Status LogPoints::check() const {
    for (const OfNode& wish : of_nodes_) TRY(check(wish));
    return Status::done();
}

// A robot with another project may lack it, as long as one has it.
Status LogPoints::check(const OfNode& wish) const {
    std::optional<Error> missing;
    bool line_is_there = false;  // where that is missing
    std::vector<std::string> known;
    OfNode line = wish;
    line.values.clear();
    for (const Bus& bus : buses_) {
        const Result<bool> there = has_place(wish, bus, known);
        if (there.ok() && there.value()) return Status::done();
        if (there.ok() || line_is_there) continue;
        line_is_there = has_place(line, bus, known).ok();
        if (!missing || line_is_there) missing = there.error();
    }
    if (missing) return *missing;
    return refuse(
        Code::NotFound, wish.wish,
        fmt::format("there is no node \"{}\"; {}", wish.node, known_instead(wish.node, known)));
}

// The Error: a node of that name lacks it.
Result<bool> LogPoints::has_place(const OfNode& wish, const Bus& bus,
                                  std::vector<std::string>& known) const {
    bool found = false;
    for (const session::NodeState& node : bus.session->nodes()) {
        known.push_back(label_of(bus, node));
        if (node.name != wish.node && known.back() != wish.node) continue;
        found = true;
        const aesl::Program* const program = bus.session->program(node.id);
        if (program == nullptr) {
            return refuse(Code::NotFound, wish.wish, known.back() + " has no script");
        }
        (void)TRY(place(wish, bus, node, *program));
    }
    return found;
}

// ---- lines ----

Result<LogPoints::Point> LogPoints::place(const OfNode& wish, const Bus& bus,
                                          const session::NodeState& node,
                                          const aesl::Program& program) const {
    const auto first = bus.session->place_of(node.id, 1);
    const int before = first ? first->second - 1 : 0;
    const std::string file =
        first ? std::filesystem::path(first->first).filename().string() : node.name;
    if (!wish.wish.file.empty() && file != wish.wish.file) {
        return refuse(Code::NotFound, wish.wish,
                      fmt::format("in the recorded run {} had the script of {}, not of {}",
                                  label_of(bus, node), file, wish.wish.file));
    }
    const int line = wish.line - before;
    const int pc = debug::pc_of(program, line);
    if (pc < 0) {
        const bool of_script = !wish.wish.file.empty();
        const int told = of_script ? 0 : before;
        std::string near;
        for (const int one : {debug::previous_line_with_code(program, line),
                              debug::next_line_with_code(program, line)}) {
            if (one > 0) near += fmt::format("{}{}", near.empty() ? "" : " and ", one + told);
        }
        return refuse(Code::NotFound, wish.wish,
                      fmt::format("{} has no code at line {} of {}; the nearest with code: {}",
                                  label_of(bus, node), line + told, of_script ? "its script" : file,
                                  near.empty() ? "none" : near));
    }
    Point point{.wish = 0,
                .pc = static_cast<uint16_t>(pc),
                .where = fmt::format("{}:{}", label_of(bus, node), wish.line),
                .values = {}};
    for (const std::string& text : wish.values) {
        point.values.push_back(TRY(show(wish, bus, text, program)));
    }
    return point;
}

Result<LogPoints::Shown> LogPoints::show(const OfNode& wish, const Bus& bus,
                                         const std::string& text,
                                         const aesl::Program& program) const {
    Shown shown{.name = text, .list = {}, .expression = {}};
    std::vector<std::string> known;  // the script's own first
    for (auto one = program.variables.rbegin(); one != program.variables.rend(); ++one) {
        known.push_back(one->name);
        if (one->name != text || one->size == 1) continue;
        shown.list = *one;
        return shown;
    }
    const std::vector<aesl::Constant>& constants = bus.session->common().constants;
    for (const aesl::Constant& one : constants) known.push_back(one.name);
    if (is_name(text) && std::find(known.begin(), known.end(), text) == known.end()) {
        return refuse(Code::NotFound, wish.wish,
                      fmt::format("the script of {} has no variable \"{}\"; {}", wish.node, text,
                                  known_instead(text, known)));
    }
    auto expression = debug::Condition::parse(text, program.variables, constants);
    if (!expression.ok()) {
        return refuse(expression.error().code, wish.wish,
                      fmt::format("\"{}\": {}", text, expression.error().what));
    }
    shown.expression = std::move(expression.value());
    return shown;
}

void LogPoints::learn(Program& program, const sim::WitnessedNode& node,
                      const aesl::Program* now) const {
    program = {.known = now, .here = {}, .points = {}};
    if (now == nullptr) return;
    const Bus& bus = bus_of(node);
    for (const session::NodeState& one : bus.session->nodes()) {
        if (one.id != node.id || one.robot.number != node.robot) continue;
        for (size_t i = 0; i < of_nodes_.size(); ++i) {
            const OfNode& wish = of_nodes_[i];
            if (one.name != wish.node && label_of(bus, one) != wish.node) continue;
            auto point = place(wish, bus, one, *now);
            if (!point.ok()) continue;  // which check() says
            point.value().wish = i;
            if (program.here.size() <= point.value().pc) program.here.resize(point.value().pc + 1u);
            program.here[point.value().pc] = true;
            program.points.push_back(std::move(point.value()));
        }
    }
}

// A node runs nothing before the session knows which program it has.
void LogPoints::executes(const sim::WitnessedNode& node, uint16_t pc) {
    if (!told_) return;
    Program& program = programs_[(uint64_t{node.robot} << 16) | node.id];
    const aesl::Program* const now = bus_of(node).session->program(node.id);
    if (program.known != now) learn(program, node, now);
    if (pc >= program.here.size() || !program.here[pc]) return;
    for (const Point& point : program.points) {
        if (point.pc == pc) tell(point, node);
    }
}

void LogPoints::tell(const Point& point, const sim::WitnessedNode& node) {
    ++hits_[of_nodes_[point.wish].number];
    const session::SimSession& session = *world_session();
    const auto memory = session.world().variables(sim::RobotId{node.robot}, node.id);
    LogHit hit{.at = session.now(), .where = point.where, .values = {}};
    for (const Shown& shown : point.values) {
        if (shown.list) {
            const auto words = words_of(memory, *shown.list);
            hit.values.push_back(
                {shown.name, listed(words, kLogListShown), listed(words, words.size())});
        } else {
            hit.values.push_back(logged(shown.name, value_of(*shown.expression, memory)));
        }
    }
    told_(hit);
}

// ---- elements ----

void LogPoints::see(size_t bus, const plan::TraceEvent& event) {
    if (!told_ || bus >= variables_.size() || !variables_[bus]) return;
    const bool writes = std::holds_alternative<plan::VariableWritten>(event.what);
    tell_waiting([&](const Waiting& one) {
        return one.at != event.at || (one.point->bus == bus && !writes);
    });
    run::TracedVariables& variables = *variables_[bus];
    variables.see(event);
    const int level = run::level_of(event);
    const auto* const started = std::get_if<plan::ActorStarted>(&event.what);
    const auto* const ended = std::get_if<plan::ActorEnded>(&event.what);
    const auto* const broken = std::get_if<plan::ActorInterrupted>(&event.what);
    const auto* const raised = std::get_if<plan::EventRaised>(&event.what);
    for (const auto& point : of_elements_) {
        if (point->bus != bus) continue;
        const bool enters =
            point->when == When::Enter && started != nullptr && started->actor == point->element;
        const bool leaves =
            point->when == When::Leave && ((ended != nullptr && ended->actor == point->element) ||
                                           (broken != nullptr && broken->actor == point->element));
        const bool raises =
            point->when == When::Raise && raised != nullptr && raised->supervisor == point->element;
        if (!enters && !leaves && !raises) continue;
        if (variables.plan_at(level).file != point->plan) continue;
        if (enters) tell(*point, event.at, level);
        if (!enters) waiting_.push_back({point.get(), event.at, level});
    }
}

// What an element writes as it ends follows its line.
template <typename Is>
void LogPoints::tell_waiting(const Is& is) {
    if (waiting_.empty()) return;
    std::vector<Waiting> later;
    for (const Waiting& one : std::exchange(waiting_, {})) {
        if (is(one)) tell(*one.point, one.at, one.level);
        if (!is(one)) later.push_back(one);
    }
    waiting_ = std::move(later);
}

void LogPoints::tell_waiting() {
    tell_waiting([](const Waiting&) { return true; });
}

void LogPoints::tell(OfElement& point, Time at, int level) {
    ++hits_[point.number];
    LogHit hit{.at = at, .where = point.where, .values = {}};
    const run::TracedVariables& variables = *variables_[point.bus];
    const auto value_of = [&variables,
                           level](const run::Expression& formula) -> Result<std::string> {
        std::vector<plan::Value> values;
        for (const int slot : formula.slots()) values.push_back(variables.value(level, slot));
        return json_of(TRY(formula.evaluate(values)));
    };
    for (const auto& [name, formula] : point.values) {
        hit.values.push_back(logged(name, value_of(formula)));
    }
    told_(hit);
}

std::vector<std::string> LogPoints::not_reached() const {
    std::vector<std::string> places;
    for (size_t i = 0; i < wishes_.size(); ++i) {
        if (hits_[i] == 0) places.push_back(wishes_[i]);
    }
    return places;
}

void LogPoints::close() {
    tell_waiting();
    told_ = {};
}

// ---- as text ----

std::string format_hit(const LogHit& hit) {
    std::string text = fmt::format("{:>11.3f} s  {}  ", seconds_of(hit.at), hit.where);
    const char* between = "";
    for (const LoggedValue& value : hit.values) {
        text += fmt::format("{}{} = {}", between, value.name, value.text);
        between = ", ";
    }
    return text;
}

std::string format_hit_json(const LogHit& hit) {
    std::string values;
    for (const LoggedValue& value : hit.values) {
        values +=
            fmt::format("{}{}:{}", values.empty() ? "" : ",", json_quote(value.name), value.json);
    }
    return fmt::format(R"({{"t":{},"at":{},"values":{{{}}}}})", seconds_text(hit.at),
                       json_quote(hit.where), values);
}

}  // namespace vagus::record
