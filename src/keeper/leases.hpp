// A member's side of the keeper: questions that are asked until they are answered, and leases that
// end by the member's own clock. A pure machine, like the keeper.
//
//     Leases leases;
//     const uint64_t number = leases.ask(keeper::Take{"pick", 10s}, now);
//     for (const keeper::Ask& ask : leases.tick(now)) send(ask);
//     leases.hear(number, reply, now);
//     for (const keeper::Over& over : leases.take_over()) tell(over);  // each question once
//     for (const keeper::Term& term : leases.take_ended(now)) drop(term);
//
// A lease counts from when its question was *first* sent: an answer that comes late makes it
// shorter, never longer. It is renewed at each third of its length. Whoever has no lease any more
// drops what it was for at once.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "keeper/records.hpp"

namespace vagus::keeper {

using namespace std::chrono_literals;

constexpr Duration kAskAgain = 1s;    // until it is answered
constexpr Duration kAskAtMost = 30s;  // then the question has failed
constexpr size_t kQuestionsMax = 64;  // at once; as many as a keeper remembers replies

struct Ask {
    uint64_t number = 0;
    Request request;
};

// How a question has ended. Without a reply nobody has answered in time.
struct Over {
    uint64_t number = 0;
    std::optional<Reply> reply;
};

class Leases {
public:
    // The number of the question; 0: there are kQuestionsMax already.
    uint64_t ask(Request request, Time now);
    // Nobody waits for it any more; a lease that it would have given is released.
    void cancel(uint64_t number);

    // What is to be sent now: new questions, unanswered ones again, renewals.
    std::vector<Ask> tick(Time now);
    // A reply came. The end of a question is told by take_over(); a reply that comes twice, or from
    // a keeper that was superseded, tells nothing.
    void hear(uint64_t number, const Reply& reply, Time now);
    // A beat of that keeper was heard. One of a lower epoch than that of an earlier keeper counts
    // when nothing was heard of that one for longer than it can have given a lease: a broker that
    // has lost what it kept, and a clock of the calendar that is wrong, make such a keeper.
    void heard_of(uint64_t keeper_epoch, Time now);

    std::vector<Over> take_over();
    // Leases that have ended since the last call, each once, and not by finish or release.
    std::vector<Term> take_ended(Time now);
    bool holds(Term term, Time now) const;
    // When to call tick(), take_over() and take_ended() again; Time::max(): there is no need to.
    Time next() const;

private:
    struct Question {
        Request request;
        Time first{};
        Time again{};
        bool is_own = false;  // a renewal, or a release of what nobody waits for
        bool is_cancelled = false;
    };
    struct Held {
        Time until{};
        Time renew{};
        Duration length{};
        uint64_t renewal = 0;  // the question under way
    };

    uint64_t add(Request request, Time now, bool is_own);

    uint64_t questions_asked_ = 0;
    uint64_t keeper_epoch_ = 0;
    Time keeper_heard_{};
    std::map<uint64_t, Question> questions_;
    std::map<Term, Held> held_;
    std::vector<Over> over_;
};

}  // namespace vagus::keeper
