// A recorded run that can be looked at wherever one wants, back and forth: it is run again in
// copies of this process, some of which wait at instants on the way (keyframes). For another
// instant the nearest one before it is copied again, and the copy runs on from there.
//
//     const auto state = [](Rerun& run, Time at) { return run.check_at(at); };
//     const auto keyframes = TRY(Keyframes::open(reader, state));
//     const Keyframes::Look look = TRY(keyframes->look(from_seconds(82.5)));
//     show(look.text);
//
// It is the same as running again from the beginning up to there (look_straight()), and takes less.
// Where no process can be copied it is done so, and why_none() says why. One copy runs at a time;
// the caller waits. All of them end with this process, however that ends.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/process_copy.hpp"
#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "record/keyframe_instants.hpp"
#include "record/replay.hpp"

namespace vagus::record {

// Why the process of such a run is not copied; empty: it can be. The library of a plan's templates
// may have threads at any time.
std::string why_not_copied(const RunFile& about);

class Keyframes {
public:
    // What one wants to know of an instant: called in the copy that is there, at the end of the
    // instant, or after the run. It changes nothing in the run.
    using Tell = std::function<std::string(Rerun& run, Time at)>;
    struct Look {
        Time at{};  // the first end of an instant that is not earlier than what was asked for
        std::string text;
        std::optional<Time> from = {};  // the keyframe from which it was run; empty: the beginning
    };

    // The reader is borrowed. The Error says why the recording cannot be run again so: it needs a
    // world, which has instants.
    static Result<std::unique_ptr<Keyframes>> open(const mcap::Reader& reader, Tell tell);
    ~Keyframes() { settle(); }
    Keyframes(const Keyframes&) = delete;
    Keyframes& operator=(const Keyframes&) = delete;

    // The Error says that the recording does not go so far, or how the run failed.
    Result<Look> look(Time at);
    // The same in this process, from the beginning.
    Result<Look> look_straight(Time at);

    // There are no keyframes, and why; empty: there are.
    const std::string& why_none() const { return why_none_; }
    // Where copies wait now, and their processes.
    std::vector<std::pair<Time, int64_t>> waiting();

private:
    // A copy that waits at an instant.
    struct Copy {
        CopyLink link;
        CopyProcess process;
        bool is_over = false;  // the run ended there
    };
    using Place = std::map<Time, Copy>::iterator;

    Keyframes(const mcap::Reader& reader, Tell tell, std::unique_ptr<Rerun> rerun)
        : reader_(reader), tell_(std::move(tell)), rerun_(std::move(rerun)) {}
    Status check_is_in(Time at) const;
    // The end: none, the run begins at its beginning.
    Place nearest(Time at);
    std::vector<Time> wanted_between(Time from, Time to) const;
    // These give nothing where a copy was lost on the way, or there are to be none.
    Result<std::optional<Look>> look_from(Place from, Time at);
    static std::optional<Look> ask(Place place);
    Result<std::optional<Look>> go_on(Place from, Time stop);
    Result<std::optional<Look>> follow(CopyLink link, CopyMessage began);
    void keep(Time at, Copy copy);
    void settle();
    void thin(Time here);

    const mcap::Reader& reader_;
    Tell tell_;
    std::unique_ptr<Rerun> rerun_;  // prepared, and never run in this process
    Supervision supervision_;
    std::map<Time, Copy> copies_;
    std::vector<CopyLink> arriving_;   // of copies that were left on the way, and may not wait yet
    std::vector<CopyProcess> ending_;  // that were not wanted any more
    Time newest_{};                    // that was looked at
    std::string why_none_;
};

}  // namespace vagus::record
