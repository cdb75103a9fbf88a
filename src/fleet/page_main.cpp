// Writes docs/fleet-messages.md to standard output.
#include <cstdio>

#include "fleet/kind.hpp"

int main() {
    std::fputs(vagus::fleet::page_of_messages().c_str(), stdout);
}
