// What a run says when it is run again, compared with what is recorded of it: the first difference,
// with its instant and place.
//
//     CompareTape tape(reader);
//     Recorder recorder(tape, run);           // follows the run
//     TRY(tape.end());
//     if (const auto& found = tape.difference()) show(found->place);
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "mcap/reader.hpp"
#include "record/topics.hpp"

namespace vagus::record {

struct Difference {
    Time at{};
    std::string topic;
    std::string place;  // in the message: "set.motor.left.target"; empty: the message itself
    std::string then;   // as JSON; empty: there was none
    std::string now;
};

// A value of JSON on one line, without spaces, as in a recording.
std::string json_line(const JsonValue& value);

// Where two messages of JSON differ first, and both values there; for bytes, and for what is no
// JSON, nothing and both whole.
Difference first_difference(const std::string& then, const std::string& now);

class CompareTape final : public Tape {
public:
    // Borrowed. With `only`, no other topics are compared; /vagus/run never is. Nothing is that
    // comes later than `until`.
    explicit CompareTape(const mcap::Reader& reader, std::set<std::string> only = {},
                         Time until = Time::max());

    uint16_t declare(const Topic& topic) override;
    void put(uint16_t topic, Time at, std::string_view data) override;
    void put_later(uint16_t topic, Time at, size_t, Word word) override { put(topic, at, word()); }
    // All that was recorded must have come again, but for an input behind the instant `until`, and
    // what followed from it then. Nothing more is compared. The Error says that the recording was
    // damaged meanwhile (damage.hpp): what differs then says nothing of the run.
    Status end();
    // A difference that is found later may be of an earlier instant, until end().
    const std::optional<Difference>& difference() const { return difference_; }
    uint64_t compared() const { return compared_; }

private:
    struct Recorded {
        Time at{};
        std::string data;
    };
    bool counts(const std::string& name) const;
    std::optional<Recorded> take(uint16_t topic);
    void differs(Difference found);

    const mcap::Reader& reader_;
    mcap::Cursor cursor_;
    std::set<std::string> only_;
    Time until_;
    std::vector<Topic> topics_;                          // by number - 1
    std::map<std::string, std::deque<Recorded>> ahead_;  // read, but not yet compared
    std::optional<Difference> difference_;
    uint64_t compared_ = 0;
    bool over_ = false;
};

}  // namespace vagus::record
