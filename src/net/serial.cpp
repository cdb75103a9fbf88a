// Serial lines: raw bytes, 8N1, locked, DTR set (docs/spec/aseba-wire-and-vm.md, section 1.3).
#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <vector>

#include "net/channel.hpp"

namespace vagus::net {

namespace {

constexpr const char* kNamesFolder = "/dev/serial/by-id";
constexpr size_t kNamesMax = 256;  // lines looked at for `name=`

struct Baud {
    uint32_t rate;
    speed_t code;
};
constexpr std::array<Baud, 18> kBauds{{{1200, B1200},
                                       {2400, B2400},
                                       {4800, B4800},
                                       {9600, B9600},
                                       {19200, B19200},
                                       {38400, B38400},
                                       {57600, B57600},
                                       {115200, B115200},
                                       {230400, B230400},
                                       {460800, B460800},
                                       {500000, B500000},
                                       {576000, B576000},
                                       {921600, B921600},
                                       {1000000, B1000000},
                                       {1152000, B1152000},
                                       {1500000, B1500000},
                                       {2000000, B2000000},
                                       {3000000, B3000000}}};

Result<speed_t> code_of(const std::string& line, uint32_t rate) {
    std::string known;
    for (const Baud& each : kBauds) {
        if (each.rate == rate) return each.code;
        known += (known.empty() ? "" : ", ") + std::to_string(each.rate);
    }
    return Error{Code::BadInput, line + ": " + std::to_string(rate) +
                                     " is no baud rate that this system knows; choose from " +
                                     known};
}

std::vector<std::string> serial_names() {
    std::vector<std::string> names;
    DIR* folder = ::opendir(kNamesFolder);
    if (folder == nullptr) return names;
    for (dirent* entry = ::readdir(folder); entry != nullptr && names.size() < kNamesMax;
         entry = ::readdir(folder)) {
        if (entry->d_name[0] != '.') names.emplace_back(entry->d_name);
    }
    ::closedir(folder);
    std::sort(names.begin(), names.end());
    return names;
}

Result<std::string> device_of(const SerialPlace& place) {
    if (!place.device.empty()) return place.device;
    std::string there;
    for (const std::string& name : serial_names()) {
        if (name.find(place.name) != std::string::npos) {
            return std::string(kNamesFolder) + "/" + name;
        }
        there += " " + name;
    }
    return Error{Code::Unavailable,
                 "ser:name=" + place.name + ": no serial line has that in its name; " +
                     (there.empty() ? std::string("none is plugged in") : "there are:" + there)};
}

std::string mend_for(int error) {
    if (error == EACCES) return "; `sudo adduser $USER dialout` and a new login give the right";
    if (error == ENOENT) return "; is it plugged in?";
    if (error == EBUSY || error == EWOULDBLOCK) return "; close the other program first";
    return "";
}

Error cannot(const std::string& line, const char* act, int error) {
    const std::string why = error == EWOULDBLOCK ? "another program uses it" : std::strerror(error);
    return Error{Code::Unavailable, line + ": cannot " + act + ": " + why + mend_for(error)};
}

Status make_raw(int descriptor, const std::string& line, const SerialPlace& place) {
    termios settings{};
    if (::tcgetattr(descriptor, &settings) < 0) return cannot(line, "be set up", errno);
    ::cfmakeraw(&settings);  // 8 bits, no parity, no echo, no signals, no translation
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    settings.c_cflag |= CLOCAL | CREAD;
    if (place.flow_control == FlowControl::Hardware) settings.c_cflag |= CRTSCTS;
    settings.c_cc[VMIN] = 1;  // so that a read of nothing is EAGAIN and not 0
    settings.c_cc[VTIME] = 0;
    const speed_t code = TRY(code_of(line, place.baud));
    ::cfsetispeed(&settings, code);
    ::cfsetospeed(&settings, code);
    if (::tcsetattr(descriptor, TCSANOW, &settings) < 0) return cannot(line, "be set up", errno);
    ::tcflush(descriptor, TCIOFLUSH);
    return Status::done();
}

Status lock(int descriptor, const std::string& line) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) < 0) return cannot(line, "be locked", errno);
    if (::ioctl(descriptor, TIOCEXCL) < 0) return cannot(line, "be locked", errno);
    return Status::done();
}

Status set_dtr(int descriptor, const std::string& line) {
    const int dtr = TIOCM_DTR;
    if (::ioctl(descriptor, TIOCMBIS, &dtr) == 0) return Status::done();
    // A pseudo-terminal has no such line.
    if (errno == ENOTTY || errno == EINVAL) return Status::done();
    return cannot(line, "set DTR", errno);
}

}  // namespace

Result<std::unique_ptr<Channel>> open_serial(const SerialPlace& place) {
    const std::string line = to_string(Target{.place = place});
    const std::string device = TRY(device_of(place));
    const int descriptor = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return cannot(line, "open it", errno);
    auto channel = make_line_channel(descriptor, place.baud);
    if (::isatty(descriptor) == 0) {
        return Error{Code::BadInput, line + ": " + device + " is not a serial line"};
    }
    TRY(lock(descriptor, line));
    TRY(make_raw(descriptor, line, place));
    if (place.dtr == ModemLine::Set) TRY(set_dtr(descriptor, line));
    return channel;
}

}  // namespace vagus::net
