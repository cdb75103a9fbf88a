#include "base/test_places.hpp"

namespace vagus::test {
namespace {

std::string in_checkout(std::string_view folder, std::string_view name) {
    std::string path = std::string(VAGUS_CHECKOUT) + "/" + std::string(folder);
    return name.empty() ? path : path + "/" + std::string(name);
}

}  // namespace

std::string testdata(std::string_view name) {
    return in_checkout("testdata", name);
}

std::string examples(std::string_view name) {
    return in_checkout("examples", name);
}

std::string docs(std::string_view name) {
    return in_checkout("docs", name);
}

std::string sample_worlds(std::string_view name) {
    return in_checkout("tests/samples/worlds", name);
}

}  // namespace vagus::test
