// What a keeper keeps, what members ask of it, what it replies: values, without topics and JSON.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/time.hpp"

namespace vagus::keeper {

// Numbers one decision of one keeper. A keeper that starts later has a higher epoch, so its terms
// are later than all before.
struct Term {
    uint64_t epoch = 0;
    uint64_t number = 0;
    auto operator<=>(const Term&) const = default;
};
// "12.3" of epoch 12 and number 3.
std::string text_of(Term term);
std::optional<Term> read_term(std::string_view text);

// Whose something is for a while. Without a robot it is nobody's; the term then is the last one.
struct Lease {
    std::string robot;
    Term term;
    Duration length{};
    bool operator==(const Lease&) const = default;
};

enum class Work { Waiting, Leased, Done };

// A task of a queue. Its giver chooses the id, so that giving it twice gives it once.
struct Task {
    std::string queue;
    std::string id;
    Term given;        // tasks are handed out in this order
    std::string data;  // JSON of the giver
    Work work = Work::Waiting;
    Lease lease;
    std::string result;  // JSON of who has finished it
    bool operator==(const Task&) const = default;
};

// A value that two cannot overwrite: each write names the version it has seen.
struct Shared {
    std::string key;
    Term version;
    std::string value;  // JSON
    bool operator==(const Shared&) const = default;
};

// A name that one robot has at a time: an aisle, a charger.
struct Claim {
    std::string name;
    Lease lease;
    bool operator==(const Claim&) const = default;
};

using Record = std::variant<Task, Shared, Claim>;

// ---- what members ask ----
struct Give {
    std::string queue;
    std::string id;
    std::string data;
    bool operator==(const Give&) const = default;
};
struct Take {
    std::string queue;
    Duration length{};  // of the lease
    bool operator==(const Take&) const = default;
};
struct ClaimName {
    std::string name;
    Duration length{};
    bool operator==(const ClaimName&) const = default;
};
// The lease of that term: for another length from now on, over with a result, or given back. A task
// that is released waits again.
struct Renew {
    Term term;
    bool operator==(const Renew&) const = default;
};
struct Finish {
    Term term;
    std::string result;
    bool operator==(const Finish&) const = default;
};
struct Release {
    Term term;
    bool operator==(const Release&) const = default;
};
struct Write {
    std::string key;
    Term seen;  // none: the key is new
    std::string value;
    bool operator==(const Write&) const = default;
};
using Request = std::variant<Give, Take, ClaimName, Renew, Finish, Release, Write>;

// The asker: a name, the epoch of its life (another one each time, in no order), and the number of
// the question in it.
struct Asker {
    std::string robot;
    uint64_t epoch = 0;
    uint64_t number = 0;
    bool operator==(const Asker&) const = default;
};

enum class Outcome {
    Done,
    Nothing,  // no task waits; or somebody else has the name; or the version is another
    Refused   // the term is over, or a limit would be passed
};

struct Reply {
    Outcome outcome = Outcome::Done;
    std::string why = {};               // of Nothing and Refused
    uint64_t epoch = 0;                 // of the keeper
    std::optional<Record> record = {};  // that it is about, as it is now
    bool operator==(const Reply&) const = default;
};

}  // namespace vagus::keeper
