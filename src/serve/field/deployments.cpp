#include "serve/field/deployments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kNothingBegun = "no deployment was begun; begin with the list of its files";
constexpr const char* kBusy = "another version is just being put in force; wait for it";

bool has_error(const std::vector<DocFinding>& findings) {
    return std::any_of(findings.begin(), findings.end(), [](const DocFinding& finding) {
        return finding.severity == Severity::Error;
    });
}

// A robot that was set up and waits for its first project.
bool is_empty_place(const fs::path& folder) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
        if (entry.path().filename() != kOwnFolder) return false;
    }
    return !failed;
}

}  // namespace

const char* word_of(DeployOutcome::Result result) {
    switch (result) {
        case DeployOutcome::Result::Started:
            return "started";
        case DeployOutcome::Result::Stopped:
            return "stopped";
        case DeployOutcome::Result::Refused:
            return "refused";
        case DeployOutcome::Result::RolledBack:
            return "rolled_back";
        case DeployOutcome::Result::Waiting:
            return "waiting";
    }
    return "refused";
}

// ---- the boot ----

Status Deployments::boot(bool start, Time now) {
    now_ = now;
    const Status tidy = versions_.tidy_up();
    if (!tidy.ok()) call_.log("warning", tidy.error().what);
    auto trial = tidy.ok() ? versions_.trial() : std::nullopt;
    if (trial && ++trial->tries > kTrialBootsMax) {
        call_.log("error", fmt::format("version {} did not start at {} boots; version {} is in "
                                       "force again",
                                       trial->version, kTrialBootsMax, trial->back));
        TRY(versions_.put_in_force(trial->back));
        versions_.end_trial();
        versions_.remove(trial->version);
        trial.reset();
    }
    const uint32_t version = versions_.current();
    if (version == 0 && is_empty_place(versions_.folder(0))) {
        call_.log("note", "there is no project yet; `vagus deploy` sends the first");
        return Status::done();
    }
    if (trial) TRY(versions_.write_trial(*trial));
    const Status opened = call_.open(versions_.folder(version));
    if (!opened.ok() && !trial) return opened;
    if (version > 0) call_.log("note", fmt::format("version {} is in force", version));
    if (trial) trying_ = Trying{trial->version, trial->back, now + kStartWithin};
    if (!opened.ok()) {
        roll_back(opened.error().what);
    } else if (start) {
        starter_.begin(now);
    } else {
        trying_.reset();  // a person will see
    }
    return Status::done();
}

// ---- a version comes ----

Status Deployments::begin(Bundle bundle) {
    if (busy() || trying_) return Error{Code::Refused, kBusy};
    TRY(check_bundle(bundle));
    TRY(versions_.begin());
    stop_pressed_ = false;
    bundle_ = std::move(bundle);
    bundle_->when_wall = call_.wall_ms();
    file_ = 0;
    content_.clear();
    return Status::done();
}

template <typename Outcome>
void Deployments::work(std::function<Outcome()> act, std::function<void(Outcome)> then) {
    ++working_;
    worked<Outcome>(call_.work, std::move(act), [this, then = std::move(then)](Outcome outcome) {
        --working_;
        then(std::move(outcome));
    });
}

Status Deployments::check_part(const std::string& path, size_t from, size_t size) const {
    if (!bundle_) return Error{Code::Refused, kNothingBegun};
    const bool more = file_ < bundle_->files.size();
    const std::string expected = more ? bundle_->files[file_].path : "nothing more";
    if (!more || path != expected || from != content_.size()) {
        return Error{Code::BadInput, fmt::format("{} from byte {}: expected {} from byte {}", path,
                                                 from, expected, content_.size())};
    }
    const BundleFile& file = bundle_->files[file_];
    if (size <= file.size - from) return Status::done();
    return Error{Code::BadInput, fmt::format("{}: more than the {} bytes that were announced",
                                             file.path, file.size)};
}

void Deployments::part(const std::string& path, size_t from, std::string_view bytes, Taken taken) {
    const Status good = check_part(path, from, bytes.size());
    if (!good.ok()) return taken(good);
    content_ += bytes;
    if (content_.size() < bundle_->files[file_].size) return taken(Status::done());
    add_file(std::move(taken));
}

void Deployments::add_file(Taken taken) {
    const BundleFile& file = bundle_->files[file_++];
    work<Status>(
        [&versions = versions_, file, content = std::exchange(content_, {})]() -> Status {
            if (sha256_of(content) == file.sha256) return versions.add(file.path, content);
            return Error{Code::BadInput, file.path +
                                             ": what arrived is not what was announced; deploy "
                                             "again"};
        },
        [this, taken = std::move(taken)](const Status& added) {
            if (!added.ok()) bundle_.reset();
            taken(added);
        });
}

void Deployments::refuse(const std::string& why, std::vector<DocFinding> findings) {
    ++counts_.refused;
    bundle_.reset();
    versions_.forget_incoming();
    finish({DeployOutcome::Result::Refused, versions_.current(), std::move(findings), why});
}

void Deployments::commit(Done done) {
    if (busy() || trying_)
        return done({DeployOutcome::Result::Refused, versions_.current(), {}, kBusy});
    done_ = std::move(done);
    if (!bundle_) return refuse(kNothingBegun);
    if (file_ < bundle_->files.size()) {
        return refuse(bundle_->files[file_].path + ": it was not fully received");
    }
    using Found = vagus::Result<std::vector<DocFinding>>;
    work<Found>([check = call_.check(),
                 folder = versions_.incoming(*bundle_)]() -> Found { return check(folder); },
                [this](const Found& found) { checked(found); });
}

