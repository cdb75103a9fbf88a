// Where tests find their files. Only test_places.cpp contains paths of the checkout: any other
// file compiles to the same bytes wherever the checkout lies, and the compiler cache finds it.
//
//     const std::string text = read_file(test::testdata("projects/rover.aesl")).value();
#pragma once

#include <string>
#include <string_view>

namespace vagus::test {

// Paths of files in these folders; without a name that of the folder itself.
std::string testdata(std::string_view name = {});
std::string examples(std::string_view name = {});
std::string docs(std::string_view name = {});
// The worlds of tests/samples that only tests need.
std::string sample_worlds(std::string_view name = {});

}  // namespace vagus::test
