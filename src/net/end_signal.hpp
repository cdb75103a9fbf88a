// The signals that ask a process to end: SIGINT (Ctrl-C), SIGTERM, and SIGHUP (the terminal is
// gone; not under nohup). The first is noted, so that the process ends in order; a second one ends
// it at once (but the two SIGHUP of a terminal that closes are one).
//
//     watch_for_end();
//     const EndWatcher watcher([&run] { run.abort(); });   // for what waits elsewhere
//     while (!end_asked()) turn();                         // for a loop
#pragma once

#include <functional>
#include <string>
#include <thread>

namespace vagus::net {

// From now on. More calls do no harm. A prompt, at which Ctrl-C means something else, keeps SIGINT.
enum class EndBy { AnySignal, AnyButCtrlC };
void watch_for_end(EndBy by = EndBy::AnySignal);
bool end_asked();
// The name of the signal that asked: "SIGTERM"; empty if none did.
std::string end_asked_by();
// Can be read from once an end was asked for, for code that waits for input: code that asks first
// and then waits misses a signal between the two. -1 before watch_for_end(). Not to be read from.
int end_descriptor();
// Ends the process by the signal that asked for its end, so that a shell script around it stops
// too; returns `exit_code` if none did.
int end_as_asked(int exit_code);
// Called in a signal handler before a signal ends the process: to give a terminal back. nullptr:
// nothing. Only calls that are allowed there.
void before_sudden_end(void (*last_act)());

// Without effect on this process, as SIGHUP under nohup.
bool is_ignored(int signal_number);
// Ends the process as the signal does by default; returns if it was only stopped. For handlers.
void die_by(int signal_number);

// Calls `on_end` once, on a thread of its own, when an end is asked for, or at once if it has been.
class EndWatcher {
public:
    // After watch_for_end(). At most one at a time.
    explicit EndWatcher(std::function<void()> on_end);
    ~EndWatcher();
    EndWatcher(const EndWatcher&) = delete;
    EndWatcher& operator=(const EndWatcher&) = delete;

private:
    int quit_[2] = {-1, -1};  // a pipe: written to at the end
    std::thread thread_;
};

}  // namespace vagus::net
