#include "keeper/keeper.hpp"

#include <algorithm>
#include <cassert>

namespace vagus::keeper {

namespace {

bool is_task(const Record& record) {
    return std::holds_alternative<Task>(record);
}

std::pair<std::string, std::string> topic_of(const Record& record) {
    if (const auto* task = std::get_if<Task>(&record)) return {task->queue, task->id};
    if (const auto* shared = std::get_if<Shared>(&record)) return {shared->key, ""};
    return {std::get<Claim>(record).name, ""};
}

// A shared value has no lease.
Lease* lease_of(Record& record) {
    if (auto* task = std::get_if<Task>(&record)) return &task->lease;
    if (auto* claim = std::get_if<Claim>(&record)) return &claim->lease;
    return nullptr;
}

Term last_term(const Record& record) {
    if (const auto* task = std::get_if<Task>(&record))
        return std::max(task->given, task->lease.term);
    if (const auto* shared = std::get_if<Shared>(&record)) return shared->version;
    return std::get<Claim>(record).lease.term;
}

// Robots' clocks and this one may drift apart by 2 % before two leases of one thing overlap.
Duration with_drift(Duration length) {
    return length + length / 50;
}

}  // namespace

const char* name_of(Keeper::State state) {
    switch (state) {
        case Keeper::State::Away:
            return "away";
        case Keeper::State::Listening:
            return "listening";
        case Keeper::State::Resting:
            return "resting";
        case Keeper::State::Serving:
            return "serving";
        case Keeper::State::Out:
            return "out";
    }
    return "";
}

Actions Keeper::take(const Input& input, Time now) {
    now_ = now;
    if (state_ != State::Out) std::visit([this](const auto& told) { on(told); }, input);
    return take_actions();
}

Actions Keeper::take_actions() {
    Actions actions;
    actions.swap(actions_);
    return actions;
}

Actions Keeper::tick(Time now) {
    now_ = now;
    if (state_ == State::Listening && now_ >= listens_until_) listen_is_over();
    if (state_ == State::Resting && now_ >= rests_until_) state_ = State::Serving;
    if (state_ == State::Resting || state_ == State::Serving) {
        if (now_ >= beat_at_) send_beat();
        if (is_confident()) {
            end_leases();
            forget_finished();
        }
    }
    return take_actions();
}

// ---- one keeper of several ----

void Keeper::on(const Connected&) {
    state_ = State::Listening;
    listens_until_ = now_ + kListen;
    strange_.clear();
}

void Keeper::on(const Lost&) {
    state_ = State::Away;
    confident_until_ = {};
    beats_out_.clear();
}

void Keeper::on(const Retained& retained) {
    const Record& record = retained.record;
    const uint64_t epoch = last_term(record).epoch;
    seen_epoch_ = std::max(seen_epoch_, epoch);
    if (epoch_ == 0)
        keep(record);
    else if (epoch > epoch_)
        leave("a later keeper has published " + topic_of(record).first);
    else if (state_ != State::Listening)
        put_right(record);
    else if (!find(topic_of(record)))
        strange_.push_back(record);
}

void Keeper::on(const LastBeat& last) {
    seen_epoch_ = std::max(seen_epoch_, last.epoch);
    // Members that have heard it take nothing from this one.
    if (epoch_ != 0 && last.epoch > epoch_) leave("a later keeper was there, and is gone");
}

void Keeper::on(const Beat& beat) {
    seen_epoch_ = std::max(seen_epoch_, beat.epoch);
    if (beat.instance == options_.instance) {
        const auto sent = beats_out_.find(beat.number);
        if (sent == beats_out_.end()) return;
        confident_until_ = std::max(confident_until_, sent->second + kListen);
        beats_out_.erase(beats_out_.begin(), std::next(sent));
        return;
    }
    // It serves while this one only listens.
    const bool is_later =
        std::pair(beat.epoch, beat.instance) > std::pair(epoch_, options_.instance);
    if (state_ == State::Listening || is_later)
        return leave("there is another keeper, " + beat.instance);
    send_beat();  // it hears this one and leaves
}

void Keeper::listen_is_over() {
    const bool is_new = epoch_ == 0;
    if (is_new) {
        epoch_ = std::max(seen_epoch_ + 1, options_.first_epoch);
        Duration rest = options_.longest;
        for (auto* records : {&tasks_, &keys_})
            for (auto& [topic, record] : *records)
                if (const Lease* lease = lease_of(record)) rest = std::max(rest, lease->length);
        rests_until_ = now_ + with_drift(std::min(rest, kLeaseMax));
    }
    // Another keeper, which is gone, may have renewed them a moment ago: that leaves no record.
    const Duration longest = is_new ? rests_until_ - now_ : with_drift(options_.longest);
    for (auto& [term, out] : leases_) out.until = std::max(out.until, now_ + longest);
    state_ = now_ < rests_until_ ? State::Resting : State::Serving;
    send_beat();
    if (!is_new) publish_all();
}

void Keeper::send_beat() {
    beat_at_ = now_ + kBeatEvery;
    beats_out_[++beats_] = now_;
    actions_.emplace_back(Beat{epoch_, options_.instance, beats_});
}

void Keeper::leave(std::string why) {
    state_ = State::Out;
    unacknowledged_.clear();
    actions_.emplace_back(Leave{std::move(why)});
}

bool Keeper::is_confident() const {
    return (state_ == State::Resting || state_ == State::Serving) && now_ < confident_until_;
}

// The broker may have been started again with what it saved earlier.
void Keeper::publish_all() {
    std::map<Topic, std::vector<Answer>> answers;
    for (auto& [number, waiting] : unacknowledged_)
        std::move(waiting.answers.begin(), waiting.answers.end(),
                  std::back_inserter(answers[waiting.topic]));
    unacknowledged_.clear();
    for (const Record& record : strange_) publish(record, true, {});
    strange_.clear();
    for (const auto* records : {&tasks_, &keys_})
        for (const auto& [topic, record] : *records)
            publish(record, false, std::move(answers[topic]));
}

// ---- records ----

void Keeper::keep(const Record& record) {
    const Topic topic = topic_of(record);
    auto& records = is_task(record) ? tasks_ : keys_;
    if (const auto before = records.find(topic); before != records.end()) {
        if (const Lease* lease = lease_of(before->second)) leases_.erase(lease->term);
        if (const auto* task = std::get_if<Task>(&before->second))
            waiting_.erase({task->given, topic});
    }
    records[topic] = record;
    if (const auto* task = std::get_if<Task>(&record)) {
        if (task->work == Work::Waiting) waiting_.insert({task->given, topic});
        if (task->work == Work::Leased) leases_[task->lease.term] = {{}, topic};
        if (task->work == Work::Done) finished(topic);
    }
    if (const auto* claim = std::get_if<Claim>(&record))
        if (!claim->lease.robot.empty()) leases_[claim->lease.term] = {{}, topic};
}

auto Keeper::records_of(const Topic& topic) -> std::map<Topic, Record>& {
    return topic.second.empty() ? keys_ : tasks_;
}

Record* Keeper::find(const Topic& topic) {
    auto& records = records_of(topic);
    const auto found = records.find(topic);
    return found == records.end() ? nullptr : &found->second;
}

// Somebody else has published there: a keeper that had not noticed yet that it is not alone.
void Keeper::put_right(const Record& told) {
    if (!is_confident()) return;
    const Record* ours = find(topic_of(told));
    if (ours && *ours == told) return;
    publish(ours ? *ours : told, !ours, {});
}

Record* Keeper::leased(const Asker& asker, Term term) {
    const auto out = leases_.find(term);
    Record* const record = out == leases_.end() ? nullptr : find(out->second.topic);
    if (!record || lease_of(*record)->robot != asker.robot) {
        refuse(asker, "the lease " + text_of(term) + " is over, or another robot has it");
        return nullptr;
    }
    return record;
}

Record& Keeper::lease_out(Record& record, const Asker& asker, Duration length) {
    length = std::clamp(length, kLeaseMin, std::clamp(options_.longest, kLeaseMin, kLeaseMax));
    *lease_of(record) = {asker.robot, next_term(), length};
    leases_[lease_of(record)->term] = {now_ + with_drift(length), topic_of(record)};
    return record;
}

// What was leased is free again, or over.
void Keeper::end_lease(Term term, bool is_over) {
    const Topic topic = leases_.at(term).topic;
    leases_.erase(term);
    Record& record = records_of(topic).at(topic);
    lease_of(record)->robot.clear();
    auto* task = std::get_if<Task>(&record);
    if (!task) return;
    task->work = is_over ? Work::Done : Work::Waiting;
    if (is_over)
        finished(topic);
    else
        waiting_.insert({task->given, topic});
}

void Keeper::end_leases() {
    std::vector<Term> ended;
    for (const auto& [term, out] : leases_)
        if (now_ >= out.until) ended.push_back(term);
    for (const Term term : ended) {
        const Topic topic = leases_.at(term).topic;
        end_lease(term, false);
        publish(*find(topic), false, {});
    }
}

void Keeper::finished(const Topic& topic) {
    finished_.push_back({now_ + kDoneKept, topic});
}

void Keeper::forget_finished() {
    while (!finished_.empty() && now_ >= finished_.front().first) {
        const Topic topic = finished_.front().second;
        finished_.pop_front();
        const auto task = tasks_.find(topic);
        if (task == tasks_.end()) continue;  // it was found twice
        publish(task->second, true, {});
        tasks_.erase(task);
    }
}

// ---- questions ----

void Keeper::on(const Asked& asked) {
    const bool needs_new_term = std::holds_alternative<Give>(asked.request) ||
                                std::holds_alternative<Take>(asked.request) ||
                                std::holds_alternative<ClaimName>(asked.request) ||
                                std::holds_alternative<Write>(asked.request);
    if (!is_confident() || (needs_new_term && state_ == State::Resting)) {
        ++ignored_;
        return;
    }
    end_leases();
    if (is_repeated(asked.asker)) return;
    std::visit([&](const auto& request) { obey(asked.asker, request); }, asked.request);
}

void Keeper::obey(const Asker& asker, const Give& give) {
    const Topic topic{give.queue, give.id};
    if (const Record* known = find(topic)) return publish_and_answer(*known, asker);
    if (!fits(asker, give.queue.size(), kNameMax, "bytes of a queue's name") ||
        !fits(asker, give.id.size(), kNameMax, "bytes of an id") ||
        !fits(asker, give.data.size(), kTextMax, "bytes of a task") ||
        !fits(asker, tasks_.size() + 1, kTasksMax, "tasks"))
        return;
    keep(Task{give.queue, give.id, next_term(), give.data, Work::Waiting, {}, ""});
    publish_and_answer(tasks_.at(topic), asker);
}

void Keeper::obey(const Asker& asker, const Take& take) {
    const auto next = std::ranges::find_if(
        waiting_, [&](const auto& task) { return task.second.first == take.queue; });
    if (next == waiting_.end())
        return answer(asker, {Outcome::Nothing, "no task waits in " + take.queue, epoch_, {}});
    Record& record = tasks_.at(next->second);
    waiting_.erase(next);
    std::get<Task>(record).work = Work::Leased;
    publish_and_answer(lease_out(record, asker, take.length), asker);
}

void Keeper::obey(const Asker& asker, const ClaimName& claim) {
    if (!fits(asker, claim.name.size(), kNameMax, "bytes of a name")) return;
    const auto found = keys_.find({claim.name, ""});
    if (found == keys_.end()) {
        if (!fits(asker, keys_.size() + 1, kKeysMax, "shared values and names")) return;
        keep(Claim{claim.name, {}});
    } else if (std::holds_alternative<Shared>(found->second)) {
        return refuse(asker, claim.name + " is a shared value, and cannot be claimed");
    }
    Record& record = keys_.at({claim.name, ""});
    if (const std::string& robot = lease_of(record)->robot; !robot.empty())
        return answer(asker, {Outcome::Nothing, robot + " has " + claim.name, epoch_, record});
    publish_and_answer(lease_out(record, asker, claim.length), asker);
}

// Not published: a keeper that starts later waits for the longest lease anyway.
void Keeper::obey(const Asker& asker, const Renew& renew) {
    Record* record = leased(asker, renew.term);
    if (!record) return;
    Time& until = leases_.at(renew.term).until;
    until = std::max(until, now_ + with_drift(lease_of(*record)->length));
    answer(asker, {Outcome::Done, "", epoch_, *record});
}

void Keeper::obey(const Asker& asker, const Finish& finish) {
    if (!fits(asker, finish.result.size(), kTextMax, "bytes of a result")) return;
    Record* record = leased(asker, finish.term);
    if (!record) return;
    auto* task = std::get_if<Task>(record);
    if (!task) return refuse(asker, topic_of(*record).first + " is a name: release it");
    task->result = finish.result;
    end_lease(finish.term, true);
    publish_and_answer(*record, asker);
}

void Keeper::obey(const Asker& asker, const Release& release) {
    Record* record = leased(asker, release.term);
    if (!record) return;
    end_lease(release.term, false);
    publish_and_answer(*record, asker);
}

void Keeper::obey(const Asker& asker, const Write& write) {
    if (!fits(asker, write.key.size(), kNameMax, "bytes of a key") ||
        !fits(asker, write.value.size(), kTextMax, "bytes of a value"))
        return;
    const auto found = keys_.find({write.key, ""});
    if (found == keys_.end()) {
        if (write.seen != Term{})
            return answer(asker, {Outcome::Nothing, "there is no value " + write.key, epoch_, {}});
        if (!fits(asker, keys_.size() + 1, kKeysMax, "shared values and names")) return;
    } else {
        const auto* shared = std::get_if<Shared>(&found->second);
        if (!shared)
            return refuse(asker, write.key + " is a name that is claimed, and has no value");
        if (shared->version != write.seen)
            return answer(asker, {Outcome::Nothing,
                                  write.key + " is of version " + text_of(shared->version) +
                                      ", not " + text_of(write.seen),
                                  epoch_, *shared});
    }
    keep(Shared{write.key, next_term(), write.value});
    publish_and_answer(keys_.at({write.key, ""}), asker);
}

// ---- replies ----

// Of a life that is new the oldest one makes room: of that robot if it had many, else of all.
Keeper::Kept& Keeper::kept_of(const Life& life) {
    if (const auto known = kept_.find(life); known != kept_.end()) return known->second;
    const auto first = kept_.lower_bound({life.first, 0});
    const auto last = kept_.upper_bound({life.first, UINT64_MAX});
    const auto asked = [](const auto& kept) { return kept.second.asked; };
    if (std::distance(first, last) >= std::ptrdiff_t{kLivesMax})
        kept_.erase(std::min_element(
            first, last, [&](const auto& a, const auto& b) { return asked(a) < asked(b); }));
    else if (kept_.size() >= kAskersMax)
        kept_.erase(std::ranges::min_element(kept_, {}, asked));
    return kept_[life];
}

// A question that was answered is answered again, one that is being answered is not asked twice.
bool Keeper::is_repeated(const Asker& asker) {
    Kept& kept = kept_of({asker.robot, asker.epoch});
    kept.asked = ++questions_;
    auto& replies = kept.replies;
    if (const auto known = replies.find(asker.number); known != replies.end()) {
        if (known->second) actions_.emplace_back(Answer{asker, *known->second});
        return true;
    }
    if (replies.size() >= kRepliesKept) {
        if (asker.number < replies.begin()->first) return true;
        replies.erase(replies.begin());
    }
    replies[asker.number] = std::nullopt;
    return false;
}

bool Keeper::fits(const Asker& asker, size_t count, size_t most, const char* what) {
    if (count <= most) return true;
    refuse(asker, "at most " + std::to_string(most) + " " + what + ", and these are " +
                      std::to_string(count));
    return false;
}

void Keeper::refuse(const Asker& asker, std::string why) {
    answer(asker, {Outcome::Refused, std::move(why), epoch_, {}});
}

void Keeper::answer(const Asker& asker, Reply reply) {
    const auto kept = kept_.find({asker.robot, asker.epoch});
    if (kept == kept_.end()) return;  // forgotten meanwhile
    if (const auto known = kept->second.replies.find(asker.number);
        known != kept->second.replies.end())
        known->second = reply;
    actions_.emplace_back(Answer{asker, std::move(reply)});
}

void Keeper::publish(const Record& record, bool gone, std::vector<Answer> answers) {
    unacknowledged_[++publications_] = {topic_of(record), std::move(answers)};
    actions_.emplace_back(Publish{publications_, record, gone});
}

void Keeper::publish_and_answer(const Record& record, const Asker& asker) {
    publish(record, false, {Answer{asker, {Outcome::Done, "", epoch_, record}}});
}

void Keeper::on(const Acknowledged& acknowledged) {
    const auto found = unacknowledged_.find(acknowledged.publication);
    if (found == unacknowledged_.end()) return;
    const std::vector<Answer> answers = std::move(found->second.answers);
    unacknowledged_.erase(found);
    for (const Answer& one : answers) answer(one.asker, one.reply);
}

}  // namespace vagus::keeper
