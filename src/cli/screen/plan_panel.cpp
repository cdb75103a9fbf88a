#include "cli/screen/plan_panel.hpp"

#include <algorithm>
#include <cmath>

#include "base/time.hpp"
#include "cli/screen/page.hpp"

namespace vagus::cli {

namespace {

constexpr size_t kActorsMax = 9;  // lines of each list at most
constexpr size_t kWatchingMax = 5;
constexpr size_t kVariablesMax = 6;
constexpr size_t kLoadsMax = 6;
constexpr int kHappeningsMin = 4;  // lines that the other lists leave
constexpr size_t kListMin = 2;     // lines of a longer list at least: one of it, and how many more
constexpr int kBarColumns = 10;
constexpr double kBarFull = 0.01;  // of the bus: a full bar stands for the highest, at least this

// Arrows only where a terminal can draw them.
std::string in_charset(const std::string& text, Charset charset) {
    constexpr std::string_view kArrow = "→";
    std::string out = text;
    if (charset == Charset::Unicode) return out;
    for (size_t at = out.find(kArrow); at != std::string::npos; at = out.find(kArrow)) {
        out.replace(at, kArrow.size(), "->");
    }
    return out;
}

std::string percent(double share) {
    return fixed(100 * share, 2) + " %";
}

class PlanPanel {
public:
    PlanPanel(Grid& grid, Area area, const View& view, const Look& look)
        : page_(grid, area, look.charset),
          plan_(*view.plan),
          scrolled_(view.scrolled),
          charset_(look.charset) {}

    void draw() {
        page_.pair(plan_.name, {kHead, {}, true}, plan_.state,
                   {plan_.wrong ? kBad : kGood, {}, true});
        const int under_variables = least(plan_.loads.size());
        const int under_watching = least(plan_.variables.size()) + under_variables;
        const int under_actors = least(std::max<size_t>(plan_.watching.size(), 1)) + under_watching;
        actors(room(plan_.actors.size(), kActorsMax, under_actors));
        watching(under_watching);
        variables(under_variables);
        loads();
        happenings();
    }

private:
    // Lines that a list takes in any case, with its heading.
    static int least(size_t count) {
        return count == 0 ? 0 : 1 + static_cast<int>(std::min(count, kListMin));
    }

    // Lines for a list of `count`, so that what follows keeps some.
    size_t room(size_t count, size_t most, int follows) const {
        const int left = page_.rows_left() - 1 - kHappeningsMin - follows;
        const size_t rows = std::min(static_cast<size_t>(std::max(left, 0)), most);
        return std::min(count, std::max(rows, kListMin));
    }

    // The lines of a list; where not all fit, the last says how many are left out.
    template <typename List, typename Line>
    void list(const List& all, size_t rows, const Line& line) {
        const size_t shown = all.size() > rows ? rows - 1 : all.size();
        for (size_t i = 0; i < shown; ++i) line(all[i]);
        if (shown < all.size()) more(page_, all.size() - shown);
    }

    // A part around the active one, if there are more than fit.
    void actors(size_t rows) {
        const auto& all = plan_.actors;
        const size_t shown = all.size() > rows ? rows - 1 : all.size();
        size_t active = 0;
        for (size_t i = 0; i < all.size(); ++i) {
            if (all[i].active) active = i;
        }
        const size_t before = std::min(active, shown / 2);
        const size_t first = std::min(active - before, all.size() - shown);
        for (size_t i = first; i < first + shown; ++i) actor(all[i]);
        if (shown < all.size()) more(page_, all.size() - shown);
    }

    void actor(const ActorView& actor) {
        const std::string mark = charset_ == Charset::Ascii ? "> " : "▶ ";
        const std::string indent(static_cast<size_t>(2 * actor.depth), ' ');
        const Ink ink{actor.active ? Colour(kFresh) : Colour(kDim), {}, actor.active};
        const double seconds = seconds_of(actor.for_so_long);
        const std::string time = actor.active ? fixed(seconds, 1) + " s" : "";
        page_.add(indent + (actor.active ? mark : "  "), ink);
        const int room = page_.columns() - page_.column() - text_width(time) - 1;
        page_.add(shortened(actor.name, room, charset_), ink);
        page_.add_right(time, {kFresh, {}, false});
        page_.next();
    }