void Deployments::checked(const vagus::Result<std::vector<DocFinding>>& found) {
    if (!found.ok()) return refuse(found.error().what);
    if (has_error(found.value())) {
        return refuse("it has mistakes; nothing was changed", found.value());
    }
    work<vagus::Result<uint32_t>>(
        [&versions = versions_, bundle = *bundle_] { return versions.finish(bundle); },
        [this](const vagus::Result<uint32_t>& number) { received(number); });
}

void Deployments::received(const vagus::Result<uint32_t>& number) {
    if (!number.ok()) return refuse(number.error().what);
    const uint32_t back = versions_.current();
    bundle_.reset();
    call_.log("note", fmt::format("version {} was received and checked", number.value()));
    stop_for({.version = number.value(), .back = back});
}

// What the robot answers comes while it is at work with its nodes: they are left at the next tick.
void Deployments::stop_for(Trying next) {
    starter_.give_up();
    stands_ = false;
    next_ = next;
    call_.stop([this] { stands_ = true; });
}

void Deployments::put_in_force(Trying next) {
    work<Status>(
        [&versions = versions_, next]() -> Status {
            const Status switched = versions.put_in_force(next.version);
            if (!switched.ok() && next.if_not == IfNot::GoBack) {
                versions.end_trial();
                versions.remove(next.version);
            }
            return switched;
        },
        [this, next](const Status& switched) { in_force(next, switched); });
}

void Deployments::in_force(Trying next, const Status& switched) {
    if (!switched.ok()) return refuse(switched.error().what + "; the robot is stopped");
    next.until = now_ + kStartWithin;
    trying_ = next;
    const Status opened = call_.open(versions_.folder(next.version));
    if (!opened.ok()) return give_up(opened.error().what);
    if (stop_pressed_) return stopped();
    starter_.begin(now_);
}

void Deployments::back(Done done) {
    if (busy() || trying_)
        return done({DeployOutcome::Result::Refused, versions_.current(), {}, kBusy});
    done_ = std::move(done);
    stop_pressed_ = false;
    const uint32_t from = versions_.current();
    if (const Status held = versions_.hold(); !held.ok()) return refuse(held.error().what);
    if (from == 0) return refuse("the folder as it was given is in force; nothing is before it");
    stop_for({.version = versions_.before(from), .back = from, .if_not = IfNot::Wait});
}

// ---- does it start? ----

void Deployments::tick(Time now) {
    now_ = now;
    if (std::exchange(stands_, false) && next_) {
        return put_in_force(*std::exchange(next_, std::nullopt));
    }
    if (!trying_) return;
    if (starter_.state() == Starter::State::Failed)
        return give_up("it does not start: " + starter_.why());
    if (starter_.state() == Starter::State::Started) {
        if (!trying_->started) trying_->started = now;
        const bool has_plan = !call_.plan().empty();
        if (!has_plan || now >= *trying_->started + kProvesWithin) tried();
        return;
    }
    trying_->started.reset();  // its run died
    if (now < trying_->until) return;
    give_up(fmt::format("it did not start within {} s: {}", kStartWithin / Duration(1s),
                        starter_.why()));
}

Time Deployments::next_tick() const {
    if (stands_) return now_;
    if (!trying_) return Time::max();
    return trying_->started ? *trying_->started + kProvesWithin : trying_->until;
}

void Deployments::give_up(const std::string& why) {
    if (trying_->if_not == IfNot::GoBack) return roll_back(why);
    const uint32_t version = trying_->version;
    trying_.reset();
    finish({DeployOutcome::Result::Waiting, version, {}, why});
}

void Deployments::tried() {
    const uint32_t version = trying_->version;
    trying_.reset();
    ++counts_.started;
    call_.log("note", fmt::format("version {} runs", version));
    work<Status>(
        [&versions = versions_] {
            versions.end_trial();
            versions.remove_old();
            return Status::done();
        },
        [this, version](const Status&) {
            finish({DeployOutcome::Result::Started, version, {}, call_.plan()});
        });
}

// It starts whenever it can: it has done so before.
void Deployments::roll_back(const std::string& why) {
    const Trying tried = *trying_;
    trying_.reset();
    ++counts_.rolled_back;
    call_.log("error", fmt::format("version {}: {}; version {} is in force again", tried.version,
                                   why, tried.back));
    work<Status>(
        [&versions = versions_, tried]() -> Status {
            TRY(versions.put_in_force(tried.back));
            versions.end_trial();
            versions.remove(tried.version);
            return Status::done();
        },
        [this, why](const Status& back) { rolled_back(back, why); });
}

void Deployments::rolled_back(const Status& back, const std::string& why) {
    const Status opened = back.ok() ? call_.open(versions_.folder(versions_.current())) : back;
    if (opened.ok()) {
        starter_.begin(now_);
    } else {
        call_.log("error", opened.error().what);
    }
    finish({DeployOutcome::Result::RolledBack, versions_.current(), {}, why});
}

// A person's Stop counts more than any version: nothing starts by itself after it.
void Deployments::stopped() {
    stop_pressed_ = true;
    ++stops_;
    if (!trying_) return;
    const uint32_t version = trying_->version;
    trying_.reset();
    work<Status>(
        [&versions = versions_] {
            versions.end_trial();
            return Status::done();
        },
        [this, version](const Status&) {
            finish({DeployOutcome::Result::Stopped,
                    version,
                    {},
                    "somebody pressed Stop before it ran"});
        });
}

void Deployments::finish(DeployOutcome outcome) {
    const Done done = std::exchange(done_, nullptr);
    if (done) done(std::move(outcome));
}

}  // namespace vagus::serve
