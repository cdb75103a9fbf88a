// A child process and the socket pair that joins it to its parent: the only place of serve that
// calls the system. A run is such a child, so that what crashes, hangs or eats memory in it ends
// the run and not the studio (docs/decisions/0111-a-run-is-a-process.md).
//
//     auto child = Child::start({.program = "/usr/bin/vagus", .arguments = {"run-host"}});
//     child.value().pipe().send(talk::encode(talk::StepPlan{}));
//     for (const Packet& packet : child.value().pipe().receive()) hear(packet);
//     if (const auto ended = child.value().ended()) say(ended->what);
//
// The child is killed when its parent dies, and cannot take more memory than it may.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kPacketBytesMax = 16u << 20;  // more is a bug of the other end: it is cut off
constexpr size_t kPipeUnsentMax = 64u << 20;   // what waits for the other end; then it hangs
constexpr size_t kRunMemoryMax = size_t{4} << 30;
constexpr int kTalkDescriptor = 3;  // of the socket in the child

// One message over the pair: four bytes length, one byte kind, then its bytes.
struct Packet {
    char kind = 0;
    std::string bytes;
};

// One end of a socket pair. Never blocks.
class Pipe {
public:
    explicit Pipe(int descriptor);  // takes it over
    ~Pipe();
    Pipe(Pipe&& other) noexcept;
    Pipe& operator=(Pipe&& other) noexcept;

    // Queues and writes what the system takes. False: too much waits, or the other end is gone.
    bool send(char kind, std::string_view bytes);
    bool send(const Packet& packet) { return send(packet.kind, packet.bytes); }
    // Writes what waits.
    void flush();
    bool has_unsent() const { return sent_ < out_.size(); }
    // What has come whole.
    std::vector<Packet> receive();
    // For the other end nobody is there any more.
    void close();
    // The other end is gone, or speaks nonsense; what came before was given.
    bool closed() const { return closed_; }
    // To be waited on; -1 once closed.
    int descriptor() const { return descriptor_; }
    // Waits until there is something to read, or something that waits can be written, or so long.
    void wait(int milliseconds) const;

private:
    void read_some();

    int descriptor_ = -1;
    bool closed_ = false;
    std::string in_, out_;
    size_t sent_ = 0;  // of out_
};

struct ChildOptions {
    std::string program;  // its path
    std::vector<std::string> arguments;
    std::string name = program;  // in lists of processes
    size_t memory_max = kRunMemoryMax;
};

// How a child ended: "exited with status 1", "was ended by signal 11 (Segmentation fault)".
struct ChildEnd {
    bool good = false;  // exit status 0
    int signal = 0;
    std::string what;
};

class Child {
public:
    static Result<Child> start(const ChildOptions& options);
    // Ends it, at once.
    ~Child();
    Child(Child&& other) noexcept;
    Child& operator=(Child&& other) noexcept;

    Pipe& pipe() { return pipe_; }
    const Pipe& pipe() const { return pipe_; }
    std::optional<ChildEnd> ended();
    void kill();

private:
    Child(int process, Pipe pipe) : process_(process), pipe_(std::move(pipe)) {}
    int process_ = -1;
    std::optional<ChildEnd> end_;
    Pipe pipe_;
};

constexpr size_t kPrintedBytesMax = 1u << 20;

// A program of the system that prints something and ends, found in PATH; what it says of errors
// goes nowhere.
class Printing {
public:
    // It waits, and does not end, once it has printed `most` bytes.
    static Result<Printing> start(const std::vector<std::string>& words,
                                  size_t most = kPrintedBytesMax);
    ~Printing();  // ends it
    Printing(Printing&& other) noexcept;
    Printing& operator=(Printing&& other) noexcept;

    // Reads what is there; true once it has ended.
    bool read();
    const std::string& text() const { return text_; }
    // It has ended with exit status 0.
    bool good() const { return good_; }
    bool is_full() const { return text_.size() >= most_; }

private:
    Printing(int process, int output, size_t most)
        : process_(process), output_(output), most_(most) {}
    int process_ = -1;
    int output_ = -1;
    size_t most_ = 0;
    bool good_ = false;
    std::string text_;
};

// Starts a program that goes on by itself: a browser. False if there is none of that name.
bool start_beside(const std::vector<std::string>& words);

// The program that runs, for a child: also when another version is at its path by now.
constexpr const char* kThisProgram = "/proc/self/exe";
// Its path.
std::string own_program();
// Of this computer.
std::string host_name();
// Random bytes of the system, for tokens.
std::string random_bytes(size_t count);
// A random whole number from 0 to below 2^48, which JSON carries exactly.
int64_t random_number();

}  // namespace vagus::serve
