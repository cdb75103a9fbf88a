#include "toolbox/fleet/talk.hpp"

#include "base/json.hpp"

namespace vagus::toolbox {

Fleet& fleet_of(const Parts& parts) {
    if (parts.fleet != nullptr) return *parts.fleet;
    throw run::CodeError(
        "the robot is in no fleet: name one in its vagus.json, as \"fleet\": { \"name\": \"lab\" "
        "}, and run it in a world with `vagus sim`");
}

Talk::Talk(run::ActorContext& context, const Parts& parts)
    : context_(context), fleet_(fleet_of(parts)) {}

Time Talk::end_of(Duration at_most) const {
    const Time now = context_.now();
    return at_most >= run::kNever - now ? run::kNever : now + at_most;
}

std::optional<keeper::Reply> Talk::ask(keeper::Request request) {
    const uint64_t number = fleet_.ask(std::move(request));
    if (number == 0) throw run::CodeError("the robot asks the keeper too much at once");
    std::optional<keeper::Over> over;
    try {
        wait_until(
            [&] {
                over = fleet_.answer(number);
                return over.has_value();
            },
            run::kNever);
    } catch (const run::Stop&) {
        fleet_.cancel(number);
        throw;
    }
    return over->reply;
}

std::optional<keeper::Reply> Talk::ask_until(const keeper::Request& request, Duration at_most) {
    const Time end = end_of(at_most);
    while (true) {
        std::optional<keeper::Reply> reply = ask(request);
        const bool nothing = reply && reply->outcome == keeper::Outcome::Nothing;
        if (!nothing || context_.now() >= end) return reply;
        context_.sleep(std::min<Duration>(kAskKeeperAgain, end - context_.now()));
    }
}

std::string json_of_text(const std::string& text) {
    return json_quote(text);
}

std::string text_of_json(const std::string& json) {
    const auto read = read_json(json);
    const auto* const value = std::get_if<JsonValue>(&read);
    return value != nullptr && value->kind == JsonKind::String ? value->text : json;
}

}  // namespace vagus::toolbox
