#include "record/inputs.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "base/json.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"

namespace vagus::record {

namespace {

using ActKind = sim::Act::Kind;
using StopKind = run::Breakpoint::Kind;

// ---- words ----

constexpr std::pair<ActKind, std::string_view> kActs[] = {
    {ActKind::Press, "press"}, {ActKind::Release, "release"}, {ActKind::Tap, "tap"},
    {ActKind::Move, "move"},   {ActKind::Remove, "remove"},   {ActKind::MoveRobot, "move-robot"},
    {ActKind::Light, "light"}, {ActKind::Put, "put"}};
constexpr std::pair<StopKind, std::string_view> kStops[] = {{StopKind::Actor, "actor"},
                                                            {StopKind::State, "state"},
                                                            {StopKind::Event, "event"},
                                                            {StopKind::Condition, "condition"}};
using NodeChange = toolbox::BusNodes::Change;
constexpr std::pair<NodeChange, std::string_view> kNodeChanges[] = {
    {NodeChange::Appeared, "appeared"},
    {NodeChange::Left, "left"},
    {NodeChange::Stopped, "stopped"},
    {NodeChange::Runs, "runs"}};
constexpr sim::ObjectKind kObjects[] = {sim::ObjectKind::Wall,     sim::ObjectKind::Box,
                                        sim::ObjectKind::Cylinder, sim::ObjectKind::Patch,
                                        sim::ObjectKind::Light,    sim::ObjectKind::Infrared};

template <typename Value, size_t kCount>
std::string_view word_of(const std::pair<Value, std::string_view> (&list)[kCount], Value value) {
    for (const auto& [one, word] : list) {
        if (one == value) return word;
    }
    return "";
}

template <typename Value, size_t kCount>
std::optional<Value> value_of(const std::pair<Value, std::string_view> (&list)[kCount],
                              std::string_view word) {
    for (const auto& [one, known] : list) {
        if (known == word) return one;
    }
    return std::nullopt;
}

// ---- writing ----

// A message as it grows: {"t":1.5,"do":"tap","robot":1}.
class Message {
public:
    Message(const Input& input, std::string_view what)
        : text_(fmt::format(R"({{"t":{})", seconds_text(input.at))) {
        if (input.turn != 0) raw("turn", std::to_string(input.turn));
        text("do", what);
    }
    Message& raw(std::string_view key, std::string_view json) {
        text_ += fmt::format(R"(,"{}":{})", key, json);
        return *this;
    }
    Message& text(std::string_view key, std::string_view value) {
        return raw(key, json_quote(value));
    }
    // 17 digits bring a double back as it was.
    Message& number(std::string_view key, double value) {
        return raw(key, fmt::format("{:.17g}", value));
    }
    Message& whole(std::string_view key, uint64_t value) { return raw(key, std::to_string(value)); }
    Message& truth(std::string_view key, bool value) { return raw(key, value ? "true" : "false"); }
    Message& number_if(std::string_view key, const std::optional<uint64_t>& value) {
        return value ? whole(key, *value) : *this;
    }
    std::string done() const { return text_ + "}"; }

private:
    std::string text_;
};

// A float keeps its point, by which it is known.
std::string exact_json(const plan::Value& value) {
    switch (value.type()) {
        case plan::Type::Bool:
            return value.boolean() ? "true" : "false";
        case plan::Type::Int:
            return std::to_string(value.integer());
        case plan::Type::Float: {
            const std::string text = fmt::format("{:.17g}", value.number());
            return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
        }
        case plan::Type::String:
            return json_quote(value.string());
        case plan::Type::Object:
            break;
    }
    return "null";
}

std::string map_json(const std::map<std::string, std::string>& texts) {
    std::string json;
    for (const auto& [key, text] : texts) {
        json += (json.empty() ? "" : ",") + json_quote(key) + ":" + json_quote(text);
    }
    return "{" + json + "}";
}

std::string list_json(const std::vector<std::string>& texts) {
    std::string json;
    for (const std::string& text : texts) json += (json.empty() ? "" : ",") + json_quote(text);
    return "[" + json + "]";
}

std::string hex_of(const wire::Frame& frame) {
    std::array<uint8_t, wire::kFrameMax> bytes;
    const uint16_t size = wire::encode(frame, bytes.data());
    return vagus::hex_of({reinterpret_cast<const char*>(bytes.data()), size});
}

// Each alternative of Input::what as its message.
struct Format {
    const Input& input;

