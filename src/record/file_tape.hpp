// A recording on its way to the disk. Messages are compressed and written by a thread of their own,
// each second, so that the run that is recorded waits for nothing.
//
//     auto tape = TRY(FileTape::create("run.mcap", Pace::Waits));
//     const uint16_t trace = tape->declare({.name = "/plan/trace"});
//     tape->put(trace, at, "{\"t\":0.5}");
//     const Status written = tape->end();
//
// Where the disk is too slow, and the run is one that may not wait (Pace::NeverWaits): from
// kDropFrom on messages that may be dropped are dropped and counted; at kWaitingMax the recording
// ends, and says so. A run in virtual time waits.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "base/result.hpp"
#include "mcap/writer.hpp"
#include "record/piece_text.hpp"
#include "record/run_file.hpp"
#include "record/topics.hpp"

namespace vagus::record {

constexpr size_t kDropFrom = 64u << 20;     // bytes that wait
constexpr size_t kWaitingMax = 256u << 20;  // the same
constexpr size_t kWakeAt = 64u << 10;       // the thread begins then: little is lost with a run
constexpr std::chrono::milliseconds kFlushEvery{1000};
// What kind of run it is does not wait so long: without it, what a killed one leaves can never be
// run again.
constexpr std::chrono::milliseconds kFirstFlush{50};

enum class Pace { NeverWaits, Waits };

// A new file for a recording, also in place of an older one. Refused where the file is something
// else: a plan, a script, whose name was typed where that of the recording belongs.
Result<GrowingFile> create_recording(const std::string& path);

class FileTape final : public Tape {
public:
    // Writes what is attached, by name, at once. The Error names the file and why it cannot be
    // written.
    static Result<std::unique_ptr<FileTape>> create(const std::string& path, Pace pace);
    // For tests: bytes go there instead of to a file.
    FileTape(mcap::Writer::Sink sink, Pace pace);
    // As end(), whose answer nobody hears.
    ~FileTape() override;

    // At once, so before the run.
    void attach(const std::string& name, std::string_view content);
    // The same while the run goes on, as a message: nobody waits.
    void attach_later(const std::string& name, std::string content);
    uint16_t declare(const Topic& topic) override;
    void put(uint16_t topic, Time at, std::string_view data) override;
    void put_later(uint16_t topic, Time at, size_t about_bytes, Word word) override;
    // Nothing more comes; what is there is written while the caller goes on.
    void close();
    // Waits until all is written. The first thing that went wrong since the beginning.
    Status end();
    // All that is there now is to be written at once; flushed() tells when it is.
    uint64_t flush();
    bool flushed(uint64_t number) const;
    // So far.
    Status state() const;
    uint64_t bytes() const { return bytes_; }  // in the file
    uint64_t dropped() const;

private:
    struct Message {
        enum class Kind : uint8_t { Text, Later, File };
        Kind kind = Kind::Text;
        uint16_t topic = 0;
        Time at{};
        size_t bytes = 0;  // of the text, or about so many
    };
    // What waits, in its order. A run makes a thousand messages a second, and a thread that frees
    // what another one has allocated is slow: so two of these are swapped, and keep their room.
    struct Waiting {
        std::vector<Message> messages;
        PieceText text;  // of all messages that have one
        std::vector<Word> words;
        std::vector<std::pair<std::string, std::string>> files;  // name, content
        size_t bytes = 0;                                        // of all messages
        void clear();
    };
    // Locks for one message. Not owned: it is dropped, or the tape is over.
    std::unique_lock<std::mutex> room_for(const Message& message);
    void keep(const Message& message);
    void work();
    void write(const Waiting& waiting, const std::vector<Topic>& declared, bool last);
    void write_all(const Waiting& waiting);
    void write_attachment(const std::string& name, std::string_view content);

    const Pace pace_;
    std::atomic<uint64_t> bytes_ = 0;
    std::mutex writing_;  // guards the next two; held while the disk is waited for
    mcap::Writer writer_;
    std::vector<uint16_t> channels_;  // of topics, by number - 1
    mutable std::mutex mutex_;        // guards what follows; never held for long
    std::vector<Topic> topics_;       // by number - 1
    std::condition_variable more_;
    std::condition_variable room_;
    Waiting waiting_;
    size_t waiting_bytes_ = 0;  // and those that are being written
    uint64_t dropped_ = 0;
    uint64_t flush_wanted_ = 0;  // number of the last
    uint64_t flush_done_ = 0;
    bool over_ = false;
    Status state_ = Status::done();
    std::thread thread_;
};

// A tape that begins with the files of the run; the paths in `about` become their names.
Result<std::unique_ptr<FileTape>> start_tape(const std::string& path, RunFile& about,
                                             const PackedFiles& files, Pace pace);

}  // namespace vagus::record
