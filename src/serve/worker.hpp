// Work that takes long, on a thread of its own, one piece after the other, so that the loop is
// never late. A piece of work shares nothing with the loop: it gets values, and gives back what the
// loop does with its result.
//
//     Worker worker([&] { links.wake(); });
//     worked<Result<Trace>>(worker.poster(), [text] { return read_trace(text); },  // there
//                           [&](Result<Trace> trace) { show(trace); });            // in tick()
//     worker.tick();
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "serve/thrown.hpp"

namespace vagus::serve {

class Worker {
public:
    using Then = std::function<void()>;
    using Work = std::function<Then()>;  // throws nothing
    // How work is handed over: to a worker, or done at once where that is soon enough.
    using Post = std::function<void(Work)>;
    static void at_once(const Work& work) { work()(); }

    // `wake` is called on the other thread when tick() has something to do.
    explicit Worker(std::function<void()> wake) : wake_(std::move(wake)) {}
    // Waits for the piece that is being worked on; the others, and what they give, are dropped.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    void post(Work work);
    Post poster() {
        return [this](Work work) { post(std::move(work)); };
    }
    // Does what came back, in the order in which it was posted.
    void tick();

private:
    void run(const std::stop_token& stop);

    std::function<void()> wake_;
    std::mutex mutex_;  // guards what follows
    std::condition_variable_any posted_;
    std::deque<Work> due_;
    std::vector<Then> back_;
    std::jthread thread_;  // begins with the first piece
};

// Does `act` there, and `then` with its outcome (a Status or a Result) here. What `act` throws is
// an Error of it.
template <typename Outcome>
void worked(const Worker::Post& post, std::function<Outcome()> act,
            std::function<void(Outcome)> then) {
    post([act = std::move(act), then = std::move(then)]() -> Worker::Then {
        std::optional<Outcome> outcome;
        if (const auto thrown = thrown_by([&] { outcome.emplace(act()); })) {
            outcome.emplace(Error{Code::Unavailable, *thrown});
        }
        return [then, outcome = std::move(*outcome)]() mutable { then(std::move(outcome)); };
    });
}

}  // namespace vagus::serve
