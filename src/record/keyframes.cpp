#include "record/keyframes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "base/seconds.hpp"
#include "record/causes.hpp"
#include "toolbox/load.hpp"

namespace vagus::record {

namespace {

// A copy that ends on the way there does so each time, or was ended from outside.
constexpr int kAttemptsMax = 3;

// What copies and their supervisor say to each other. Numbers are instants, but of Began.
enum class Word : uint32_t {
    GoOn = 1,  // to a copy that waits: another one, with the link that is handed, goes on to there;
               // the text has the instants at which it leaves copies on the way
    Tell,      // what there is
    Told,      // the answer
    Began,     // from a copy: its number and its handle
    Left,      // it has left a copy on the way; the link to that is handed
    NotCopied,  // it could not: the text says why
    IsAt,       // it waits there; the text says what there is
    IsOver,     // the same, and the run has ended there
    Failed,     // the run has failed: the text says how
};

CopyMessage message(Word word, Time at = {}, std::string text = {}) {
    return {.word = static_cast<uint32_t>(word), .number = at.count(), .text = std::move(text)};
}

bool says(const std::optional<CopyMessage>& message, Word word) {
    return message && message->word == static_cast<uint32_t>(word);
}

std::string why_threads(size_t threads) {
    return fmt::format(
        "the process of the run has {} threads, and only one of them would be in a "
        "copy of it",
        threads);
}

std::string bytes_of(const std::vector<Time>& instants) {
    std::string bytes(instants.size() * sizeof(int64_t), '\0');
    for (size_t i = 0; i < instants.size(); ++i) {
        const int64_t count = instants[i].count();
        std::memcpy(bytes.data() + i * sizeof count, &count, sizeof count);
    }
    return bytes;
}

std::vector<Time> instants_in(std::string_view bytes) {
    std::vector<Time> instants(bytes.size() / sizeof(int64_t));
    for (size_t i = 0; i < instants.size(); ++i) {
        int64_t count = 0;
        std::memcpy(&count, bytes.data() + i * sizeof count, sizeof count);
        instants[i] = Time(count);
    }
    return instants;
}

// The life of a copy: it runs on to its stop, and waits there for what is wanted of it.
class RunningCopy {
public:
    // The first two are borrowed.
    RunningCopy(Rerun& rerun, const Keyframes::Tell& tell, CopyLink link, const CopyMessage& order)
        : rerun_(rerun), tell_(tell), link_(std::move(link)) {
        begin(order);
    }

    [[noreturn]] void run() {
        rerun_.each_instant([this](Time at) { look(at); });
        NullTape tape;
        const auto ended = rerun_.run(tape);
        if (ended.ok()) {
            const Time at = ended.value().at;
            wait_at(at, message(Word::IsOver, at, tell_(rerun_, at)));
        } else {
            (void)link_.send(message(Word::Failed, {}, ended.error().what));
        }
        end_copy();
    }

private:
    void begin(const CopyMessage& order) {
        stop_ = Time(order.number);
        leaves_ = instants_in(order.text);
        std::ranges::reverse(leaves_);
        introduce();
    }
    void introduce() const {
        (void)link_.send({.word = static_cast<uint32_t>(Word::Began),
                          .number = own_number(),
                          .text = {},
                          .handed = own_handle()});
    }

    void look(Time at) {
        if (at >= stop_) return wait_at(at, message(Word::IsAt, at, tell_(rerun_, at)));
        if (leaves_.empty() || at < leaves_.back()) return;
        leaves_.pop_back();
        leave_copy(at);
    }

    // It is the copy that waits, so this one loses no time.
    void leave_copy(Time at) {
        auto ends = CopyLink::make();
        if (!ends.ok()) return cannot_leave(ends.error().what);
        auto& [mine, its] = ends.value();
        switch (copied(its.descriptor())) {
            case Side::Copy:
                mine = CopyLink(Descriptor());
                link_ = std::move(its);
                introduce();
                return wait_at(at, message(Word::IsAt, at));
            case Side::None:
                return cannot_leave(why_not());
            case Side::This:
                break;
        }
        CopyMessage left = message(Word::Left, at);
        left.handed = std::move(mine).take();
        (void)link_.send(left);
    }
    void cannot_leave(const std::string& why) {
        leaves_.clear();
        (void)link_.send(message(Word::NotCopied, {}, why));
    }

    // Returns in a copy of this one, that goes on.
    void wait_at(Time at, const CopyMessage& first) {
        bool is_heard = link_.send(first);
        while (is_heard) {
            std::optional<CopyMessage> asked = link_.receive();
            if (says(asked, Word::GoOn)) {
                switch (copied(asked->handed)) {
                    case Side::Copy:
                        link_ = CopyLink(std::move(asked->handed));
                        return begin(*asked);
                    case Side::None:
                        is_heard = link_.send(message(Word::NotCopied, {}, why_not()));
                        break;
                    case Side::This:
                        break;
                }
            } else {
                is_heard = says(asked, Word::Tell) &&
                           link_.send(message(Word::Told, at, tell_(rerun_, at)));
            }
        }
        end_copy();
    }

    // Where one finds oneself when this process was copied, and where there is no copy.
    enum class Side : uint8_t { This, Copy, None };
    Side copied(const Descriptor& link) {
        if (threads_of_process() > 1) return Side::None;
        const int64_t copy = copy_again(link);
        if (copy == 0) link_ = CopyLink(Descriptor());  // of the other process
        return copy == 0 ? Side::Copy : copy > 0 ? Side::This : Side::None;
    }
    static std::string why_not() {
        const size_t threads = threads_of_process();
        return threads > 1 ? why_threads(threads) : system_sentence();
    }