    std::string operator()(const sim::Act& act) const {
        Message message(input, word_of(kActs, act.kind));
        if (act.kind == ActKind::Put) return put(message, act.put);
        return message.whole("robot", act.robot.number)
            .whole("object", act.object.number)
            .text("button", act.button)
            .number("x", act.to.at.x)
            .number("y", act.to.at.y)
            .number("angle", act.to.angle)
            .truth("on", act.on)
            .done();
    }
    static std::string put(Message& message, const sim::ObjectDefinition& object) {
        return message.text("id", object.id)
            .text("kind", sim::name_of(object.kind))
            .number("x", object.at.x)
            .number("y", object.at.y)
            .number("angle", object.angle)
            .number("width", object.width)
            .number("length", object.length)
            .number("radius", object.radius)
            .number("height", object.height)
            .number("mass", object.mass)
            .number("r", object.colour.r)
            .number("g", object.colour.g)
            .number("b", object.colour.b)
            .done();
    }
    std::string operator()(const wire::Frame& frame) const {
        return Message(input, "frame").text("bytes", hex_of(frame)).done();
    }
    std::string operator()(const HeldMoment&) const { return Message(input, "hold").done(); }
    std::string operator()(const HeardAhead&) const { return Message(input, "look").done(); }
    std::string operator()(const run::Request& request) const {
        return std::visit([this](const auto& one) { return ask(one); }, request);
    }
    std::string operator()(const PlanFiles& files) const {
        return Message(input, "plan-files")
            .raw("saved", list_json(files.saved))
            .raw("texts", map_json(files.texts))
            .done();
    }
    std::string operator()(const ScriptLoaded& script) const {
        return Message(input, "script")
            .whole("node", script.node)
            .text("file", script.file)
            .text("text", script.text)
            .done();
    }
    std::string operator()(const ValueGiven& given) const {
        return Message(input, "set").text("value", given.text).done();
    }
    std::string operator()(const FileTookOver& other) const {
        return Message(input, "load").text("file", other.file).text("value", other.text).done();
    }
    std::string operator()(const Reseeded& drawn) const {
        return Message(input, "reseed").whole("seed", drawn.seed).done();
    }
    std::string operator()(const Heard& heard) const {
        Message message(input, "hear");
        if (heard.frame != 0) return message.whole("frame", heard.frame).done();
        return message.text("name", heard.name).whole("from", heard.from).done();
    }
    std::string operator()(const NodeChanged& node) const {
        return Message(input, "node")
            .text("name", node.name)
            .text("state", word_of(kNodeChanges, node.change))
            .done();
    }
    std::string operator()(const TokensMoved& moved) const {
        return Message(input, "tokens").whole("token", moved.token).done();
    }
    std::string operator()(const RunFailed& failed) const {
        return Message(input, "fail").text("why", failed.why).done();
    }
    std::string operator()(const Aborted& aborted) const {
        return Message(input, "abort").text("by", aborted.by).done();
    }
    std::string operator()(const RecordingEnds& end) const {
        Message message(input, "end");
        if (!end.why.empty()) message.text("why", end.why);
        return message.done();
    }

