#include "record/file_tape.hpp"

#include <utility>

#include "mcap/records.hpp"

namespace vagus::record {

Result<GrowingFile> create_recording(const std::string& path) {
    if (!is_file_of_another_kind(path, mcap::kMagic)) return GrowingFile::create(path);
    return Error{Code::Refused, path +
                                    ": is there already, and is no recording; name another file "
                                    "for the recording, as run.mcap"};
}

Result<std::unique_ptr<FileTape>> FileTape::create(const std::string& path, Pace pace) {
    // Owner: the sink, which lives as long as the tape.
    const auto file = std::make_shared<GrowingFile>(TRY(create_recording(path)));
    auto tape = std::make_unique<FileTape>(
        [file](std::string_view bytes) { return file->append(bytes); }, pace);
    return tape;
}

Result<std::unique_ptr<FileTape>> start_tape(const std::string& path, RunFile& about,
                                             const PackedFiles& files, Pace pace) {
    for (std::string* const one : {&about.plan, &about.world, &about.answers, &about.project}) {
        *one = files.name_of(*one);
    }
    for (std::string& one : about.toolboxes) one = files.name_of(one);
    for (std::string& one : about.loads) one = files.name_of(one);
    auto tape = TRY(FileTape::create(path, pace));
    for (const auto& [name, content] : files.files) tape->attach(name, content);
    return tape;
}

FileTape::FileTape(mcap::Writer::Sink sink, Pace pace) : pace_(pace), writer_(std::move(sink)) {
    thread_ = std::thread([this] { work(); });
}

FileTape::~FileTape() {
    (void)end().ok();
}

void FileTape::attach(const std::string& name, std::string_view content) {
    const std::lock_guard lock(writing_);
    write_attachment(name, content);
}

void FileTape::attach_later(const std::string& name, std::string content) {
    const Message message{.kind = Message::Kind::File, .bytes = content.size()};
    if (const auto lock = room_for(message)) {
        waiting_.files.emplace_back(name, std::move(content));
        keep(message);
    }
}

void FileTape::write_attachment(const std::string& name, std::string_view content) {
    const bool json = name.ends_with(".json");
    writer_.attach({name, json ? "application/json" : "application/octet-stream", 0, content});
}

uint16_t FileTape::declare(const Topic& topic) {
    const std::lock_guard lock(mutex_);
    if (topics_.size() >= mcap::kChannelsMax) return 0;
    topics_.push_back(topic);
    return static_cast<uint16_t>(topics_.size());
}

void FileTape::put(uint16_t topic, Time at, std::string_view data) {
    const Message message{.topic = topic, .at = at, .bytes = data.size()};
    if (const auto lock = room_for(message)) {
        waiting_.text.append(data);
        keep(message);
    }
}

void FileTape::put_later(uint16_t topic, Time at, size_t about_bytes, Word word) {
    const Message message{Message::Kind::Later, topic, at, about_bytes};
    if (const auto lock = room_for(message)) {
        waiting_.words.push_back(std::move(word));
        keep(message);
    }
}

std::unique_lock<std::mutex> FileTape::room_for(const Message& message) {
    std::unique_lock lock(mutex_);
    if (pace_ == Pace::Waits) {
        room_.wait(lock, [this] { return waiting_bytes_ < kDropFrom || !state_.ok(); });
    }
    const bool is_file = message.kind == Message::Kind::File;
    if (over_ || !state_.ok() || (message.topic == 0 && !is_file)) return {};
    if (waiting_bytes_ >= kDropFrom && !is_file && topics_[message.topic - 1u].may_be_dropped) {
        ++dropped_;
        return {};
    }
    return lock;
}

void FileTape::keep(const Message& message) {
    const size_t before = waiting_bytes_;
    waiting_bytes_ += message.bytes;
    waiting_.bytes += message.bytes;
    waiting_.messages.push_back(message);
    if (before < kWakeAt && waiting_bytes_ >= kWakeAt) more_.notify_one();
    if (waiting_bytes_ < kWaitingMax) return;
    state_ = Error{Code::Limit, "the recording ends here: the disk is too slow, " +
                                    std::to_string(kWaitingMax >> 20) +
                                    " MB wait to be written; record to a faster disk"};
}

void FileTape::Waiting::clear() {
    messages.clear();
    text.clear();
    words.clear();
    files.clear();
    bytes = 0;
}

void FileTape::work() {
    bool last = false;
    size_t known = 0;  // of the topics
    Waiting taken;
    for (auto patience = kFirstFlush; !last; patience = kFlushEvery) {
        std::vector<Topic> declared;
        uint64_t flush = 0;
        {
            std::unique_lock lock(mutex_);
            more_.wait_for(lock, patience, [this] {
                return over_ || waiting_bytes_ >= kWakeAt || flush_wanted_ != flush_done_;
            });
            std::swap(taken, waiting_);
            last = over_;
            flush = flush_wanted_;
            declared.assign(topics_.begin() + static_cast<std::ptrdiff_t>(known), topics_.end());
        }
        known += declared.size();
        write(taken, declared, last);
        taken.clear();
        const std::lock_guard lock(mutex_);
        flush_done_ = flush;
    }
}

void FileTape::write(const Waiting& waiting, const std::vector<Topic>& declared, bool last) {
    Status written = Status::done();
    {
        const std::lock_guard lock(writing_);
        for (const Topic& topic : declared) {
            mcap::Channel channel{.topic = topic.name,
                                  .encoding = topic.json ? "json" : "vagus-frame"};
            if (!topic.schema.empty()) {
                channel.schema =
                    writer_.add_schema({.name = std::string(topic.schema),
                                        .encoding = "jsonschema",
                                        .data = std::string(schema_text(topic.schema))});
            }
            channels_.push_back(writer_.add_channel(std::move(channel)));
        }
        write_all(waiting);
        written = last ? writer_.end() : writer_.flush();
        bytes_ = writer_.bytes();
    }
    const std::lock_guard lock(mutex_);
    waiting_bytes_ -= waiting.bytes;
    if (state_.ok()) state_ = written;
    room_.notify_one();
}

void FileTape::write_all(const Waiting& waiting) {
    PieceText::Reading text(waiting.text);
    auto word = waiting.words.begin();
    auto file = waiting.files.begin();
    for (const Message& message : waiting.messages) {
        if (message.kind == Message::Kind::File) {
            write_attachment(file->first, file->second);
            ++file;
            continue;
        }
        const uint16_t channel = channels_[message.topic - 1u];
        const uint64_t at = nanoseconds(message.at);
        if (message.kind == Message::Kind::Later) {
            writer_.write(channel, at, (*word++)());
        } else {
            writer_.write(channel, at, text.next(message.bytes));
        }
    }
}

void FileTape::close() {
    const std::lock_guard lock(mutex_);
    over_ = true;
    more_.notify_one();
}

Status FileTape::end() {
    close();
    if (thread_.joinable()) thread_.join();
    return state();
}

uint64_t FileTape::flush() {
    const std::lock_guard lock(mutex_);
    more_.notify_one();
    return ++flush_wanted_;
}

bool FileTape::flushed(uint64_t number) const {
    const std::lock_guard lock(mutex_);
    return flush_done_ >= number || over_;
}

Status FileTape::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

uint64_t FileTape::dropped() const {
    const std::lock_guard lock(mutex_);
    return dropped_;
}

}  // namespace vagus::record