    Rerun& rerun_;
    const Keyframes::Tell& tell_;
    CopyLink link_;
    Time stop_{};
    std::vector<Time> leaves_;  // the next one is the last
};

}  // namespace

std::string why_not_copied(const RunFile& about) {
    for (const std::string& one : about.toolboxes) {
        if (!one.ends_with(toolbox::kLibraryEnding)) continue;
        return fmt::format(
            "templates of the plan are in the shared library {}, which may have "
            "threads of its own",
            one);
    }
    return {};
}

Result<std::unique_ptr<Keyframes>> Keyframes::open(const mcap::Reader& reader, Tell tell) {
    auto rerun = TRY(Rerun::open(reader, {}));
    if (rerun->about().is_of_bus()) {
        return Error{Code::Refused,
                     reader.name() +
                         ": is of a real bus, whose nodes cannot be run again, so there is no "
                         "state to look at; `vagus replay` lets its plan decide again"};
    }
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
    settle();
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
    const bool begins = from == copies_.end();
    auto look =
        !begins && (from->second.is_over || from->first >= at) ? ask(from) : TRY(go_on(from, at));
    if (look && !begins) look->from = from->first;
    // One that was lost on the way may have been so by where it began.
    if (!look && !begins && why_none_.empty()) copies_.erase(from);
    return look;
}

Keyframes::Place Keyframes::nearest(Time at) {
    const auto after = copies_.upper_bound(instant_of(at));
    return after == copies_.begin() ? copies_.end() : std::prev(after);
}

std::vector<Time> Keyframes::wanted_between(Time from, Time to) const {
    std::vector<Time> wanted;
    for (const Time one : keyframe_instants(newest_)) {
        if (one > from && one < to) wanted.push_back(one);
    }
    return wanted;
}

std::vector<std::pair<Time, int64_t>> Keyframes::waiting() {
    settle();
    std::vector<std::pair<Time, int64_t>> all;
    for (const auto& [at, copy] : copies_) all.emplace_back(at, copy.process.number());
    return all;
}

// ---- copies ----

std::optional<Keyframes::Look> Keyframes::ask(Place place) {
    const CopyLink& link = place->second.link;
    auto told = link.send(message(Word::Tell)) ? link.receive() : std::nullopt;
    if (!says(told, Word::Told)) return std::nullopt;
    return Look{.at = place->first, .text = std::move(told->text)};
}

Result<std::optional<Keyframes::Look>> Keyframes::go_on(Place from, Time stop) {
    auto [mine, its] = TRY(CopyLink::make());
    const bool begins = from == copies_.end();
    CopyMessage order =
        message(Word::GoOn, stop, bytes_of(wanted_between(begins ? Time{} : from->first, stop)));
    if (begins) {
        const size_t threads = threads_of_process();
        const int64_t copy = threads == 1 ? supervision_.copy(its.descriptor()) : -1;
        if (copy == 0) RunningCopy(*rerun_, tell_, std::move(its), order).run();
        if (copy < 0) why_none_ = threads == 1 ? system_sentence() : why_threads(threads);
        its = CopyLink(Descriptor());
    } else {
        order.handed = std::move(its).take();
        (void)from->second.link.send(order);
        order.handed = Descriptor();
    }
    std::optional<CopyMessage> began = mine.receive();
    if (says(began, Word::Began)) return follow(std::move(mine), std::move(*began));
    if (!begins) {
        const auto answer = from->second.link.receive();
        if (says(answer, Word::NotCopied)) why_none_ = answer->text;
    }
    return std::optional<Look>();
}

// What a copy says until it is at its stop.
Result<std::optional<Keyframes::Look>> Keyframes::follow(CopyLink link, CopyMessage began) {
    if (!began.handed.is_open()) {
        why_none_ = "the system gives no handles of processes (pidfd_open)";
        return std::optional<Look>();
    }
    CopyProcess process(began.number, std::move(began.handed));
    while (std::optional<CopyMessage> said = link.receive()) {
        const Time at(said->number);
        if (says(said, Word::Failed)) return Error{Code::Unavailable, said->text};
        if (says(said, Word::Left)) arriving_.emplace_back(std::move(said->handed));
        if (says(said, Word::NotCopied)) why_none_ = said->text;
        const bool is_over = says(said, Word::IsOver);
        if (!is_over && !says(said, Word::IsAt)) continue;
        keep(at, {std::move(link), std::move(process), is_over});
        return std::optional(Look{.at = at, .text = std::move(said->text)});
    }
    return std::optional<Look>();
}

void Keyframes::keep(Time at, Copy copy) {
    copies_.erase(at);
    copies_.emplace(at, std::move(copy));
}

// Copies that were left on the way are there by now, and those that are not wanted are gone.
void Keyframes::settle() {
    ending_.clear();
    for (CopyLink& link : std::exchange(arriving_, {})) {
        std::optional<CopyMessage> began = link.receive();
        if (!says(began, Word::Began) || !began->handed.is_open()) continue;
        CopyProcess process(began->number, std::move(began->handed));
        const std::optional<CopyMessage> there = link.receive();
        if (says(there, Word::IsAt)) {
            keep(Time(there->number), {std::move(link), std::move(process), false});
        }
    }
}

// What was looked at last is kept, too: one often looks a little further.
void Keyframes::thin(Time here) {
    const std::vector<Time> wanted = keyframe_instants(newest_);
    for (auto one = copies_.begin(); one != copies_.end();) {
        const bool stays = one->first == here || std::ranges::binary_search(wanted, one->first);
        if (!stays) {
            one->second.process.kill();
            ending_.push_back(std::move(one->second.process));
        }
        one = stays ? std::next(one) : copies_.erase(one);
    }
}

}  // namespace vagus::record
