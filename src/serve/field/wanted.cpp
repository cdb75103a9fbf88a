#include "serve/field/wanted.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/text.hpp"
#include "fleet/limits.hpp"

namespace vagus::serve {

namespace {

constexpr const char* kNotYet = "not_yet";
constexpr const char* kTaken = "taken";
constexpr const char* kInterrupted =
    "the robot was started again while it went back to the version before; see which version it "
    "runs before you roll back again";

Result<Packed> checked(const fleet::Want& want, const Result<std::string>& bytes) {
    if (!bytes.ok()) return bytes.error();
    if (sha256_of(bytes.value()) == want.sha256) return unpack(bytes.value());
    return Error{Code::BadInput,
                 want.address + ": what is there is not what is wanted: it has another SHA-256"};
}

std::string reason_of(const DeployOutcome& outcome) {
    for (const DocFinding& finding : outcome.findings) {
        if (finding.severity != Severity::Error) continue;
        return fmt::format("{}; {}:{}: {}", outcome.why, finding.doc, finding.at.line,
                           finding.what);
    }
    return outcome.why;
}

// None, if there is none that can be read: then the roll-out is done once more.
std::optional<fleet::Version> read_last(const std::string& file) {
    const auto text = read_file(file);
    if (!text.ok()) return std::nullopt;
    const auto heard = fleet::read("robot", "vagus/1/robot/robot/robot/version", text.value());
    if (!heard.ok()) return std::nullopt;
    return std::get<fleet::Version>(heard.value().message);
}

}  // namespace

Wanted::Wanted(Deployments& deployments, Callbacks calls)
    : deployments_(deployments), call_(std::move(calls)), last_(read_last(call_.file)) {}

void Wanted::adopt(const std::string& file) {
    std::error_code failed;
    if (last_) {
        std::filesystem::remove(file, failed);
        return;
    }
    last_ = read_last(file);
    std::filesystem::create_directories(std::filesystem::path(call_.file).parent_path(), failed);
    std::filesystem::rename(file, call_.file, failed);
    if (!failed) return;
    call_.log("warning", fmt::format("fleet: {} cannot be renamed to {}: {}", file, call_.file,
                                     failed.message()));
}

void Wanted::want(const fleet::Want& want) {
    const bool is_under_way = under_way_ && under_way_->number == want.number;
    const bool is_done =
        last_ && last_->number == want.number && !under_way_ && !was_interrupted(want);
    if (is_under_way || is_done) return call_.tell(*last_);
    next_ = want;
    tick(now_);
}

void Wanted::tick(Time now) {
    now_ = now;
    if (next_ && !under_way_ && deployments_.may_begin()) begin();
    watch_health();
}

Time Wanted::next_tick() const {
    return health_ ? health_->next_tick() : Time::max();
}

bool Wanted::lacks_health() const {
    return last_ && !under_way_ && last_->result == "started" && last_->healthy == kNotYet;
}

// Also after the robot was started again in the meantime.
void Wanted::watch_health() {
    if (!lacks_health()) return health_.reset();
    if (!health_) {
        const auto healthy = call_.healthy();
        if (!healthy) return;
        health_.emplace(*healthy, call_.read);
        tell_at_ = now_;
    }
    health_->tick(now_);
    const bool is_news = health_->why() != last_->why && now_ >= tell_at_;
    if (!health_->is_well() && !is_news) return;
    last_->why = health_->why();
    tell_at_ = now_ + fleet::kConditionToldEvery;
    if (health_->is_well()) {
        last_->healthy = "well";
        keep_or_warn();
        call_.log("note", fmt::format("fleet: roll-out {}: {}", last_->number, last_->why));
        health_.reset();
    }
    call_.tell(*last_);
}

void Wanted::begin() {
    under_way_ = std::exchange(next_, std::nullopt);
    const fleet::Want want = *under_way_;
    if (was_interrupted(want)) return told("refused", kInterrupted);
    // It has not got the version that others have: the one before is in force. Where the last wish
    // was to go back itself (it names no version), nothing is known of that.
    const bool is_back = last_ && !last_->sha256.empty() &&
                         (last_->result == "refused" || last_->result == "rolled_back");
    last_ = fleet::Version{want.number, want.sha256, kTaken, ""};
    health_.reset();
    stops_before_ = deployments_.stops();
    call_.tell(*last_);
    call_.log("note", fmt::format("fleet: roll-out {}: {}", want.number,
                                  want.back ? "back to the version before" : want.address));
    if (want.back && is_back) return told("started", "the version before is in force already");
    if (want.back) return go_back();
    worked<vagus::Result<Packed>>(
        call_.work, [want, fetch = call_.fetch] { return checked(want, fetch(want.address)); },
        [this](const vagus::Result<Packed>& packed) { fetched(packed); });
}

// Going back twice leads to another version than going back once: that it was begun is on the disk
// before anything is changed.
void Wanted::go_back() {
    if (const Status kept = keep(); !kept.ok()) {
        return told("refused", fmt::format("{}; nothing was changed: it would go back once more "
                                           "at its next start; free space on its disk",
                                           kept.error().what));
    }
    deployments_.back([this](const DeployOutcome& outcome) { over(outcome); });
}

// The robot went back for that wish when it was started again, and it is not known how far it was.
bool Wanted::was_interrupted(const fleet::Want& want) const {
    return want.back && last_ && last_->number == want.number && last_->result == kTaken;
}

// A person's Stop counts more than a wish that came before it.
void Wanted::fetched(const vagus::Result<Packed>& packed) {
    if (!packed.ok()) return told("refused", packed.error().what);
    if (deployments_.stops() != stops_before_) {
        return told("refused", "somebody pressed Stop while it was fetched; deploy it again");
    }
    const Status begun = deployments_.begin(packed.value().bundle);
    if (!begun.ok()) return told("refused", begun.error().what);
    send(std::make_shared<const Packed>(packed.value()), 0);
}

// One file after the other, as they come from `vagus deploy`.
void Wanted::send(const std::shared_ptr<const Packed>& packed, size_t file) {
    if (file == packed->contents.size()) {
        return deployments_.commit([this](const DeployOutcome& outcome) { over(outcome); });
    }
    deployments_.part(packed->bundle.files[file].path, 0, packed->contents[file],
                      [this, packed, file](const Status& taken) {
                          if (!taken.ok()) return told("refused", taken.error().what);
                          send(packed, file + 1);
                      });
}

void Wanted::over(const DeployOutcome& outcome) {
    told(word_of(outcome.result), reason_of(outcome));
}

void Wanted::told(const std::string& result, const std::string& why) {
    const fleet::Want want = *std::exchange(under_way_, std::nullopt);
    last_ = fleet::Version{want.number, want.sha256, result,
                           std::string(utf8_prefix(visible_lines(why), fleet::kLineBytesMax))};
    if (result == "started" && call_.healthy()) last_->healthy = kNotYet;
    keep_or_warn();
    call_.tell(*last_);
    call_.log("note", fmt::format("fleet: roll-out {}: {}{}", want.number, result,
                                  why.empty() ? "" : ": " + why));
}

Status Wanted::keep() const {
    std::error_code failed;  // then it cannot be written either, and that is said
    std::filesystem::create_directories(std::filesystem::path(call_.file).parent_path(), failed);
    return write_file(call_.file, fleet::payload_of(*last_) + "\n");
}

void Wanted::keep_or_warn() const {
    const Status kept = keep();
    if (!kept.ok()) call_.log("warning", "fleet: " + kept.error().what);
}

}  // namespace vagus::serve
