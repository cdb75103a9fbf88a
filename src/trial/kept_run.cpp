#include "trial/kept_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "trial/test_file.hpp"
#include "trial/trial.hpp"

namespace vagus::trial {

namespace {

struct Tried {
    bool as_drafted = true;  // what the recording tells came about again
    bool untouched = true;
};

// Nothing: there can be no such run.
std::optional<Tried> tried(const Draft& draft, const KeptPlace& place) {
    const auto test = read_test(draft.text, place.test);
    if (!test.ok()) return std::nullopt;
    const auto outcome =
        run_trial(test.value(), test.value().seeds.first, {.record = place.scratch});
    if (!outcome.ok()) return std::nullopt;
    Tried result;
    for (size_t i = 0; i < outcome.value().verdicts.size(); ++i) {
        const bool touches = test.value().expect[i].kind == Expectation::Kind::Always;
        bool& part = touches ? result.untouched : result.as_drafted;
        part = part && outcome.value().verdicts[i].as_expected;
    }
    return result;
}

// Named as the recording that the person knows.
Result<Draft> draft_again(const std::string& file, const std::string& name,
                          const DraftOptions& options) {
    const MappedFile bytes = TRY(MappedFile::open(file));
    const mcap::Reader reader = TRY(mcap::Reader::open(bytes.bytes(), name));
    return draft_test(reader, options);
}

// With what a person set in the middle of the run as it was from its start. Nothing: even so
// something touches the robot.
std::optional<KeptRun> keep_as_set(const mcap::Reader& reader, const KeptPlace& place) {
    auto set = draft_test(reader, {.untouched = true, .set = true});
    if (!set.ok()) return std::nullopt;
    const auto came = tried(set.value(), place);
    if (!came || !came->untouched) return std::nullopt;
    if (came->as_drafted) return KeptRun{std::move(set.value())};
    auto again = draft_again(place.scratch, reader.name(), {.untouched = true});
    if (!again.ok()) return std::nullopt;
    return KeptRun{std::move(again.value()), true};
}

}  // namespace

Result<KeptRun> keep_run(const mcap::Reader& reader, const KeptPlace& place) {
    Draft untouched = TRY(draft_test(reader, {.untouched = true}));
    auto came = tried(untouched, place);
    // Scripts of now may not know an event that those of then sent.
    if (!came && untouched.plan.empty()) {
        came = tried(TRY(draft_test(reader, {.untouched = true, .events = false})), place);
        if (came) came->as_drafted = false;
    }
    if (came && came->as_drafted && came->untouched) return KeptRun{std::move(untouched)};
    std::optional<KeptRun> other;
    if (came && !came->as_drafted) {
        // An Error: it came to no actor, so there is nothing to expect of it.
        auto again = draft_again(place.scratch, reader.name(), {.untouched = came->untouched});
        if (again.ok()) other = KeptRun{std::move(again.value()), true};
    }
    if (untouched.was_set) {
        if (auto kept = keep_as_set(reader, place)) return std::move(*kept);
    }
    if (other) return std::move(*other);
    return KeptRun{TRY(draft_test(reader))};
}

}  // namespace vagus::trial
