// Copies of this process, made by fork(), that work for it and never outlive it: how they are made,
// what they say to each other, and how one is ended.
//
//     const Supervision supervision;
//     auto [mine, its] = TRY(CopyLink::make());
//     const int64_t copy = supervision.copy(its.descriptor());
//     if (copy == 0) {
//         its.send({.word = 1, .number = own_number(), .handed = own_handle()});
//         work(its);  // it has nothing open but this link
//     }
//     std::optional<CopyMessage> first = mine.receive();  // nothing: it has ended
//     CopyProcess process(first->number, std::move(first->handed));
//     process.end();
//
// A copy may be copied again, in the same way. All of them are adopted by the first process when
// those that they were made by end, and end with the first one: the system sends them a signal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "base/result.hpp"

namespace vagus {

constexpr size_t kCopyTextMax = 16u << 20;  // bytes of a message; more is not sent

// Something that is open, closed with its owner.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    ~Descriptor();
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    bool is_open() const { return number_ >= 0; }
    int number() const { return number_; }

private:
    int number_ = -1;
};

// What the word and the number mean is known to the two ends.
struct CopyMessage {
    uint32_t word = 0;
    int64_t number = 0;
    std::string text = {};
    Descriptor handed = Descriptor();  // the other end gets one of its own
};

// One end of a socket pair between two processes. Sending and receiving wait.
class CopyLink {
public:
    // Both ends.
    static Result<std::pair<CopyLink, CopyLink>> make();
    explicit CopyLink(Descriptor descriptor) : descriptor_(std::move(descriptor)) {}

    // False: nobody is at the other end.
    bool send(const CopyMessage& message) const;
    // Nothing: nobody is at the other end any more.
    std::optional<CopyMessage> receive() const;
    const Descriptor& descriptor() const { return descriptor_; }
    Descriptor take() && { return std::move(descriptor_); }

private:
    Descriptor descriptor_;
};

// A copy, held by a handle of the system: no other process that gets its number later is meant by
// it. It is ended with its holder.
class CopyProcess {
public:
    // As the copy itself told them: own_number(), own_handle().
    CopyProcess(int64_t number, Descriptor handle) : number_(number), handle_(std::move(handle)) {}
    ~CopyProcess() { end(); }
    CopyProcess(CopyProcess&& other) noexcept = default;
    CopyProcess& operator=(CopyProcess&& other) noexcept;

    int64_t number() const { return number_; }
    // It is to end; waits for nothing.
    void kill() const;
    // Waits until nothing is left of it.
    void end();

private:
    int64_t number_ = 0;
    Descriptor handle_;
};

// Of the first process: while this lives, it adopts copies whose makers have ended.
class Supervision {
public:
    Supervision();
    ~Supervision();
    Supervision(const Supervision&) = delete;
    Supervision& operator=(const Supervision&) = delete;

    // Like fork(): 0 in the copy, -1 (errno) if there is none. What the copy has open is that link,
    // and nothing else; nobody sees what it prints.
    int64_t copy(const Descriptor& link) const;

private:
    int adopted_before_ = 0;
};

// Within such a copy: another one, that has that link instead of the one of this process.
int64_t copy_again(const Descriptor& link);
int64_t own_number();
// Not open: the system has none (errno).
Descriptor handle_of(int64_t number);
Descriptor own_handle();
// Ends a copy: nothing of the process that it is a copy of is tidied up.
[[noreturn]] void end_copy();
// How many threads this process has; a copy would have one.
size_t threads_of_process();

// Like fork(), without a supervision: the copy keeps all that is open, and ends with this process,
// which waits for it.
int64_t copy_of_process();

// The last sentence of the system.
std::string system_sentence();

}  // namespace vagus
