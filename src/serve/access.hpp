// Tokens: one lets a client look, or drive. Made of 128 random bits, kept in files that only their
// owner reads, compared in a time that does not tell how much was right.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "base/time.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kWrongTokenWait = 500ms;  // after the first wrong one; doubles
constexpr Duration kWrongTokenWaitMax = 30s;
constexpr size_t kWrongAddressesMax = 1000;  // that are remembered

// 32 hexadecimal digits from random bytes.
std::string token_of(const std::array<uint8_t, 16>& random);
// The first line of a token file: 16 to 200 letters, digits, "-" or "_".
Result<std::string> token_in(std::string_view text, const std::string& file);

// Wrong tokens, and when each is answered. The first one at once, since people mistype; then each
// waits for those before it from the same address, longer each time. Nobody with a right one waits
// for them: behind one address there may be many people, and 128 random bits are not guessed
// however fast somebody asks.
class WrongTokens {
public:
    Time wrong(const std::string& address, Time now);
    void right(const std::string& address) { wrong_.erase(address); }

private:
    struct Wrong {
        Duration wait{};
        Time until{};
    };
    std::map<std::string, Wrong> wrong_;
};

// Copies know the same tokens, also after renew(), and may be asked on other threads.
class Access {
public:
    Access(std::string drive, std::optional<std::string> look);

    enum class Grade { Refused, Look, Drive };
    Grade grade(std::string_view token) const;
    // Another token of those who drive, from now on.
    void renew(std::string drive) const;

    Time wrong(const std::string& address, Time now) { return wrong_.wrong(address, now); }
    void right(const std::string& address) { wrong_.right(address); }

private:
    struct Tokens;
    std::shared_ptr<Tokens> tokens_;  // owners: all copies
    WrongTokens wrong_;
};

}  // namespace vagus::serve
