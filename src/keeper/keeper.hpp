// The one place in a fleet that decides who has a task or a name, and which write of a shared value
// counts. A pure machine: it is told what the broker and the members say, with the time, and
// answers with what is to be published and replied, in this order.
//
//     Keeper keeper({.instance = "a1b2", .longest = 10s});
//     perform(keeper.take(keeper::Connected{}, now));
//     perform(keeper.take(keeper::Asked{{"r1", 1, 1}, keeper::Take{"pick", 5s}}, now));
//     perform(keeper.tick(now));
//
// Its state is what it has published as retained records: it can be killed and started again
// anywhere. There are never two valid leases of one thing, because
//  - a grant is a record, and is replied when the broker has acknowledged it;
//  - a member counts its lease from when it first sent the question, the keeper from when the
//    question arrived, which is later;
//  - a keeper acts only while a beat that it sent less than kListen ago has come back to it, and a
//    new keeper listens for kListen: of two, one knows of the other;
//  - a new keeper grants nothing for as long as the longest lease.
#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "keeper/records.hpp"

namespace vagus::keeper {

using namespace std::chrono_literals;

constexpr Duration kListen = 3s;
constexpr Duration kBeatEvery = 1s;
constexpr Duration kLeaseMin = 1s;
constexpr Duration kLeaseMax = 60s;
constexpr Duration kDoneKept = 60s;   // so long a finished task is still told
constexpr size_t kTasksMax = 10'000;  // of all queues, finished ones included
constexpr size_t kKeysMax = 1'000;    // shared values and names together
constexpr size_t kTextMax = 4'096;    // bytes of data, a result, a value
constexpr size_t kNameMax = 64;       // bytes of a queue, an id, a key, a name
constexpr size_t kRepliesKept = 64;   // for a robot that asks the same again
constexpr size_t kAskersMax = 2'000;  // lives of robots whose replies are kept
constexpr size_t kLivesMax = 4;       // of one robot among them

// ---- what it is told ----

// The broker is there, and everything below shared/ and task/ is subscribed to.
struct Connected {};
struct Lost {};
// What the broker has kept.
struct Retained {
    Record record;
};
// The last beat of a keeper, which the broker has kept as well.
struct LastBeat {
    uint64_t epoch = 0;
};
// A sign of life of any keeper, also of this one, as it comes. It is to be retained as well.
struct Beat {
    uint64_t epoch = 0;
    std::string instance;
    uint64_t number = 0;
    bool operator==(const Beat&) const = default;
};
// The broker has the record of that publication.
struct Acknowledged {
    uint64_t publication = 0;
};
struct Asked {
    Asker asker;
    Request request;
};
using Input = std::variant<Connected, Lost, Retained, LastBeat, Beat, Acknowledged, Asked>;

// ---- what it wants done ----

// To be retained; a record that is gone is an empty message on its topic.
struct Publish {
    uint64_t publication = 0;
    Record record;
    bool gone = false;
};
struct Answer {
    Asker asker;
    Reply reply;
};
// There is another keeper: this one does nothing any more.
struct Leave {
    std::string why;
};
using Action = std::variant<Beat, Publish, Answer, Leave>;
using Actions = std::vector<Action>;

struct Options {
    std::string instance;    // of this process: no other has it
    Duration longest = 10s;  // lease; at most kLeaseMax. Longer ones are cut to it
    // Its epoch is higher than those that it finds, and at least this: seconds of the calendar at
    // its start, for a broker that has lost what it kept.
    uint64_t first_epoch = 1;
};

class Keeper {
public:
    enum class State { Away, Listening, Resting, Serving, Out };

    explicit Keeper(Options options) : options_(std::move(options)) {}

    Actions take(const Input& input, Time now);
    Actions tick(Time now);

    State state() const { return state_; }
    uint64_t epoch() const { return epoch_; }
    // Questions that came while it could not know whether another keeper is there. They are asked
    // again.
    uint64_t ignored() const { return ignored_; }

private:
    // A queue and an id, or a key or name and nothing.
    using Topic = std::pair<std::string, std::string>;
    // Members that wait until the broker has a record.
    struct Waiting {
        Topic topic;
        std::vector<Answer> answers;
    };
    // A robot, and the epoch of one of its lives.
    using Life = std::pair<std::string, uint64_t>;
    // Replies to the last questions of one life; none yet: not acknowledged.
    struct Kept {
        uint64_t asked = 0;  // the older, the earlier forgotten
        std::map<uint64_t, std::optional<Reply>> replies = {};
    };
    struct OutLease {
        Time until{};
        Topic topic;
    };

    void on(const Connected& connected);
    void on(const Lost& lost);
    void on(const Retained& retained);
    void on(const LastBeat& last);
    void on(const Beat& beat);
    void on(const Acknowledged& acknowledged);
    void on(const Asked& asked);

    void obey(const Asker& asker, const Give& give);
    void obey(const Asker& asker, const Take& take);
    void obey(const Asker& asker, const ClaimName& claim);
    void obey(const Asker& asker, const Renew& renew);
    void obey(const Asker& asker, const Finish& finish);
    void obey(const Asker& asker, const Release& release);
    void obey(const Asker& asker, const Write& write);

    Actions take_actions();
    void listen_is_over();
    void publish_all();
    void send_beat();
    void leave(std::string why);
    bool is_confident() const;

    void keep(const Record& record);
    std::map<Topic, Record>& records_of(const Topic& topic);
    Record* find(const Topic& topic);
    void put_right(const Record& told);
    Record& lease_out(Record& record, const Asker& asker, Duration length);
    Record* leased(const Asker& asker, Term term);
    void end_lease(Term term, bool is_over);
    void end_leases();
    void finished(const Topic& topic);
    void forget_finished();
    Term next_term() { return {epoch_, ++terms_}; }

    void publish(const Record& record, bool gone, std::vector<Answer> answers);
    void publish_and_answer(const Record& record, const Asker& asker);
    void answer(const Asker& asker, Reply reply);
    void refuse(const Asker& asker, std::string why);
    bool is_repeated(const Asker& asker);
    Kept& kept_of(const Life& life);
    bool fits(const Asker& asker, size_t count, size_t most, const char* what);

    Options options_;
    State state_ = State::Away;
    Time now_{}, listens_until_{}, rests_until_{};
    uint64_t epoch_ = 0, seen_epoch_ = 0;
    uint64_t terms_ = 0, publications_ = 0, questions_ = 0, ignored_ = 0;
    Time beat_at_{}, confident_until_{};
    uint64_t beats_ = 0;
    std::map<uint64_t, Time> beats_out_;  // sent, and not come back
    std::map<Topic, Record> tasks_;
    std::map<Topic, Record> keys_;              // shared values and names
    std::set<std::pair<Term, Topic>> waiting_;  // tasks, in the order in which they were given
    std::map<Term, OutLease> leases_;
    std::deque<std::pair<Time, Topic>> finished_;
    std::vector<Record> strange_;  // found when the broker came back, and not known
    std::map<uint64_t, Waiting> unacknowledged_;
    std::map<Life, Kept> kept_;
    Actions actions_;
};

const char* name_of(Keeper::State state);

}  // namespace vagus::keeper
