#include "record/keyframes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/seconds.hpp"
#include "record/causes.hpp"
#include "toolbox/load.hpp"

namespace vagus::record {

namespace {

// A copy that ends on the way there does so each time, or was ended from outside.
constexpr int kAttemptsMax = 3;

// What copies and their supervisor say to each other. Numbers are instants, but of Began.
enum class Word : uint32_t {
    GoOn = 1,   // to a copy that waits: another one, with the link that is handed, goes on to there
    Tell,       // what there is
    NotCopied,  // answers to GoOn: the text says why
    Copied,
    Told,    // to Tell
    Began,   // from a copy: its number and its handle
    IsAt,    // it waits there
    IsOver,  // the run has ended there
    Failed,  // the run has failed: the text says how
};

CopyMessage message(Word word, Time at = {}, std::string text = {}) {
    return {.word = static_cast<uint32_t>(word), .number = at.count(), .text = std::move(text)};
}

bool says(const std::optional<CopyMessage>& message, Word word) {
    return message && message->word == static_cast<uint32_t>(word);
}

std::string why_threads(size_t threads) {
    return fmt::format("the process of the run has {} threads, and only one of them would be in a "
                       "copy of it",
                       threads);
}

// The life of a copy: it runs on to its stop, and waits there for what is wanted of it.
class RunningCopy {
public:
    // The first two are borrowed.
    RunningCopy(Rerun& rerun, const Keyframes::Tell& tell, CopyLink link, Time stop)
        : rerun_(rerun), tell_(tell), link_(std::move(link)), stop_(stop) {}

    [[noreturn]] void run() {
        begin();
        rerun_.each_instant([this](Time at) {
            if (at >= stop_) wait_at(at, Word::IsAt);
        });
        NullTape tape;
        const auto ended = rerun_.run(tape);
        if (ended.ok()) wait_at(ended.value().at, Word::IsOver);
        (void)link_.send(message(Word::Failed, {}, ended.ok() ? "" : ended.error().what));
        end_copy();
    }

private:
    void begin() const {
        (void)link_.send({.word = static_cast<uint32_t>(Word::Began),
                          .number = own_number(),
                          .text = {},
                          .handed = own_handle()});
    }

    // Returns in a copy of this one.
    void wait_at(Time at, Word there) {
        bool is_heard = link_.send(message(there, at));
        while (is_heard) {
            std::optional<CopyMessage> asked = link_.receive();
            if (says(asked, Word::GoOn)) {
                if (is_copied(asked->handed)) {
                    link_ = CopyLink(std::move(asked->handed));
                    stop_ = Time(asked->number);
                    return begin();
                }
            } else if (says(asked, Word::Tell)) {
                is_heard = link_.send(message(Word::Told, at, tell_(rerun_, at)));
            } else {
                break;
            }
        }
        end_copy();
    }

    // True: this is the copy.
    bool is_copied(const Descriptor& link) {
        const size_t threads = threads_of_process();
        const int64_t copy = threads == 1 ? copy_again(link) : -1;
        if (copy == 0) {
            link_ = CopyLink(Descriptor());  // of the other process
            return true;
        }
        const std::string why = threads == 1 ? system_sentence() : why_threads(threads);
        (void)link_.send(copy > 0 ? message(Word::Copied) : message(Word::NotCopied, {}, why));
        return false;
    }

