#include "serve/access.hpp"

#include <algorithm>
#include <cctype>
#include <mutex>

#include "base/text.hpp"

namespace vagus::serve {

namespace {

// Looks at every byte of the secret, whatever was given.
bool same(std::string_view given, std::string_view secret) {
    unsigned different = given.size() == secret.size() ? 0 : 1;
    for (size_t i = 0; i < secret.size(); ++i) {
        const char letter = given.empty() ? '\0' : given[i % given.size()];
        different |= static_cast<unsigned>(static_cast<unsigned char>(letter) ^
                                           static_cast<unsigned char>(secret[i]));
    }
    return different == 0;
}

}  // namespace

std::string token_of(const std::array<uint8_t, 16>& random) {
    return hex_of({reinterpret_cast<const char*>(random.data()), random.size()});
}

Result<std::string> token_in(std::string_view text, const std::string& file) {
    const std::string token(text.substr(0, text.find_first_of("\r\n")));
    const bool plain = std::all_of(token.begin(), token.end(), [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '_';
    });
    if (plain && token.size() >= 16 && token.size() <= 200) return token;
    return Error{Code::BadInput,
                 file +
                     ": expected a token of 16 to 200 letters and digits in the first line; "
                     "delete the file to have one made"};
}

struct Access::Tokens {
    std::mutex mutex;
    std::string drive;
    std::optional<std::string> look;
};

Access::Access(std::string drive, std::optional<std::string> look)
    : tokens_(std::make_shared<Tokens>()) {
    tokens_->drive = std::move(drive);
    tokens_->look = std::move(look);
}

void Access::renew(std::string drive) const {
    const std::lock_guard lock(tokens_->mutex);
    tokens_->drive = std::move(drive);
}

Access::Grade Access::grade(std::string_view token) const {
    const std::lock_guard lock(tokens_->mutex);
    const bool drive = same(token, tokens_->drive);
    const bool look = tokens_->look && same(token, *tokens_->look);
    return drive ? Grade::Drive : look ? Grade::Look : Grade::Refused;
}

Time WrongTokens::wrong(const std::string& address, Time now) {
    if (wrong_.size() >= kWrongAddressesMax && !wrong_.contains(address)) {
        wrong_.erase(wrong_.begin());
    }
    Wrong& wrong = wrong_[address];
    const Time answered = std::max(now, wrong.until);
    wrong.wait =
        wrong.wait == Duration{} ? kWrongTokenWait : std::min(wrong.wait * 2, kWrongTokenWaitMax);
    wrong.until = answered + wrong.wait;
    return answered;
}

}  // namespace vagus::serve
