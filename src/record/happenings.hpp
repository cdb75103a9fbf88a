// What happened in the world of a run that is run again, and was done by no script and no plan:
// contacts, the timeline, people, faults. Collected during the rerun: chains of `vagus why` end
// here.
//
//     Happenings happenings(*rerun);                // before rerun->run()
//     …
//     const Happening* one = happenings.find(happenings.last(robot, Happening::Kind::Contact, ""));
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "record/replay.hpp"

namespace vagus::record {

struct Happening {
    enum class Kind : uint8_t { Contact, Timeline, Person, Chaos, Alone };
    Time at{};
    Kind kind = Kind::Contact;
    uint32_t robot = 0;   // concerned; 0: none
    std::string what;     // the sentence
    std::string with;     // id of the object, or the button
    size_t entry = 0;     // of the timeline; of the faults of the world
    uint32_t before = 0;  // the happening that it followed from
};

// They have numbers from 1 on; 0 is none.
class Happenings {
public:
    // Borrowed; before its run(). Of a run without a world there are none.
    explicit Happenings(Rerun& rerun);
    ~Happenings();
    Happenings(const Happenings&) = delete;
    Happenings& operator=(const Happenings&) = delete;

    const std::vector<Happening>& all() const { return all_; }
    // nullptr for 0.
    const Happening* find(uint32_t number) const {
        return number == 0 || number > all_.size() ? nullptr : &all_[number - 1];
    }
    // The last of that kind, of a robot (0: of any), with that object or button (empty: any).
    uint32_t last(uint32_t robot, Happening::Kind kind, std::string_view with) const;
    // A robot of a fleet stops by itself, for that is gone.
    void stops_alone(uint32_t robot, const std::string& why);

private:
    Time now() const;
    void look(Time at);
    void look_at_contact(uint32_t robot, const std::string& with, Time at);
    uint32_t cut_of(uint32_t robot) const;
    void entry_of_timeline(size_t entry);

    Rerun& rerun_;
    std::vector<Happening> all_;
};

}  // namespace vagus::record
