#include "serve/field/deployments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;
using Result = DeployOutcome::Result;

namespace {

constexpr const char* kNothingBegun = "no deployment was begun; begin with the list of its files";
constexpr const char* kBusy = "another version is just being put in force; wait for it";

bool has_error(const std::vector<Finding>& findings) {
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& finding) { return finding.severity == Severity::Error; });
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

// ---- the boot ----

Status Deployments::boot(bool start, Time now) {
    now_ = now;
    versions_.tidy_up();
    auto trial = versions_.trial();
    if (trial && ++trial->tries > kTrialBootsMax) {
        robot_.log("error", fmt::format("version {} did not start at {} boots; version {} is in "
                                        "force again",
                                        trial->version, kTrialBootsMax, trial->back));
        TRY(versions_.put_in_force(trial->back));
        versions_.end_trial();
        versions_.remove(trial->version);
        trial.reset();
    }
    const uint32_t version = versions_.current();
    if (version == 0 && is_empty_place(versions_.folder(0))) {
        robot_.log("note", "there is no project yet; `vagus deploy` sends the first");
        return Status::done();
    }
    if (trial) TRY(versions_.write_trial(*trial));
    const Status opened = robot_.open(versions_.folder(version));
    if (!opened.ok() && !trial) return opened;
    if (version > 0) robot_.log("note", fmt::format("version {} is in force", version));
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
    bundle_ = std::move(bundle);
    bundle_->when_wall = robot_.wall_ms();
    file_ = 0;
    content_.clear();
    return Status::done();
}

Status Deployments::part(const std::string& path, size_t from, std::string_view bytes) {
    if (!bundle_) return Error{Code::Refused, kNothingBegun};
    const bool more = file_ < bundle_->files.size();
    const std::string expected = more ? bundle_->files[file_].path : "nothing more";
    if (!more || path != expected || from != content_.size()) {
        return Error{Code::BadInput, fmt::format("{} from byte {}: expected {} from byte {}", path,
                                                 from, expected, content_.size())};
    }
    return receive(from, bytes);
}

Status Deployments::receive(size_t from, std::string_view bytes) {
    const BundleFile& file = bundle_->files[file_];
    if (bytes.size() > file.size - from) {
        return Error{Code::BadInput, fmt::format("{}: more than the {} bytes that were announced",
                                                 file.path, file.size)};
    }
    content_ += bytes;
    if (content_.size() < file.size) return Status::done();
    if (sha256_of(content_) != file.sha256) {
        return Error{Code::BadInput,
                     file.path + ": it is not what was announced; deploy once more"};
    }
    TRY(versions_.add(file.path, content_));
    ++file_;
    content_.clear();
    return Status::done();
}

void Deployments::refuse(const std::string& why, std::vector<Finding> findings) {
    ++counts_.refused;
    bundle_.reset();
    versions_.forget_incoming();
    finish({Result::Refused, versions_.current(), std::move(findings), why});
}

void Deployments::commit(Done done) {
    if (busy() || trying_) return done({Result::Refused, versions_.current(), {}, kBusy});
    done_ = std::move(done);
    if (!bundle_) return refuse(kNothingBegun);
    if (file_ < bundle_->files.size()) {
        return refuse(bundle_->files[file_].path + ": it has not come whole");
    }
    std::vector<Finding> findings = robot_.check(versions_.incoming(*bundle_));
    if (has_error(findings)) {
        return refuse("it has mistakes; nothing was changed", std::move(findings));
    }
    const uint32_t back = versions_.current();
    const auto number = versions_.finish(*bundle_);
    if (!number.ok()) return refuse(number.error().what);
    bundle_.reset();
    robot_.log("note", fmt::format("version {} has come and is sound", number.value()));
    stop_for({.version = number.value(), .back = back});
}

// What the robot answers comes while it is at work with its nodes: they are left at the next tick.
void Deployments::stop_for(Trying next) {
    starter_.give_up();
    stop_pressed_ = stands_ = false;
    next_ = next;
    robot_.stop([this] { stands_ = true; });
}

void Deployments::put_in_force(Trying next) {
    const bool is_new = next.if_not == IfNot::GoBack;
    const Status switched = versions_.put_in_force(next.version);
    if (!switched.ok()) {
        if (is_new) versions_.end_trial();
        if (is_new) versions_.remove(next.version);
        return refuse(switched.error().what + "; the robot stands");
    }
    next.until = now_ + kStartWithin;
    trying_ = next;
    const Status opened = robot_.open(versions_.folder(next.version));
    if (!opened.ok()) return give_up(opened.error().what);
    if (stop_pressed_) return stopped();
    starter_.begin(now_);
}

void Deployments::back(Done done) {
    if (busy() || trying_) return done({Result::Refused, versions_.current(), {}, kBusy});
    done_ = std::move(done);
    const uint32_t from = versions_.current();
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
    if (starter_.state() == Starter::State::Started) return tried();
    if (now < trying_->until) return;
    give_up(fmt::format("it did not start within {} s: {}", kStartWithin / Duration(1s),
                        starter_.why()));
}

void Deployments::give_up(const std::string& why) {
    if (trying_->if_not == IfNot::GoBack) return roll_back(why);
    const uint32_t version = trying_->version;
    trying_.reset();
    finish({Result::Waiting, version, {}, why});
}

void Deployments::tried() {
    const uint32_t version = trying_->version;
    trying_.reset();
    versions_.end_trial();
    versions_.remove_old();
    ++counts_.started;
    robot_.log("note", fmt::format("version {} runs", version));
    finish({Result::Started, version, {}, ""});
}

// It starts whenever it can: it has done so before.
void Deployments::roll_back(const std::string& why) {
    const Trying tried = *trying_;
    trying_.reset();
    ++counts_.rolled_back;
    robot_.log("error", fmt::format("version {}: {}; version {} is in force again", tried.version,
                                    why, tried.back));
    Status back = versions_.put_in_force(tried.back);
    if (back.ok()) {
        versions_.end_trial();
        versions_.remove(tried.version);
        back = robot_.open(versions_.folder(tried.back));
    }
    if (back.ok()) {
        starter_.begin(now_);
    } else {
        robot_.log("error", back.error().what);
    }
    finish({Result::RolledBack, versions_.current(), {}, why});
}

// A person's Stop counts more than any version: nothing starts by itself after it.
void Deployments::stopped() {
    stop_pressed_ = true;
    if (!trying_) return;
    const uint32_t version = trying_->version;
    trying_.reset();
    versions_.end_trial();
    finish({Result::Stopped, version, {}, "somebody pressed Stop before it ran; it stands"});
}

void Deployments::finish(DeployOutcome outcome) {
    const Done done = std::exchange(done_, nullptr);
    if (done) done(std::move(outcome));
}

}  // namespace vagus::serve