    Rerun& rerun_;
    const Keyframes::Tell& tell_;
    CopyLink link_;
    Time stop_;
};

}  // namespace

std::string why_not_copied(const RunFile& about) {
    for (const std::string& one : about.toolboxes) {
        if (!one.ends_with(toolbox::kLibraryEnding)) continue;
        return fmt::format("templates of the plan are in the shared library {}, which may have "
                           "threads of its own",
                           one);
    }
    return {};
}

Result<std::unique_ptr<Keyframes>> Keyframes::open(const mcap::Reader& reader, Tell tell) {
    auto rerun = TRY(Rerun::open(reader, {}));
    if (rerun->session() == nullptr) {
        return Error{Code::Refused,
                     reader.name() +
                         ": is of a plan without a world, which has no instants to go to; record "
                         "one that runs beside a world, with `vagus plan run --world`"};
    }
    std::string why_none = why_not_copied(rerun->about());
    // make_unique cannot reach the constructor.
    std::unique_ptr<Keyframes> made(new Keyframes(reader, std::move(tell), std::move(rerun)));
    made->why_none_ = std::move(why_none);
    return made;
}

Status Keyframes::check_is_in(Time at) const {
    const Time end = rerun_->recorded_until();
    if (at >= Time{} && at <= end) return Status::done();
    return Error{Code::BadInput, fmt::format("{} s: {} has instants from 0 to {} s",
                                             seconds_text(at), reader_.name(), seconds_text(end))};
}

// ---- looking ----

Result<Keyframes::Look> Keyframes::look(Time at) {
    TRY(check_is_in(at));
    newest_ = std::max(newest_, at);
    for (int i = 0; i < kAttemptsMax && why_none_.empty(); ++i) {
        const auto found = TRY(look_from(nearest(at), at));
        if (!found) continue;
        thin(found->at);
        return *found;
    }
    if (!why_none_.empty()) return look_straight(at);
    return Error{Code::Unavailable,
                 fmt::format("{} s: {} copies of the process of the run, one after the other, "
                             "ended before they were there",
                             seconds_text(at), kAttemptsMax)};
}

Result<Keyframes::Look> Keyframes::look_straight(Time at) {
    TRY(check_is_in(at));
    const auto rerun = TRY(Rerun::open(reader_, {}));
    std::optional<Look> look;
    rerun->each_instant([&](Time now) {
        if (now < at || look) return;
        look = Look{.at = now, .text = tell_(*rerun, now)};
        rerun->stop();
    });
    NullTape tape;
    const auto ended = TRY(rerun->run(tape));
    if (!look) look = Look{.at = ended.at, .text = tell_(*rerun, ended.at)};
    return *look;
}

Result<std::optional<Keyframes::Look>> Keyframes::look_from(Place from, Time at) {
    const auto begins_at = from == copies_.end() ? std::nullopt : std::optional(from->first);
    for (const Time stop : stops(from, at)) {
        const auto there = TRY(go_on(from, stop));
        if (!there) {
            if (from != copies_.end()) copies_.erase(from);
            return std::optional<Look>();
        }
        from = *there;
        if (from->second.is_over) break;
    }
    const bool asked = from->second.link.send(message(Word::Tell));
    auto told = asked ? from->second.link.receive() : std::nullopt;
    if (!says(told, Word::Told)) {
        copies_.erase(from);
        return std::optional<Look>();
    }
    return std::optional(
        Look{.at = from->first, .text = std::move(told->text), .from = begins_at});
}

Keyframes::Place Keyframes::nearest(Time at) {
    const auto after = copies_.upper_bound(instant_of(at));
    return after == copies_.begin() ? copies_.end() : std::prev(after);
}

std::vector<Time> Keyframes::stops(Place from, Time at) const {
    const bool begins = from == copies_.end();
    const Time begin = begins ? Time{} : from->first;
    if (!begins && (from->second.is_over || begin >= at)) return {};
    std::vector<Time> stops;
    for (const Time one : keyframe_instants(newest_)) {
        if (one > begin && one < at) stops.push_back(one);
    }
    stops.push_back(at);
    return stops;
}

std::vector<std::pair<Time, int64_t>> Keyframes::waiting() const {
    std::vector<std::pair<Time, int64_t>> all;
    for (const auto& [at, copy] : copies_) all.emplace_back(at, copy.process.number());
    return all;
}

// ---- copies ----

// One more that is at its stop, or at the end of the run; nothing: it was not made, or was lost.
Result<std::optional<Keyframes::Place>> Keyframes::go_on(Place from, Time stop) {
    auto [mine, its] = TRY(CopyLink::make());
    if (!make_copy(from, std::move(its), stop)) return std::optional<Place>();
    return await(std::move(mine));
}

bool Keyframes::make_copy(Place from, CopyLink its, Time stop) {
    if (from == copies_.end()) {
        const size_t threads = threads_of_process();
        const int64_t copy = threads == 1 ? supervision_.copy(its.descriptor()) : -1;
        if (copy == 0) RunningCopy(*rerun_, tell_, std::move(its), stop).run();
        if (copy < 0) have_none(threads == 1 ? system_sentence() : why_threads(threads));
        return copy > 0;
    }
    CopyMessage order = message(Word::GoOn, stop);
    order.handed = std::move(its).take();
    const CopyLink& link = from->second.link;
    const auto answer = link.send(order) ? link.receive() : std::nullopt;
    if (says(answer, Word::NotCopied)) have_none(answer->text);
    return says(answer, Word::Copied);
}

Result<std::optional<Keyframes::Place>> Keyframes::await(CopyLink link) {
    std::optional<CopyMessage> began = link.receive();
    if (!says(began, Word::Began)) return std::optional<Place>();
    if (!began->handed.is_open()) {
        have_none("the system gives no handles of processes (pidfd_open)");
        return std::optional<Place>();
    }
    CopyProcess process(began->number, std::move(began->handed));
    const std::optional<CopyMessage> there = link.receive();
    if (says(there, Word::Failed)) return Error{Code::Unavailable, there->text};
    if (!there) return std::optional<Place>();
    const Time at(there->number);
    copies_.erase(at);
    const auto [place, made] = copies_.emplace(
        at, Copy{std::move(link), std::move(process), says(there, Word::IsOver)});
    return std::optional(place);
}

// Those that there are wait for nobody any more.
void Keyframes::have_none(std::string why) {
    why_none_ = std::move(why);
}

// What was looked at last is kept, too: one often looks a little further.
void Keyframes::thin(Time here) {
    const std::vector<Time> wanted = keyframe_instants(newest_);
    std::erase_if(copies_, [&](const auto& one) {
        return one.first != here && !std::ranges::binary_search(wanted, one.first);
    });
}

}  // namespace vagus::record
