// The verb `test-host`, which --help does not show: tests of behaviour for the studio, whose server
// starts it. It is told what to run through a socket, and tells there what comes of each seed as it
// ends (trial/told.hpp). When it is killed, so are the processes of its seeds.
#pragma once

namespace CLI {
class App;
}

namespace vagus::cli {

constexpr int kTestNice = 10;  // the studio and what runs in it come first

void add_test_host(CLI::App& app, int& exit_code);

}  // namespace vagus::cli
