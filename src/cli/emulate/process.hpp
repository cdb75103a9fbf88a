// An emulator as a child process, and the pair of sockets that is the serial line of its board.
//
//     auto started = EmulatorProcess::start(emulation);
//     links.join(hub, started.value().take_line(), emulation.name);
//
// It is killed when its object goes, and when this process ends in whatever way.
#pragma once

#include "base/result.hpp"
#include "cli/emulate/board.hpp"

namespace vagus::cli {

class EmulatorProcess {
public:
    static Result<EmulatorProcess> start(const Emulation& emulation);
    ~EmulatorProcess();
    EmulatorProcess(EmulatorProcess&& other) noexcept;
    EmulatorProcess& operator=(EmulatorProcess&& other) noexcept;

    // This side of the line; from now on the caller's.
    int take_line();
    // Its line for debuggers, if Emulation::memory is there, else -1; from now on the caller's.
    int take_monitor();

private:
    EmulatorProcess(int process, int line, int monitor)
        : process_(process), line_(line), monitor_(monitor) {}

    int process_ = -1;
    int line_ = -1;
    int monitor_ = -1;
};

}  // namespace vagus::cli
