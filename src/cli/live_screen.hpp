// A live view on the terminal: keys as they are typed, and one page after the other, of which only
// what changed is sent. `vagus sim` and `vagus plan run` fill the pages.
//
//     auto screen = LiveScreen::open(options.theme);
//     for (const Key key : screen.value()->keys()) act(key);
//     if (screen.value()->is_due(now)) screen.value()->paint(view, now);
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "cli/screen/keys.hpp"
#include "cli/screen/view.hpp"
#include "cli/terminal.hpp"

namespace CLI {
class App;
}

namespace vagus::cli {

constexpr Duration kFrameEvery = std::chrono::milliseconds(40);  // in real time

class LiveScreen {
public:
    // `theme`: "dark", "light", or empty to find out.
    static Result<std::unique_ptr<LiveScreen>> open(const std::string& theme);

    // What was typed since. Scrolling and repainting are done already, and not among them.
    std::vector<Key> keys();
    // The list of events goes so many lines back; less than 0: forward.
    void scroll(int lines);
    void scroll_to_latest() { scrolled_ = 0; }

    bool is_due(Time now) const { return now >= next_; }
    Time next() const { return next_; }
    // The next page is due at once: an answer to a key is seen without a wait.
    void hurry() { next_ = {}; }
    // False once the terminal is gone.
    bool paint(View view, Time now);

private:
    LiveScreen(Terminal terminal, const Look& look) : terminal_(std::move(terminal)), look_(look) {}

    Terminal terminal_;
    Look look_;
    Grid shown_{Size{1, 1}};
    std::string rest_;  // of keys
    Time next_{};
    size_t scrolled_ = 0;
    size_t happened_ = 0;  // in the plan, when it was painted last
};

// `--theme dark|light`
void add_theme_option(CLI::App& verb, std::string& theme);

}  // namespace vagus::cli