    void watching(int follows) {
        heading(page_, "watching");
        if (plan_.watching.empty()) nothing("nobody");
        const size_t rows = room(plan_.watching.size(), kWatchingMax, follows);
        list(plan_.watching, rows, [this](const WatchView& watch) {
            const std::string events = (watch.global ? "always " : "") + watch.events;
            page_.pair(watch.name, {kBar, {}, false}, events, {kDim, {}, false});
        });
    }

    void variables(int follows) {
        if (plan_.variables.empty()) return;
        heading(page_, "variables");
        const size_t rows = room(plan_.variables.size(), kVariablesMax, follows);
        list(plan_.variables, rows, [this](const PlanVariableView& variable) {
            const std::string unit = variable.unit.empty() ? "" : " " + variable.unit;
            const Ink ink{variable.fresh ? Colour(kFresh) : Colour(), {}, variable.fresh};
            page_.pair(variable.name, {}, variable.value + unit, ink);
        });
    }

    void loads() {
        if (plan_.loads.empty()) return;
        heading(page_, "bus " + percent(plan_.load));
        const size_t rows = room(plan_.loads.size(), kLoadsMax, 0);
        size_t width = 0;
        double highest = kBarFull;
        for (const NodeLoadView& load : plan_.loads) {
            width = std::max(width, load.name.size());
            highest = std::max(highest, load.share);
        }
        list(plan_.loads, rows, [&](const NodeLoadView& load) {
            page_.add(shortened(load.name, page_.columns() / 2, charset_), {});
            page_.jump(static_cast<int>(std::min<size_t>(width, 20)) + 1);
            bar(load.share / highest);
            page_.add_right(percent(load.share), {});
            page_.next();
        });
    }

    void bar(double part) {
        const int columns = static_cast<int>(std::ceil(part * kBarColumns));
        // Also without colours, and on any background, the bar differs from what it lies on.
        const std::string full = charset_ == Charset::Ascii ? "#" : "━";
        const std::string track = charset_ == Charset::Ascii ? "." : "╌";
        for (int i = 0; i < kBarColumns; ++i) {
            page_.add(i < columns ? full : track, {i < columns ? kBar : kDim, {}, false});
        }
    }

    void happenings() {
        const auto& all = plan_.happenings;
        const size_t first = std::min(scrolled_, all.empty() ? 0 : all.size() - 1);
        const std::string later = ", " + std::to_string(first) + " later";
        heading(page_, first == 0 ? "what happened" : "what happened" + later);
        if (all.empty()) nothing("nothing yet");
        const size_t left = all.size() - first + plan_.forgotten;
        const auto rows = static_cast<size_t>(std::max(page_.rows_left(), 0));
        if (rows == 0) return;
        const size_t shown = std::min(all.size() - first, left > rows ? rows - 1 : left);
        for (size_t i = first; i < first + shown; ++i) happening(all[i]);
        if (shown < left) more(page_, left - shown);
    }

    void happening(const HappeningView& one) {
        const double seconds = seconds_of(one.at);
        page_.add(fixed(seconds, 1) + " ", {kDim, {}, false});
        const Ink ink{one.fresh ? Colour(kFresh) : Colour(), {}, one.fresh};
        const std::string text = in_charset(one.text, charset_);
        page_.add(shortened(text, page_.columns() - page_.column(), charset_), ink);
        page_.next();
    }

    void nothing(std::string_view words) {
        page_.add(words, {kDim, {}, false});
        page_.next();
    }

    Page page_;
    const PlanPanelView& plan_;
    size_t scrolled_;
    Charset charset_;
};

}  // namespace

void draw_plan_panel(Grid& grid, Area area, const View& view, const Look& look) {
    PlanPanel(grid, area, view, look).draw();
}

}  // namespace vagus::cli
