// Prints docs/diagnostics.md from the registry of diagnostics: aesl_catalogue > docs/diagnostics.md
#include <cstdio>

#include "aesl/diagnostics.hpp"

int main() {
    const std::string page = vagus::aesl::catalogue_page();
    std::fwrite(page.data(), 1, page.size(), stdout);
    return 0;
}
