#include "serve/runner/log_host.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "embed/loaded_plan.hpp"
#include "record/log_run.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"
#include "serve/project/paths.hpp"
#include "serve/runner/one_answer.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kLogTextMax = 1000;  // bytes of a value, and of the line of a script

// The part of the plan of the recording with that path, by which one of several plans is named.
Result<std::string> file_of_plan(record::Rerun& rerun, const std::string& path) {
    if (rerun.plan() == nullptr) {
        return Error{Code::NotFound, "the recorded run is of a world alone: it has no plan"};
    }
    for (const plan::GraphPlan& plan : rerun.plan()->graph().plans) {
        const std::string name = rerun.name_of(plan.file);
        if (is_end_of(name, path) || is_end_of(path, name)) return plan.file;
    }
    return Error{Code::NotFound, fmt::format("the recorded run has no plan {}", path)};
}

// Names are as the recording has them.
Result<record::LogWish> wish_of(record::Rerun& rerun, const Json& asked) {
    const std::string values = asked["values"];
    if (asked.contains("node")) {
        const std::string node = asked["node"];
        const int line = asked["line"];
        return record::LogWish{fmt::format("{}:{}", node, line), values, asked["script"]};
    }
    const std::string file = TRY(file_of_plan(rerun, asked["plan"]));
    const std::string element = asked["element"];
    const std::string when = asked["when"];
    return record::LogWish{fmt::format("@{}/{}.{}", file, element, when), values};
}

// The line of the script as the recording has it, so that a page sees whether it is another by now.
std::string line_in(record::Rerun& rerun, const Json& asked) {
    if (!asked.contains("node") || rerun.session() == nullptr) return "";
    const std::string name = asked["node"];
    for (const session::NodeState& node : rerun.session()->nodes()) {
        if (node.name != name) continue;
        const auto first = rerun.session()->place_of(node.id, 1);
        const auto text = first ? read_file(first->first) : Error{Code::NotFound, ""};
        if (!text.ok()) return "";
        return line_of(line_at(text.value(), asked["line"].get<size_t>()), kLogTextMax);
    }
    return "";
}

// Behind the name of the place, which the person has before the eyes.
std::string sentence_of(const std::string& error, const std::string& where) {
    const std::string prefix = "--log " + where + ": ";
    return error.starts_with(prefix) ? error.substr(prefix.size()) : error;
}

class Hits {
public:
    void add(const record::LogHit& hit) {
        if (names_.empty()) {
            for (const record::LoggedValue& one : hit.values) names_.push_back(one.name);
        }
        if (hits_.size() >= kLogHitsMax) {
            ++more_;
            return;
        }
        Json values = Json::array();
        for (const record::LoggedValue& one : hit.values) {
            values.push_back(line_of(one.text, kLogTextMax));
        }
        hits_.push_back({{"t", seconds_of(hit.at)},
                         {"where", hit.where.starts_with('@') ? "" : hit.where},
                         {"values", std::move(values)}});
    }
    Json take() {
        return {{"names", std::move(names_)}, {"hits", std::move(hits_)}, {"more", more_}};
    }

private:
    Json names_ = Json::array();
    Json hits_ = Json::array();
    uint64_t more_ = 0;
};

Result<Json> hits_of(const Json& asked, std::string& where) {
    const std::string path = asked["file"];
    const MappedFile file = TRY(MappedFile::open(path));
    const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
    Hits hits;
    std::string line;
    const record::LogRun wanted = {.wishes = [&](record::Rerun& rerun) -> record::Wishes {
                                       record::LogWish wish = TRY(wish_of(rerun, asked));
                                       where = wish.where;
                                       return std::vector{std::move(wish)};
                                   },
                                   .told = [&](const record::LogHit& hit) { hits.add(hit); },
                                   .settled =
                                       [&](record::Rerun& rerun) {
                                           line = line_in(rerun, asked);
                                           return Status::done();
                                       }};
    const Time until = TRY(record::log_run(reader, wanted));
    Json answer = hits.take();
    answer["until"] = seconds_of(until);
    answer["text"] = line;
    return answer;
}

}  // namespace

std::string answer_log(const std::string& question) {
    const Json asked = Json::parse(question, nullptr, false);
    const bool good = asked.is_object() && asked.contains("file") && asked.contains("values") &&
                      (asked.contains("node") || asked.contains("plan"));
    if (!good) return "";
    std::string where;
    const auto hits = hits_of(asked, where);
    const Json answer =
        hits.ok() ? hits.value() : Json{{"error", sentence_of(hits.error().what, where)}};
    return json_text(answer);
}

int run_log(Pipe pipe) {
    return answer_one(std::move(pipe), {kLogAsked, kLogAnswered}, answer_log);
}

}  // namespace vagus::serve
