#include "cli/live_screen.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/options.hpp"

namespace vagus::cli {
namespace {

constexpr int kPageLines = 5;  // that a key for a page scrolls

size_t listed(const View& view) {
    return view.plan ? view.plan->happenings.size() : view.panel.events.size();
}

}  // namespace

Result<std::unique_ptr<LiveScreen>> LiveScreen::open(const std::string& theme) {
    Terminal terminal = TRY(Terminal::open());
    const Look look = look_of(terminal, theme);
    return std::unique_ptr<LiveScreen>(new LiveScreen(std::move(terminal), look));
}

std::vector<Key> LiveScreen::keys() {
    std::vector<Key> left;
    for (const Key key : keys_of(terminal_.read(), rest_)) {
        switch (key) {
            case Key::Redraw:
                shown_ = Grid(Size{1, 1});
                break;
            case Key::Earlier:
                scroll(kPageLines);
                break;
            case Key::Later:
                scroll(-kPageLines);
                break;
            default:
                left.push_back(key);
        }
        hurry();
    }
    return left;
}

void LiveScreen::scroll(int lines) {
    const auto count = static_cast<size_t>(std::abs(lines));
    scrolled_ = lines > 0 ? scrolled_ + count : scrolled_ - std::min(scrolled_, count);
}

bool LiveScreen::paint(View view, Time now) {
    next_ = now + kFrameEvery;
    // A reader who has scrolled back keeps the place while more happens.
    const size_t happened = view.plan ? listed(view) + view.plan->forgotten : 0;
    if (scrolled_ > 0 && happened > happened_) scrolled_ += happened - happened_;
    happened_ = happened;
    scrolled_ = std::min(scrolled_, std::max<size_t>(listed(view), 1) - 1);
    view.scrolled = scrolled_;
    const Grid page = draw(view, terminal_.size(), look_);
    const Grid* before = terminal_.take_lost() ? nullptr : &shown_;
    const bool open = terminal_.write(repaint(before, page, look_.depth));
    shown_ = page;
    return open;
}

void add_theme_option(CLI::App& verb, std::string& theme) {
    takes_one_of(
        *verb.add_option("--theme", theme,
                         "the background of the terminal, where it does not say so itself"),
        {"dark", "light"});
}

}  // namespace vagus::cli
