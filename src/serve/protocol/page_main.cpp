// Prints docs/protocol.md.
#include <cstdio>

#include "serve/protocol/protocol.hpp"

int main() {
    const std::string page = vagus::serve::Protocol::get().page();
    return std::fwrite(page.data(), 1, page.size(), stdout) == page.size() ? 0 : 1;
}
