#include "serve/workbench/run_questions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace vagus::serve {

void RunQuestions::ask(const Call& call, Json question, Questions::Then then) {
    if (questions_.count() + flushing_.size() >= at_once_) {
        return call.fail("limit",
                         fmt::format("{} questions are being answered; wait for them", at_once_));
    }
    const bool is_kept = call.in.contains("trace");
    const auto file = is_kept ? run_.kept(call.in["trace"]) : run_.file();
    if (!file.ok()) return call.fail(file.error());
    question["file"] = file.value();
    if (is_kept) return questions_.ask(call, std::move(question), std::move(then));
    const uint64_t number = ++numbers_;
    flushing_.push_back({number, call});
    run_.flush([this, number, question = std::move(question), then = std::move(then)] {
        const auto one = std::find_if(flushing_.begin(), flushing_.end(),
                                      [&](const Flushing& is) { return is.number == number; });
        if (one == flushing_.end()) return;  // cancelled meanwhile
        const Call waiting = std::move(one->call);
        flushing_.erase(one);
        questions_.ask(waiting, question, then);
    });
}

void RunQuestions::cancel(const std::function<bool(const Call& call)>& is_meant) {
    std::erase_if(flushing_, [&](const Flushing& one) {
        if (!is_meant(one.call)) return false;
        fail_cancelled(one.call);
        return true;
    });
    questions_.cancel(is_meant);
}

}  // namespace vagus::serve