    // ---- what a debugger is asked ----
    template <typename Nothing>
    std::string ask(const Nothing&) const {
        return Message(input, "nothing").done();
    }
    std::string ask(const run::AddBreakpoint& asked) const {
        const run::Breakpoint& stop = asked.breakpoint;
        return Message(input, "stop-at")
            .text("kind", word_of(kStops, stop.kind))
            .text("plan", stop.plan)
            .text("element", stop.element)
            .text("outcome", stop.outcome)
            .text("condition", stop.condition)
            .whole("stop_at", stop.stop_at)
            .truth("enabled", stop.enabled)
            .done();
    }
    std::string ask(const run::RemoveBreakpoint& asked) const {
        return Message(input, "stop-no-more").raw("id", std::to_string(asked.id)).done();
    }
    std::string ask(const run::EnableBreakpoint& asked) const {
        return Message(input, "stop-enabled")
            .raw("id", std::to_string(asked.id))
            .truth("enabled", asked.enabled)
            .done();
    }
    std::string ask(const run::Pause& asked) const {
        Message message(input, "pause");
        if (asked.at) message.raw("at", seconds_text(*asked.at));
        return message.done();
    }
    std::string ask(const run::Continue& asked) const {
        return Message(input, "continue").truth("from_met", asked.from_met).done();
    }
    std::string ask(const run::Step&) const { return Message(input, "step").done(); }
    std::string ask(const run::Abort&) const { return Message(input, "end-plan").done(); }
    std::string ask(const run::SetVariable& asked) const {
        return Message(input, "set-variable")
            .raw("level", std::to_string(asked.level))
            .text("name", asked.name)
            .raw("value", exact_json(asked.value))
            .done();
    }
    std::string ask(const run::RaiseEvent& asked) const {
        std::string outputs;
        for (const auto& [name, value] : asked.outputs) {
            outputs += (outputs.empty() ? "" : ",") + json_quote(name) + ":" + exact_json(value);
        }
        return Message(input, "raise")
            .text("supervisor", asked.supervisor)
            .text("event", asked.event)
            .raw("outputs", "{" + outputs + "}")
            .done();
    }
    std::string ask(const run::LetGo& asked) const {
        return Message(input, "let-go").number_if("number", asked.number).done();
    }
    std::string ask(const run::DropHeld& asked) const {
        return Message(input, "drop-held").number_if("number", asked.number).done();
    }
    std::string ask(const run::StepEvent& asked) const {
        return Message(input, "step-event").number_if("number", asked.number).done();
    }
};

// ---- reading ----

// The members of a message; what is not there is 0, empty, false.
class Members {
public:
    explicit Members(const JsonValue& from) : from_(from) {}
    double number(std::string_view key) const {
        const JsonValue* const value = from_.find(key);
        return value != nullptr && value->is_number() ? value->number : 0;
    }
    template <typename Whole>
    Whole whole(std::string_view key) const {
        const JsonValue* const value = from_.find(key);
        const bool there = value != nullptr && value->kind == JsonKind::Int;
        return there ? static_cast<Whole>(value->integer) : Whole{};
    }
    std::optional<uint64_t> whole_if(std::string_view key) const {
        return from_.find(key) != nullptr ? std::optional(whole<uint64_t>(key)) : std::nullopt;
    }
    std::string text(std::string_view key) const {
        const JsonValue* const value = from_.find(key);
        return value != nullptr && value->kind == JsonKind::String ? value->text : "";
    }
    bool truth(std::string_view key) const {
        const JsonValue* const value = from_.find(key);
        return value != nullptr && value->boolean;
    }
    const JsonValue& object(std::string_view key) const {
        static const JsonValue kNothing;
        const JsonValue* const value = from_.find(key);
        return value != nullptr ? *value : kNothing;
    }

private:
    const JsonValue& from_;
};

plan::Value value_of(const JsonValue& json) {
    switch (json.kind) {
        case JsonKind::Bool:
            return plan::Value(json.boolean);
        case JsonKind::Int:
            return plan::Value(json.integer);
        case JsonKind::Float:
            return plan::Value(json.number);
        case JsonKind::String:
            return plan::Value(json.text);
        default:
            return plan::Value(plan::Object{});
    }
}

sim::ObjectDefinition object_of(const Members& from) {
    sim::ObjectDefinition object;
    object.id = from.text("id");
    for (const sim::ObjectKind kind : kObjects) {
        if (sim::name_of(kind) == from.text("kind")) object.kind = kind;
    }
    object.at = {from.number("x"), from.number("y")};
    object.angle = from.number("angle");
    object.width = from.number("width");
    object.length = from.number("length");
    object.radius = from.number("radius");
    object.height = from.number("height");
    object.mass = from.number("mass");
    object.colour = {from.number("r"), from.number("g"), from.number("b")};
    return object;
}

sim::Act act_of(ActKind kind, const Members& from) {
    sim::Act act{.kind = kind};
    if (kind == ActKind::Put) {
        act.put = object_of(from);
        return act;
    }
    act.robot.number = from.whole<uint32_t>("robot");
    act.object.number = from.whole<uint32_t>("object");
    act.button = from.text("button");
    act.to = {{from.number("x"), from.number("y")}, from.number("angle")};
    act.on = from.truth("on");
    return act;
}

std::optional<wire::Frame> frame_of(const std::string& hex) {
    std::string bytes;
    for (size_t i = 0; i + 2 <= hex.size(); i += 2) {
        const auto digit = [](char c) { return c >= 'a' ? c - 'a' + 10 : c - '0'; };
        if (hex.find_first_not_of("0123456789abcdef") != std::string::npos) return std::nullopt;
        bytes += static_cast<char>(digit(hex[i]) * 16 + digit(hex[i + 1]));
    }
    if (bytes.empty() || bytes.size() > wire::kFrameMax) return std::nullopt;
    wire::FrameReader reader;
    const auto size = static_cast<uint16_t>(bytes.size());
    const auto* const data = reinterpret_cast<const uint8_t*>(bytes.data());
    if (reader.feed(data, size) != size || !reader.complete()) return std::nullopt;
    return reader.frame();
}

PlanFiles plan_files_of(const Members& from) {
    PlanFiles files;
    for (const JsonValue& one : from.object("saved").items) files.saved.push_back(one.text);
    for (const JsonMember& one : from.object("texts").members) {
        files.texts[one.key] = one.value.text;
    }
    return files;
}

std::optional<run::Request> request_of(const std::string& what, const Members& from) {
    if (what == "stop-at") {
        const auto kind = value_of(kStops, from.text("kind"));
        if (!kind) return std::nullopt;
        return run::AddBreakpoint{{.kind = *kind,
                                   .plan = from.text("plan"),
                                   .element = from.text("element"),
                                   .outcome = from.text("outcome"),
                                   .condition = from.text("condition"),
                                   .stop_at = from.whole<uint64_t>("stop_at"),
                                   .enabled = from.truth("enabled")}};
    }
    if (what == "stop-no-more") return run::RemoveBreakpoint{from.whole<int>("id")};
    if (what == "stop-enabled") {
        return run::EnableBreakpoint{from.whole<int>("id"), from.truth("enabled")};
    }
    if (what == "pause") {
        const bool has_instant = from.object("at").is_number();
        return run::Pause{has_instant ? std::optional(from_seconds(from.number("at")))
                                      : std::nullopt};
    }
    if (what == "continue") return run::Continue{from.truth("from_met")};
    if (what == "step") return run::Step{};
    if (what == "end-plan") return run::Abort{};
    if (what == "set-variable") {
        return run::SetVariable{from.whole<int>("level"), from.text("name"),
                                value_of(from.object("value"))};
    }
    if (what == "raise") {
        run::RaiseEvent event{from.text("supervisor"), from.text("event"), {}};
        for (const JsonMember& one : from.object("outputs").members) {
            event.outputs.emplace_back(one.key, value_of(one.value));
        }
        return event;
    }
    if (what == "let-go") return run::LetGo{from.whole_if("number")};
    if (what == "drop-held") return run::DropHeld{from.whole_if("number")};
    if (what == "step-event") return run::StepEvent{from.whole_if("number")};
    return std::nullopt;
}

// False: it is none that this version knows.
bool read_what(const std::string& what, const Members& from, Input& input) {
    if (const auto kind = value_of(kActs, what)) {
        input.what = act_of(*kind, from);
    } else if (what == "frame") {
        const auto frame = frame_of(from.text("bytes"));
        if (!frame) return false;
        input.what = *frame;
    } else if (what == "hold") {
        input.what = HeldMoment{};
    } else if (what == "look") {
        input.what = HeardAhead{};
    } else if (what == "plan-files") {
        input.what = plan_files_of(from);
    } else if (what == "script") {
        input.what =
            ScriptLoaded{from.whole<uint16_t>("node"), from.text("file"), from.text("text")};
    } else if (what == "set") {
        input.what = ValueGiven{from.text("value")};
    } else if (what == "load") {
        input.what = FileTookOver{from.text("file"), from.text("value")};
    } else if (what == "reseed") {
        input.what = Reseeded{from.whole<uint64_t>("seed")};
    } else if (what == "hear") {
        input.what =
            Heard{from.whole<uint32_t>("frame"), from.text("name"), from.whole<uint16_t>("from")};
    } else if (what == "node") {
        const auto change = value_of(kNodeChanges, from.text("state"));
        if (!change) return false;
        input.what = NodeChanged{from.text("name"), *change};
    } else if (what == "tokens") {
        input.what = TokensMoved{from.whole<uint16_t>("token")};
    } else if (what == "fail") {
        input.what = RunFailed{from.text("why")};
    } else if (what == "abort") {
        input.what = Aborted{from.text("by")};
    } else if (what == "end") {
        input.what = RecordingEnds{from.text("why")};
    } else if (auto request = request_of(what, from)) {
        input.what = std::move(*request);
    } else {
        return false;
    }
    return true;
}

// Which requests change nothing.
struct DoesSomething {
    bool operator()(const run::ListBreakpoints&) const { return false; }
    bool operator()(const run::AskWhere&) const { return false; }
    bool operator()(const run::Evaluate&) const { return false; }
    bool operator()(const run::TakeVersion&) const { return false; }
    bool operator()(const run::ListHeld&) const { return false; }
    template <typename Other>
    bool operator()(const Other&) const {
        return true;
    }
};

}  // namespace

bool does_something(const run::Request& request) {
    return std::visit(DoesSomething{}, request);
}

std::string format_input(const Input& input) {
    return std::visit(Format{input}, input.what);
}

Result<Input> read_input(std::string_view text, Time at, const std::string& name) {
    const auto json = read_json(text);
    Input input{.at = at};
    if (const auto* const tree = std::get_if<JsonValue>(&json)) {
        const Members members(*tree);
        input.turn = members.whole<uint32_t>("turn");
        if (read_what(members.text("do"), members, input)) return input;
    }
    return Error{Code::BadInput, fmt::format("{}: the input at {} s cannot be done again: expected "
                                             "one that this version of Vagus knows, found {}",
                                             name, seconds_text(at), text)};
}

}  // namespace vagus::record
