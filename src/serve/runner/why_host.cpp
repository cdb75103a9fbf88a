#include "serve/runner/why_host.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "record/why.hpp"
#include "serve/json.hpp"
#include "serve/runner/one_answer.hpp"

namespace vagus::serve {

namespace {

Result<std::string> chain_of(const Json& asked) {
    auto question = TRY(record::read_question(asked["question"].get<std::vector<std::string>>()));
    // Wheels are asked about by the name of their robot.
    if (question.about != record::Question::About::Motor) question.robot = asked.value("robot", "");
    const std::string path = asked["file"];
    const MappedFile file = TRY(MappedFile::open(path));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
    std::optional<Time> at;
    if (asked.contains("at")) at = from_seconds(asked["at"]);
    return record::format_chain_json(TRY(record::why(reader, question, at)));
}

std::string answer_to(const std::string& text) {
    const Json asked = Json::parse(text, nullptr, false);
    const bool good = asked.is_object() && asked.contains("question") && asked.contains("file");
    if (!good) return "";
    const auto chain = chain_of(asked);
    if (chain.ok()) return "{\"chain\":" + chain.value() + "}";
    return json_text({{"error", chain.error().what}});
}

}  // namespace

int run_why(Pipe pipe) {
    return answer_one(std::move(pipe), {kWhyAsked, kWhyAnswered}, answer_to);
}

}  // namespace vagus::serve
